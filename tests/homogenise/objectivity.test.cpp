// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "support/packings.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using scarp::Tensor;

/// A consolidated packing that has been sheared a little, so that contacts carry friction.
template <class PackingType>
PackingType sheared() {
  auto const& prepared = samples::consolidated<PackingType>(80);
  REQUIRE(prepared.verdict.acceptable());
  PackingType packing = prepared.packing;
  scarp::TimeStepper<PackingType> stepper;
  Tensor<2> strain;
  strain << 1e-5, 2e-5, 0.0, -2e-5;
  for (int k = 0; k < 300; ++k) REQUIRE(stepper.step(packing, samples::study_law(), strain).acceptable());
  for (int k = 0; k < 3000; ++k) {
    REQUIRE(stepper.step(packing, samples::study_law(), Tensor<2>::Zero()).acceptable());
  }
  packing.rest();
  return packing;
}

}  // namespace

TEST_CASE_TEMPLATE("a turned packing has the turned stress and tangent", PackingType, Discs, Ellipses) {
  auto const law = samples::study_law();
  auto const packing = sheared<PackingType>();
  double const angle = 37.0 / 180.0 * 3.141592653589793;
  auto const there = samples::turned(packing, angle);
  Tensor<2> const turn = scarp::rotation(angle);
  Tensor<2> const stress = scarp::balance(packing, law).stress;
  REQUIRE(std::abs(stress(0, 0) - stress(1, 1)) > 0.01 * stress.norm());  // otherwise there is nothing to turn
  // Analytic: sigma' = R sigma R^T. Overlaps are 1e-5 m or more of lengths 0.1 m, so forces keep 1e-12.
  CHECK((scarp::balance(there, law).stress - turn * stress * turn.transpose()).norm() < 1e-12 * stress.norm());

  // D'_ijkl = R_ip R_jq R_kr R_ls D_pqrs, with pairs (i, j) as rows: Q D Q^T, Q = R (x) R.
  auto const tangent = scarp::contact_tangent(packing, law);
  scarp::FullTangent<2> both;
  for (int j = 0; j < 2; ++j) {
    for (int q = 0; q < 2; ++q) both.block<2, 2>(2 * j, 2 * q) = turn(j, q) * turn;
  }
  CHECK((scarp::contact_tangent(there, law) - both * tangent * both.transpose()).norm() < 1e-12 * tangent.norm());
}

TEST_CASE_TEMPLATE("the raw stress of a packing at rest is symmetric within its torque residual", PackingType, Discs,
                   Ellipses) {
  auto const law = samples::study_law();
  auto const packing = sheared<PackingType>();
  auto const state = scarp::balance(packing, law);
  // Analytic: V (s_xy - s_yx) is the sum of the grains' net torques plus branch terms of the net forces; both vanish at
  // rest. Measured by the loop's own torques.
  PackingType copy = packing;
  scarp::PairScratch<double> scratch;
  auto const sums = scarp::pair_forces<scarp::Observe::balance>(copy, law, scratch);
  double torques = 0.0;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    torques +=
        scratch.forces[i * scarp::RowLayout<typename PackingType::Shape, typename PackingType::Law>::force_size + 2];
  }
  double const skew = packing.volume() * (state.stress(0, 1) - state.stress(1, 0));
  CHECK(std::abs(std::abs(skew) - std::abs(torques)) < 1e-9 * state.stress.norm() * packing.volume());
  CHECK(std::abs(skew) < 10.0 * std::max(state.unbalanced_ratio, 1e-12) * state.stress.norm() * packing.volume());
  CHECK(state.unbalanced_ratio < 1e-3);
  // Loop and pass over the contacts are two codes for the same sum.
  CHECK((sums.stress(packing.volume()) - state.stress).norm() < 1e-9 * state.stress.norm());
  CHECK(sums.contacts == static_cast<double>(state.contacts));
}
