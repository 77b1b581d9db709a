// SPDX-License-Identifier: BSL-1.0
#include "packings.hpp"

#include <limits>

#include "../shared/print.hpp"
#include "../shared/sand/preparation.hpp"

namespace rve_lab {

template <class PackingType>
PackingType Preparation<PackingType>::printed(Sand const& sand, Law const& law) {
  auto const progress = [](std::string const& text) { examples::print(stdout, "{}\n", text); };
  return examples::prepared<PackingType>(sand, law, sand.seed, progress, sand.void_ratio_tolerance);
}

template <class PackingType>
PackingType Preparation<PackingType>::nearest(Sand const& sand, Law const& law) {
  return examples::prepared<PackingType>(sand, law, sand.seed, {}, std::numeric_limits<double>::infinity());
}

template struct Preparation<Discs>;
template struct Preparation<HertzianDiscs>;
template struct Preparation<RollingDiscs>;
template struct Preparation<Ellipses>;
template struct Preparation<Superellipses>;

}  // namespace rve_lab
