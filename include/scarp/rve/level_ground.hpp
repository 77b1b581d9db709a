// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/constitutive/buoyancy.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/rve/packings_by_depth.hpp"

namespace scarp {

/// Level ground of packings without a macroscopic solve: all its columns are alike, so one packing is consolidated at a
/// small pressure and compressed one-dimensionally through the overburden of every depth; each depth gets a copy. With
/// an overconsolidation ratio the column goes through multiples of the overburdens, and each copy is unloaded to its
/// own.
/// \tparam Grading a `SamplesGrains`
template <class Grading>
struct LevelGround {
  Cloud<Grading> cloud{};                ///< loose grains that the packing is prepared from
  double unit_weight = 15.68e3;          ///< [N/m3]
  double surcharge = 4e3;                ///< [Pa]
  double overconsolidation_ratio = 1.0;  ///< what each depth once carried over its overburden, at least 1: raises K0
  Buoyancy buoyancy{};                   ///< of the water table in it
  /// IsotropicPreparation with defaults of level ground, which a designated initialiser of some members leaves.
  struct Preparation {
    double pressure = 2e3;                                       ///< [Pa], at most what the uppermost point carries
    double preparation_friction = 0.08;                          ///< sets the density
    Servo consolidation = IsotropicPreparation{}.consolidation;  ///< at the preparation friction
    Servo relaxation{};                                          ///< at the law's own friction
  };
  Preparation preparation{};                ///< isotropic consolidation before the column is compressed
  OneDimensionalCompression compression{};  ///< one-dimensional compression through the overburdens

  /// \throws InputError
  void validate() const {
    require_not_negative("unit weight of level ground", unit_weight);
    require_not_negative("surcharge of level ground", surcharge);
    require_at_least("overconsolidation ratio of level ground", overconsolidation_ratio, 1.0);
    buoyancy.validate(unit_weight);
  }

  /// Vertical effective stress [Pa], compression positive, at a depth [m].
  double overburden(double depth) const { return surcharge + unit_weight * depth - buoyancy.relief(depth); }

  /// depths [m], any order; those with the same overburden, to 1e-7 of it, share a packing
  /// \throws PreparationError when a stress is not reached, InputError for bad parameters
  template <class PackingType, DampsMotion Damping = LocalDamping>
  PackingsByDepth<PackingType> make(typename PackingType::Law const& law, std::vector<double> depths,
                                    Damping const& damping = {}) const {
    if (depths.empty()) reject("no depths are given (level ground needs at least one): pass the depths of the points");
    validate();
    for (double const depth : depths) require_finite("depth of a packing", depth);
    std::sort(depths.begin(), depths.end());
    require_below_surface(depths.front());
    if (preparation.pressure > overburden(depths.front())) {
      reject(
          "the packing is prepared at {} Pa (the uppermost point carries {} Pa, so that the ground would be unloaded): "
          "lower the pressure or raise the surcharge",
          preparation.pressure, overburden(depths.front()));
    }
    auto const alike = [&](double a, double b) { return overburden(b) - overburden(a) <= 1e-7 * overburden(b); };
    depths.erase(std::unique(depths.begin(), depths.end(), alike), depths.end());
    std::vector<double> pressures;
    for (double const depth : depths) pressures.push_back(overconsolidation_ratio * overburden(depth));
    auto loose = cloud.template make<PackingType>();
    if (double const stiffness = spring_modulus(loose, law); !(pressures.back() < stiffness)) {
      reject(
          "the ground carries {:.4g} Pa at its deepest point, {:.4g} m below the surface (grains with a stiffness of "
          "{:.4g} Pa would overlap by their size): give lengths in metres, or stiffer contacts",
          pressures.back(), depths.back(), stiffness);
    }
    auto const& [pressure, friction, consolidation, relaxation] = preparation;
    IsotropicPreparation const first{pressure, friction, consolidation, relaxation};
    auto const base = first.prepare(std::move(loose), law, damping);
    if (!base.verdict.acceptable()) {
      throw PreparationError(fmt::format("the packing did not reach {} Pa ({}): try another seed or a higher pressure",
                                         preparation.pressure, name(base.verdict.reason)));
    }
    auto column = compression.compress(base.packing, law, pressures, damping);
    if (!column.back().verdict.acceptable()) {
      throw PreparationError(
          fmt::format("the column of packings stopped at {} Pa vertical stress ({}): try another seed",
                      pressures[column.size() - 1], name(column.back().verdict.reason)));
    }
    PackingsByDepth<PackingType> ground{std::move(depths), {}};
    for (auto& prepared : column) ground.packings.push_back(std::move(prepared.packing));
    if (overconsolidation_ratio > 1.0) unload(law, ground, damping);
    return ground;
  }

 private:
  template <class PackingType, class Damping>
  void unload(typename PackingType::Law const& law, PackingsByDepth<PackingType>& ground,
              Damping const& damping) const {
    for (std::size_t k = 0; k < ground.packings.size(); ++k) {
      double const pressure = overburden(ground.depths[k]);
      auto unloaded = compression.compress(std::move(ground.packings[k]), law, {pressure}, damping);
      if (!unloaded.front().verdict.acceptable()) {
        throw PreparationError(fmt::format(
            "the packing at {} m did not come back from its largest pressure to {} Pa ({}): try another seed",
            ground.depths[k], pressure, name(unloaded.front().verdict.reason)));
      }
      ground.packings[k] = std::move(unloaded.front().packing);
    }
  }
};

}  // namespace scarp
