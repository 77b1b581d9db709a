// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "../../examples/shared/study/study_sand.hpp"
#include "preparation.hpp"
#include "scarp/dem/preparation.hpp"

namespace preparations {

using Packing = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;

/// The packing of one depth.
struct AtDepth {
  double overburden = 0.0;  ///< [Pa]
  scarp::Prepared<Packing> prepared;
  scarp::Tensor<2> first_cell;  ///< [m], after the isotropic consolidation
};

/// Columns of packings from one cloud. Isotropic consolidations that several preparations share are made once.
class Columns {
 public:
  Columns(int grains, std::uint64_t seed) : grains_(grains), seed_(seed) {}

  /// overburdens [Pa], increasing
  /// \return one packing for each, in their order where one isotropic packing serves all and they grow from its
  /// pressure
  std::vector<AtDepth> make(Preparation const& preparation, std::span<double const> overburdens) {
    if (preparation.share > 0.0) return of_shares(preparation, overburdens);
    auto const& start = isotropic(preparation);
    std::vector<AtDepth> column;
    auto packing = start;
    for (double const overburden : overburdens) {
      if (preparation.overconsolidation_ratio * overburden >= preparation.isotropic_pressure)
        go_on(preparation, packing, start.packing.cell, overburden, column);
    }
    packing = start;
    for (std::size_t k = overburdens.size(); k-- > 0;) {
      if (preparation.overconsolidation_ratio * overburdens[k] < preparation.isotropic_pressure)
        go_on(preparation, packing, start.packing.cell, overburdens[k], column);
    }
    return column;
  }

 private:
  static scarp::LinearFrictional law_of(double friction) {
    auto law = examples::study_law();
    law.friction = friction;
    return law;
  }

  /// To a vertical stress [Pa]; a packing that did not arrive before stays where it is.
  static void bring(Preparation const& preparation, double friction, double vertical,
                    scarp::Prepared<Packing>& packing) {
    if (!packing.verdict.acceptable()) return;
    scarp::OneDimensionalCompression compression;
    compression.servo.feedback.fastest = preparation.fastest;
    auto const law = law_of(friction);
    if (preparation.held_ratio == 0.0) {
      packing = std::move(compression.compress(std::move(packing.packing), law, {vertical}).front());
      return;
    }
    scarp::TimeStepper<Packing> stepper;
    auto const loading = scarp::Loading<2>::stress({-preparation.held_ratio * vertical, -vertical, 0.0});
    packing.verdict = compression.servo.reach(stepper, packing.packing, law, loading);
    if (auto const stopped = stepper.stop(packing.packing, law); !stopped.acceptable()) packing.verdict = stopped;
  }

  /// The packing to the next overburden, a copy of it to rest there.
  static void go_on(Preparation const& preparation, scarp::Prepared<Packing>& packing,
                    scarp::Tensor<2> const& first_cell, double overburden, std::vector<AtDepth>& column) {
    double const law_friction = examples::study_law().friction;
    bring(preparation, preparation.vertical_friction, preparation.overconsolidation_ratio * overburden, packing);
    auto own = packing;
    if (preparation.overconsolidation_ratio > 1.0) bring(preparation, preparation.vertical_friction, overburden, own);
    if (preparation.vertical_friction != law_friction) bring(preparation, law_friction, overburden, own);
    column.push_back({overburden, std::move(own), first_cell});
  }

  std::vector<AtDepth> of_shares(Preparation const& preparation, std::span<double const> overburdens) {
    auto base = isotropic(preparation);
    std::vector<AtDepth> column;
    for (double const overburden : overburdens) {
      if (base.verdict.acceptable()) {
        scarp::IsotropicPreparation const isotropic{.pressure = preparation.share * overburden,
                                                    .preparation_friction = preparation.share_friction};
        base = isotropic.prepare(std::move(base.packing), law_of(preparation.vertical_friction));
      }
      auto packing = base;
      go_on(preparation, packing, base.packing.cell, overburden, column);
    }
    return column;
  }

  scarp::Prepared<Packing> const& isotropic(Preparation const& preparation) {
    std::array const key{preparation.isotropic_pressure, preparation.isotropic_friction, preparation.vertical_friction,
                         preparation.laid};
    auto const found = made_.find(key);
    if (found != made_.end()) return found->second;
    scarp::IsotropicPreparation const isotropic{.pressure = preparation.isotropic_pressure,
                                                .preparation_friction = preparation.isotropic_friction};
    return made_.emplace(key, isotropic.prepare(cloud(preparation.laid), law_of(preparation.vertical_friction)))
        .first->second;
  }

  /// Axes that are evenly spread over all directions, (cos, sin), are flattened to (cos, q sin), whose anisotropy is
  /// F = 2 (1 - q) / (1 + q).
  Packing cloud(double laid) const {
    auto packing = examples::study_cloud(grains_, seed_).make<Packing>();
    double const flattened = (2.0 - std::abs(laid)) / (2.0 + std::abs(laid));
    int const shortened = laid > 0.0 ? 1 : 0;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      packing.orientation(i, shortened) *= flattened;
      double const length = std::hypot(packing.orientation(i, 0), packing.orientation(i, 1));
      for (int a = 0; a < 2; ++a) packing.orientation(i, a) /= length;
    }
    return packing;
  }

  int grains_;
  std::uint64_t seed_;
  std::map<std::array<double, 4>, scarp::Prepared<Packing>> made_;
};

}  // namespace preparations
