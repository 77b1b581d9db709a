// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <limits>

#include "../shared/print.hpp"
#include "../shared/sand/preparation.hpp"
#include "packings.hpp"

namespace rve_lab {

template <class PackingType>
PackingType Preparation<PackingType>::printed(Sand const& sand, Law const& law) {
  auto const progress = [](std::string const& text) { examples::print(stdout, "{}\n", text); };
  return examples::prepared<PackingType>(sand, law, sand.seed, progress, sand.void_ratio_tolerance);
}

template <class PackingType>
PackingType Preparation<PackingType>::nearest(Sand const& sand, Law const& law, double& isotropic_void_ratio) {
  return examples::prepared<PackingType>(sand, law, sand.seed, {}, std::numeric_limits<double>::infinity(),
                                         &isotropic_void_ratio);
}

}  // namespace rve_lab
