// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/print.hpp"
#include "material.hpp"
#include "scarp/dem/preparation.hpp"

namespace rve_lab {

template <class PackingType>
PackingType make_cloud(Preparation const& choice) {
  using Shape = typename PackingType::Shape;
  auto const sizes = grading(std::type_identity<Shape>{}, choice);
  if (choice.largest < choice.smallest) {
    scarp::reject("the largest size {} is below the smallest {} (no size lies between them): exchange them",
                  choice.largest, choice.smallest);
  }
  return scarp::Cloud<std::remove_const_t<decltype(sizes)>>{.grading = sizes,
                                                            .grains = choice.grains,
                                                            .density = choice.density,
                                                            .thickness = choice.thickness,
                                                            .seed = choice.seed}
      .template make<PackingType>();
}

/// \throws InputError for a consolidation that did not get to its end
template <class PackingType>
PackingType consolidate(PackingType const& cloud, typename PackingType::Law const& law, Preparation const& choice,
                        double friction) {
  scarp::IsotropicPreparation const preparation{.pressure = choice.pressure, .preparation_friction = friction};
  auto prepared = preparation.prepare(cloud, law);
  if (!prepared.verdict.acceptable()) {
    scarp::reject("the consolidation at friction {} ended with {} ({}): change pressure, stiffness or number of grains",
                  friction, scarp::name(prepared.verdict.status), scarp::name(prepared.verdict.reason));
  }
  examples::print(stdout, "preparation friction {:.6f} gives void ratio {:.6f}\n", friction,
                  prepared.packing.void_ratio());
  std::fflush(stdout);
  return std::move(prepared.packing);
}

/// Bisection on the friction of the consolidation between none (densest) and the law's (loosest).
/// \throws InputError for a void ratio that lies outside what these give, or that the bisection jumps over
template <class PackingType>
PackingType reach_void_ratio(PackingType const& cloud, typename PackingType::Law law, Preparation& choice) {
  constexpr int max_halvings = 16;
  double const target = *choice.target_void_ratio;
  double low = 0.0;
  double high = law.friction_coefficient();
  PackingType nearest = consolidate(cloud, law, choice, low);
  choice.friction = low;
  auto const missing = [&](PackingType const& packing) { return packing.void_ratio() - target; };
  auto const keep = [&](PackingType&& packing, double friction) {
    double const error = missing(packing);
    if (std::abs(error) < std::abs(missing(nearest))) {
      nearest = std::move(packing);
      choice.friction = friction;
    }
    return error;
  };
  double const densest = nearest.void_ratio();
  double loosest = densest;
  if (std::abs(missing(nearest)) > choice.void_ratio_tolerance) {
    loosest = target + keep(consolidate(cloud, law, choice, high), high);
  }
  bool const between = densest <= target && target <= loosest;
  for (int k = 0; between && k < max_halvings && std::abs(missing(nearest)) > choice.void_ratio_tolerance; ++k) {
    double const middle = (low + high) / 2.0;
    (keep(consolidate(cloud, law, choice, middle), middle) < 0.0 ? low : high) = middle;
  }
  if (std::abs(missing(nearest)) > choice.void_ratio_tolerance) {
    scarp::reject(
        "void ratio {} is not reached (frictions from 0 to {} give {:.6f} to {:.6f}, the nearest found is {:.6f} at "
        "{}): "
        "choose one in between, another seed or a wider tolerance",
        target, law.friction_coefficient(), densest, loosest, nearest.void_ratio(), choice.friction);
  }
  return nearest;
}

/// `choice.friction` becomes what was used.
template <class PackingType>
PackingType prepare_packing(Preparation& choice, typename PackingType::Law const& law) {
  auto const cloud = make_cloud<PackingType>(choice);
  return choice.target_void_ratio ? reach_void_ratio(cloud, law, choice)
                                  : consolidate(cloud, law, choice, choice.friction);
}

}  // namespace rve_lab
