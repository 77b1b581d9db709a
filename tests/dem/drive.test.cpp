// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/drive.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "../../examples/rve_biaxial/halved_path.hpp"
#include "../../examples/shared/laboratory_loadings.hpp"
#include "scarp/dem/loading.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::Ellipses;
using scarp::Loading;
using scarp::Reason;
using scarp::Status;
using scarp::Verdict;

/// A law that may act across gaps.
struct Attractive : scarp::LinearFrictional {
  double range = 0.0;  ///< [m]
  double interaction_range() const { return range; }
};

}  // namespace

TEST_CASE("a drive looks before its first step and leaves a consolidated packing alone") {
  auto packing = samples::consolidated<Ellipses>(80).packing;
  scarp::TimeStepper<Ellipses> stepper;
  auto const loading = Loading<2>::stress(scarp::VoigtStress<2>(-samples::pressure, -samples::pressure, 0.0));
  scarp::CellDriver<Ellipses> drive(packing, samples::study_law(), loading);
  REQUIRE(drive.step(stepper).acceptable());
  // The packing meets its target to 2e-4, so the answer is that share of pressure over modulus and response steps.
  double const modulus = scarp::spring_modulus(packing, samples::study_law());
  CHECK(drive.strain_step().cwiseAbs().maxCoeff() <
        2e-4 * samples::pressure / (modulus * scarp::ServoGains{}.response_steps));
}

TEST_CASE("a path towards zero, tension or not-a-number ends as unreachable without a step") {
  auto packing = samples::consolidated<Ellipses>(80).packing;
  auto const before = packing;
  scarp::TimeStepper<Ellipses> stepper;
  for (double const pressure : {0.0, -1e5, std::numeric_limits<double>::quiet_NaN()}) {
    scarp::CellDriver<Ellipses> lateral(packing, samples::study_law(), scarp::drained_compression<2>(1e-6, pressure));
    CHECK(lateral.step(stepper) == Verdict{Status::not_converged, Reason::unreachable});
    scarp::CellDriver<Ellipses> mean(packing, samples::study_law(), examples::constant_mean_stress<2>(1e-6, pressure));
    CHECK(mean.step(stepper) == Verdict{Status::not_converged, Reason::unreachable});
  }
  CHECK(packing == before);
}

TEST_CASE("grains that pull at each other may carry tension") {
  using Grains = scarp::Packing<scarp::Disc, Attractive>;
  auto const moves = [](double range) {
    auto packing = samples::triangular_lattice<Grains>(4, 5e-3, 1e-2 * (1.0 - 1e-3));
    scarp::TimeStepper<Grains> stepper;
    scarp::CellDriver<Grains> lateral(packing, {samples::study_law(), range}, scarp::drained_compression<2>(1e-6, 0.0));
    return lateral.step(stepper).acceptable();
  };
  CHECK(moves(1e-4));
  CHECK_FALSE(moves(0.0));
}

TEST_CASE("held stresses stay within one percent along a path") {
  scarp::TimeStepper<Ellipses> stepper;
  auto const law = samples::study_law();
  auto const worst_miss = [&](Loading<2> const& loading) {
    auto packing = samples::consolidated<Ellipses>(400).packing;
    scarp::CellDriver<Ellipses> drive(packing, law, loading);
    double worst = 0.0;
    for (int step = 0; step < 2'000; ++step) {
      REQUIRE(drive.step(stepper).acceptable());
      worst = std::max(worst, loading.worst_missing(drive.seen().stress));
    }
    return worst / samples::pressure;
  };
  // A proportional answer alone lags by rate x modulus x response steps = 1e-5 x 3e7 x 10 / 2e5, 1.5 percent.
  CHECK(worst_miss(scarp::drained_compression<2>(1e-5, samples::pressure)) < 0.01);
  CHECK(worst_miss(examples::constant_mean_stress<2>(1e-5, samples::pressure)) < 0.01);
  CHECK(worst_miss(examples::simple_shear_at_stress<2>(1e-5, samples::pressure)) < 0.01);
}

TEST_CASE("another loading forgets the rates that the one before has learned") {
  auto packing = samples::consolidated<Ellipses>(80).packing;
  scarp::TimeStepper<Ellipses> stepper;
  scarp::CellDriver<Ellipses> drive(packing, samples::study_law(),
                                    scarp::drained_compression<2>(1e-5, samples::pressure));
  for (int step = 0; step < 2'000; ++step) REQUIRE(drive.step(stepper).acceptable());
  auto const held = Loading<2>::stress(scarp::VoigtStress<2>(-samples::pressure, -1.1 * samples::pressure, 0.0));
  drive.load(held);
  for (int step = 0; step < 5'000; ++step) REQUIRE(drive.step(stepper).acceptable());
  CHECK(held.worst_missing(drive.seen().stress) < 1e-3 * samples::pressure);
}

TEST_CASE("looking at a packing, however often, does not change its way") {
  scarp::TimeStepper<Ellipses> stepper;
  auto const loading = examples::simple_shear<2>(1e-5);
  auto watched = samples::consolidated<Ellipses>(80).packing;
  auto alone = watched;
  scarp::StepObservation<2> seen;
  scarp::StepObservation<2> again;
  for (int step = 0; step < 200; ++step) {
    REQUIRE(stepper.step(alone, samples::study_law(), loading.gradient_per_step).acceptable());
    REQUIRE(stepper.observe(watched, samples::study_law(), seen).acceptable());
    REQUIRE(stepper.observe(watched, samples::study_law(), again).acceptable());
    REQUIRE(stepper.step(watched, samples::study_law(), loading.gradient_per_step).acceptable());
    // The normals of ellipses are improved by every look; 1e-10: the square of their change in a step.
    CHECK((seen.stress - again.stress).norm() < 1e-9 * seen.stress.norm());
  }
  REQUIRE(stepper.observe(alone, samples::study_law(), again).acceptable());
  REQUIRE(stepper.observe(watched, samples::study_law(), seen).acceptable());
  CHECK((seen.stress - again.stress).norm() < 1e-7 * seen.stress.norm());
}

TEST_CASE("a path in halved steps changes the stress less the smaller its steps are") {
  auto const law = samples::study_law();
  auto const difference = [&](double strain_per_step) {
    auto packing = samples::consolidated<Ellipses>(80).packing;
    scarp::TimeStepper<Ellipses> stepper;
    rve_biaxial::HalvedPath<Ellipses> again(packing);
    scarp::CellDriver<Ellipses> drive(packing, law, scarp::drained_compression<2>(strain_per_step, samples::pressure));
    for (double strain = 0.0; strain < 1e-3; strain += strain_per_step) {
      REQUIRE(drive.step(stepper).acceptable());
      again.add(drive.strain_step(), drive.seen().stress);
    }
    return again.difference(law);
  };
  double const coarse = difference(2e-5);
  double const fine = difference(2e-6);
  CHECK(fine > 0.0);
  // An error of first order would fall to a tenth, before any contact slides it falls faster.
  CHECK(fine < 0.1 * coarse);
  CHECK(coarse < 1e-3);
}

TEST_CASE("the fastest strain is that of a component, however long the direction of a control is") {
  scarp::ServoGains const gains{.fastest = 1e-4};
  for (double const length : {1e-3, 1.0, 1e3}) {
    scarp::Loading<2> const loading{.controls = {{length * scarp::Tensor<2>::Identity(), -1e9}}};
    std::vector<double> steady;
    auto const step = gains.strain_step<2>(loading, scarp::Tensor<2>::Zero(), 1e7, true, steady);
    CHECK(step.cwiseAbs().maxCoeff() == samples::Approx(1e-4));
  }
}

TEST_CASE("a servo looks at its last state, whatever the steps between its looks are") {
  auto packing = samples::consolidated<Ellipses>(80).packing;
  scarp::TimeStepper<Ellipses> stepper;
  auto const held = Loading<2>::stress(scarp::VoigtStress<2>(-samples::pressure, -samples::pressure, 0.0));
  scarp::Servo const servo{.stress_tolerance = 1e-2, .unbalanced_tolerance = 1e-2, .max_steps = 19, .check_every = 20};
  CHECK(servo.reach(stepper, packing, samples::study_law(), held).acceptable());
}

TEST_CASE("grains that have passed through each other are no consolidated packing") {
  auto const prepared = scarp::IsotropicPreparation{.pressure = 1e8}.prepare(
      samples::loose_cloud<samples::Discs>(60, 1), samples::study_law());
  CHECK(prepared.verdict == Verdict{Status::failed, Reason::too_deep});
}
