// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"

namespace scarp::detail {

/// Refuses soil whose vertical stress does not carry the weight that the scene puts on it: ground that begins out of
/// balance settles or heaves first, and its strength is that of another stress. Of some sites from the shallowest to the
/// deepest the middle one counts, by its error: packings prepared for a few depths carry too much here and too little there.
/// unit_weight [N/m3], surcharge [Pa] \throws InputError
template <ConstitutiveProvider Soil>
void require_carried(Soil const& soil, std::vector<Site<Soil::dim>> sites, double unit_weight, double surcharge) {
  constexpr double tolerance = 0.01;  // servos of preparations reach 1e-3
  constexpr std::size_t looks = 15;
  struct Look {
    double depth, carried, weight;
    double error() const { return carried / weight - 1.0; }
  };
  std::ranges::sort(sites, {}, [](auto const& site) { return site.depth; });
  std::vector<Look> found;
  for (std::size_t k = 0; k < looks && !sites.empty(); ++k) {
    auto const& site = sites[k * (sites.size() - 1) / (looks - 1)];
    double const weight = surcharge + unit_weight * site.depth;
    if (weight > 0.0) found.push_back({site.depth, -soil.stress(soil.initial_state(site))(Soil::dim - 1), weight});
  }
  if (found.empty()) return;
  auto const middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::ranges::nth_element(found, middle, {}, &Look::error);
  if (std::abs(middle->error()) <= tolerance) return;
  refuse(
      "the soil carries {:.4g} Pa at a depth of {:.4g} m (the scene's surcharge of {:.4g} Pa and unit weight of {:.4g} "
      "N/m3 weigh {:.4g} Pa there): give both to the soil's initial stress and to the scene alike",
      middle->carried, middle->depth, surcharge, unit_weight, middle->weight);
}

}  // namespace scarp::detail
