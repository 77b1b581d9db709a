// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/bonded_packing.hpp"

#include <doctest/doctest.h>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/law_per_species.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/shape/with_species.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;

/// Bonds of the strength [N] of a contact under the samples' pressure, times a factor.
Bond cement(double factor) {
  double const strength = factor * samples::pressure * 1e-2 * samples::thickness;
  return {.law = samples::study_law(), .tensile_strength = strength, .shear_strength = strength};
}

/// Largest axial stress, positive along the given strain's sign, while the sides are free of stress.
template <class PackingType>
double unconfined_peak(PackingType packing, Bond const& law, double rate) {
  scarp::TimeStepper<PackingType> stepper;
  REQUIRE(scarp::Servo{.max_steps = 200'000}
              .reach(stepper, packing, law, scarp::Loading<2>::stress(scarp::VoigtStress<2>::Zero()))
              .acceptable());
  auto loading = scarp::drained_compression<2>(std::abs(rate), 0.0);
  if (rate > 0.0) loading = loading.reversed();
  scarp::CellDriver<PackingType> drive(packing, law, loading);
  double peak = 0.0;
  double side = 0.0;
  for (int step = 0; step < 8'000; ++step) {
    REQUIRE(drive.step(stepper).acceptable());
    double const axial = drive.seen().stress(1, 1) * (rate > 0.0 ? 1.0 : -1.0);
    if (axial > peak) side = drive.seen().stress(0, 0);
    peak = std::max(peak, axial);
  }
  CHECK(std::abs(side) < 0.05 * peak);  // the servo lags behind by that at most
  return peak;
}

}  // namespace

TEST_CASE_TEMPLATE("bonded grains carry tension, and compression without a side pressure, as their bonds are strong",
                   PackingType, samples::Discs, samples::Ellipses) {
  auto const& grains = samples::consolidated<PackingType>(80).packing;
  auto const weak = scarp::bonded(grains, samples::study_law(), cement(1.0));
  REQUIRE(weak.verdict.acceptable());
  CHECK(weak.bonds > 80);
  double const tension = unconfined_peak(weak.packing, cement(1.0), 2e-6);
  double const compression = unconfined_peak(weak.packing, cement(1.0), -2e-6);
  MESSAGE("tension " << tension << " Pa, compression " << compression << " Pa");
  CHECK(tension > 0.05 * samples::pressure);
  CHECK(compression > 2.0 * tension);  // Mohr-Coulomb with friction: (1 + sin phi)/(1 - sin phi) is above 2
  auto const strong = scarp::bonded(grains, samples::study_law(), cement(2.0));
  CHECK(unconfined_peak(strong.packing, cement(2.0), 2e-6) > 1.5 * tension);  // strength of bonds, doubled
}

TEST_CASE("grains that are bonded in balance stay in balance, with the stress that they had") {
  auto const& grains = samples::consolidated<samples::Ellipses>(80).packing;
  auto made = scarp::bonded(grains, samples::study_law(), cement(1.0));
  REQUIRE(made.verdict.acceptable());
  scarp::TimeStepper<decltype(made.packing)> stepper;
  scarp::StepObservation<2> seen;
  REQUIRE(stepper.observe(made.packing, cement(1.0), seen).acceptable());
  CHECK(seen.unbalanced_ratio < 1e-3);
  CHECK(std::abs(-seen.stress.trace() / 2.0 - samples::pressure) < 1e-3 * samples::pressure);
}

TEST_CASE("a gap that is bonded adds bonds") {
  auto const& grains = samples::consolidated<samples::Discs>(80).packing;
  auto const touching = scarp::bonded(grains, samples::study_law(), cement(10.0));
  auto const wide = scarp::bonded(grains, samples::study_law(), cement(10.0), 5e-4);
  REQUIRE(wide.verdict.acceptable());
  CHECK(wide.bonds > touching.bonds + 10);
  CHECK_REFUSED(scarp::bonded(grains, samples::study_law(), cement(1.0), -1.0), "gap", "is -1");
  CHECK_REFUSED(scarp::bonded(grains, samples::study_law(), cement(1.0), 5e-4), "break beyond", "smaller gap");
  CHECK_REFUSED(scarp::bonded(samples::Discs{}, samples::study_law(), cement(1.0)), "no population");
}

TEST_CASE("bonds that resist rolling bond the same contacts") {
  auto const& grains = samples::consolidated<samples::Discs>(80).packing;
  scarp::RollingResistance<Bond> const rolling{cement(1.0), 10.0, 0.1};
  CHECK(scarp::bonded(grains, samples::study_law(), rolling).bonds ==
        scarp::bonded(grains, samples::study_law(), cement(1.0)).bonds);
}

TEST_CASE("grains that meet without any overlap are bonded where gaps are, else not") {
  auto const pair =
      samples::place<samples::Discs>(scarp::Tensor<2>::Identity(), {{0.125}, {0.125}}, {{0.25, 0.5}, {0.5, 0.5}});
  CHECK(scarp::bonded(pair, samples::study_law(), cement(1.0)).bonds == 0);
  CHECK(scarp::bonded(pair, samples::study_law(), cement(1.0), 1e-6).bonds == 1);
}

TEST_CASE("grains without bonds are not asked for tension, nor for compression without a side pressure") {
  auto packing = samples::consolidated<samples::Discs>(80).packing;
  scarp::TimeStepper<samples::Discs> stepper;
  scarp::CellDriver<samples::Discs> drive(packing, samples::study_law(), scarp::drained_compression<2>(1e-6, 0.0));
  CHECK(drive.step(stepper) == scarp::Verdict{scarp::Status::not_converged, scarp::Reason::unreachable});
}

TEST_CASE("a packing with bonds is not bonded again, and a gap must be within the range of every pair of species") {
  auto const grains = samples::consolidated<samples::Discs>(80).packing;
  auto const once = scarp::bonded(grains, samples::study_law(), cement(1.0));
  CHECK_REFUSED(scarp::bonded(once.packing, cement(1.0), cement(2.0)), "has bonds already");

  using Kinds = scarp::WithSpecies<scarp::Disc, 2>;
  scarp::LawPerSpecies<scarp::LinearFrictional, 2> former;
  scarp::LawPerSpecies<Bond, 2> law;
  former.laws.fill({1e6, 1e6, 0.5});
  law.laws.fill({{1e6, 1e6, 0.5}, 1e4, 1e4});  // bonds that break beyond 1e-2 m
  law.between(1, 2).tensile_strength = 1e3;    // and beyond 1e-3 m
  auto const pair = samples::place<scarp::Packing<Kinds, scarp::LawPerSpecies<scarp::LinearFrictional, 2>>>(
      2.0 * scarp::Tensor<2>::Identity(), {{0.1, 1.0}, {0.1, 2.0}}, {{0.5, 0.5}, {0.705, 0.5}});
  CHECK_REFUSED(scarp::bonded(pair, former, law, 5e-3), "break beyond 0.001 m");
}
