// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/time_stepping.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "../../examples/shared/energy_ledger.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "support/packings.hpp"

#include "support/approx.hpp"

namespace {

using samples::Discs;
using scarp::Tensor;
using scarp::Vector;

template <class PackingType>
scarp::TimeStepper<PackingType> undamped() {
  scarp::TimeStepper<PackingType> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  return stepper;
}

scarp::LinearFrictional stiffer(double factor) {
  auto law = samples::study_law();
  law.normal_stiffness *= factor;
  law.tangential_stiffness *= factor;
  return law;
}

/// A packing after a shear strain of 4e-3, and the energy that no term of the balance accounts for, over all that was
/// turned over.
struct Sheared {
  Discs packing;
  double gap = 0.0;
};

Sheared sheared(Discs packing, scarp::LinearFrictional const& law) {
  scarp::TimeStepper<Discs> stepper;
  stepper.time_step_share /=
      4.0;  // springs that stiffen all at once throw the grains: the balance's error falls with its square
  Tensor<2> strain = Tensor<2>::Zero();
  strain(0, 1) = 1e-5;
  examples::EnergyLedger<2> ledger;
  for (int step = 0; step < 400; ++step) {
    scarp::StepObservation<2> seen;
    double const volume = packing.volume();
    REQUIRE(stepper.step<scarp::Observe::energy>(packing, law, strain, &seen).acceptable());
    ledger.enter(seen, volume, strain);
  }
  double const turned_over = std::abs(ledger.stored) + ledger.contact_loss + ledger.damping_loss;
  return {packing, std::abs(ledger.gap()) / turned_over};
}

/// A law whose springs stiffen with depth, from two numbers.
struct Hardening {
  static constexpr scarp::ContactInputs inputs{};

  double normal_stiffness = 0.0;
  double growth = 0.0;  ///< [1/m]

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>&) const {
    T const overlap = scarp::lanes::at_least(approach.overlap, scarp::broadcast<T>(0));
    return {.normal = scarp::broadcast<T>(normal_stiffness) * overlap *
                      (scarp::broadcast<T>(1) + scarp::broadcast<T>(growth / 2.0) * overlap)};
  }
  scarp::ContactStiffness stiffness(double overlap, double) const {
    return {.normal = normal_stiffness * (1.0 + growth * overlap)};
  }
};
static_assert(scarp::ContactLaw<Hardening>);

template <class Law>
scarp::Packing<scarp::Disc, Law> lattice() {
  return samples::triangular_lattice<scarp::Packing<scarp::Disc, Law>>(4, 5e-3, 1e-2 * (1.0 - 1e-3));
}

/// Whether the step that a packing was given with one law is renewed when it goes on with another.
template <class Law>
bool is_renewed(Law const& before, Law const& after) {
  auto packing = lattice<Law>();
  scarp::TimeStepper<scarp::Packing<scarp::Disc, Law>> stepper;
  REQUIRE(stepper.refresh(packing, before).acceptable());
  double const of_before = packing.pairs.critical_step;
  REQUIRE(stepper.refresh(packing, after).acceptable());
  auto afresh = lattice<Law>();
  REQUIRE(stepper.refresh(afresh, after).acceptable());
  CHECK(packing.pairs.critical_step == samples::Approx(afresh.pairs.critical_step).epsilon(1e-12));
  return packing.pairs.critical_step != of_before;
}

}  // namespace

TEST_CASE("a packing goes on with a stiffer law as one that was listed with that law") {
  auto const& made = samples::consolidated<Discs>(64);
  REQUIRE(made.verdict.acceptable());
  for (double const factor : {10.0, 100.0}) {
    CAPTURE(factor);
    auto const law = stiffer(factor);
    auto listed_afresh = made.packing;
    listed_afresh.pairs.drift = std::numeric_limits<double>::infinity();
    auto const one = sheared(made.packing, law);
    auto const other = sheared(listed_afresh, law);
    CHECK(one.packing == other.packing);
    // The bound of the study for the energy that steps make or lose.
    CHECK(one.gap < 1e-3);
  }
}

TEST_CASE("the critical step follows every number of a law that it depends on, and the masses") {
  using Hertz = scarp::HertzMindlin<scarp::HertzRestitution>;
  CHECK(is_renewed(samples::study_law(), stiffer(0.5)));
  CHECK(is_renewed(Hardening{1e6, 0.0}, Hardening{1e6, 1e4}));
  CHECK(is_renewed(Hertz::of({.modulus = 1e9, .poisson = 0.3}, 0.5, {.restitution = 0.9}),
                   Hertz::of({.modulus = 1e9, .poisson = 0.3}, 0.5, {.restitution = 0.2})));
  // Preparations exchange the friction: nothing depends on it.
  auto smooth = samples::study_law();
  smooth.friction = 0.1;
  CHECK_FALSE(is_renewed(samples::study_law(), smooth));

  auto packing = lattice<scarp::LinearFrictional>();
  scarp::TimeStepper<Discs> stepper;
  REQUIRE(stepper.refresh(packing, samples::study_law()).acceptable());
  double const before = packing.pairs.critical_step;
  packing.population = std::make_shared<scarp::Population<scarp::Disc> const>(
      std::vector<std::array<double, 1>>(packing.grain_count(), {5e-3}), 4.0 * samples::density, samples::thickness);
  REQUIRE(stepper.refresh(packing, samples::study_law()).acceptable());
  CHECK(packing.pairs.critical_step == samples::Approx(2.0 * before).epsilon(1e-12));
}

TEST_CASE("a law that acts further than the one before finds the pairs within its reach") {
  using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;
  auto packing = samples::triangular_lattice<scarp::Packing<scarp::Disc, Bond>>(4, 5e-3, 1.15e-2);
  scarp::TimeStepper<scarp::Packing<scarp::Disc, Bond>> stepper;
  REQUIRE(stepper.refresh(packing, {samples::study_law(), 0.0, 0.0}).acceptable());
  CHECK(packing.pairs.count() == 0);
  REQUIRE(stepper.refresh(packing, {samples::study_law(), 6e6 * 2e-3, 0.0}).acceptable());
  CHECK(packing.pairs.count() == 3 * packing.grain_count());  // each grain has six neighbours 1.5 mm away
}

TEST_CASE("pairs that are not listed cannot come into a law's reach before the list is renewed") {
  using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;
  using Grains = scarp::Packing<scarp::Disc, Bond>;
  constexpr double radius = 5e-3;
  constexpr double law_reach = 4.5e-3;
  Bond const law{samples::study_law(), 6e6 * law_reach, 0.0};
  auto stepper = undamped<Grains>();
  // Two grains side by side, just too far apart to be listed.
  double const distance = 2.0 * radius + law_reach + stepper.skin_ratio * radius;
  auto packing = samples::place<Grains>(0.2 * Tensor<2>::Identity(), {{radius}, {radius}},
                                        {{0.05, 0.1}, {0.05 + 1.0001 * distance, 0.1}});
  REQUIRE(stepper.refresh(packing, law).acceptable());
  REQUIRE(packing.pairs.count() == 0);
  Tensor<2> closer = Tensor<2>::Zero();
  closer(0, 0) = -1e-4;
  for (int step = 0; packing.pairs.count() == 0; ++step) {
    REQUIRE(step < 1000);
    REQUIRE(packing.position(1, 0) - packing.position(0, 0) > 2.0 * radius + law_reach);
    REQUIRE(stepper.step(packing, law, closer).acceptable());
  }
}

namespace {

/// A disc whose touches are found up to an overlap, and not beyond.
struct Reluctant : scarp::Disc {
  static constexpr bool warm_starts_normal = true;
  template <class T>
  static scarp::ContactGeometry<2, T> touch(std::array<T, 1> const& first, std::array<T, 1> const& second,
                                            scarp::Point<2, T> const& branch, scarp::Point<2, T> const& normal) {
    auto touch = scarp::Disc::touch<T>(first, second, branch, normal);
    T const none = scarp::broadcast<T>(0);
    T const never = scarp::broadcast<T>(std::numeric_limits<double>::infinity());
    touch.normal_error = scarp::lanes::select(touch.overlap > scarp::broadcast<T>(1e-3), never, none);
    if (scarp::lanes::any_of(touch.normal_error > none)) touch.normal[0] = scarp::broadcast<T>(0.5);
    return touch;
  }
};

}  // namespace

TEST_CASE("a disc that spins in place does not wear out the list, an ellipse does by how far its ends move") {
  auto const law = samples::study_law();
  auto const spun = [&]<class PackingType>(PackingType packing) {
    auto stepper = undamped<PackingType>();
    REQUIRE(stepper.refresh(packing, law).acceptable());
    packing.spin(0, 0) = 10.0;  // [1/s]
    REQUIRE(stepper.step(packing, law, Tensor<2>::Zero()).acceptable());
    return packing;
  };
  Tensor<2> const cell = 20.0 * Tensor<2>::Identity();
  std::vector<Vector<2>> const places{{5.0, 5.0}, {15.0, 15.0}};  // apart
  CHECK(spun(samples::place<Discs>(cell, {{1.0}, {1.0}}, places)).pairs.drift == 0.0);
  auto const ellipses = spun(samples::place<samples::Ellipses>(cell, {{2.0, 1.0}, {2.0, 1.0}}, places, {0.0, 0.0}));
  double const half = ellipses.orientation(0, 1) / (1.0 + ellipses.orientation(0, 0));  // tangent of half the turn
  REQUIRE(half > 0.0);
  // Analytic: twice the way of the fastest end, since two grains may approach each other.
  CHECK(ellipses.pairs.drift == samples::Approx(2.0 * 2.0 * half * ellipses.population->largest_eccentricity()));
}

TEST_CASE("the drag on a grain that touches nothing is a rate: velocity and spin do not depend on the time step") {
  for (double const finer : {1.0, 2.0, 3.0}) {
    CAPTURE(finer);
    auto packing = samples::place<Discs>(20.0 * Tensor<2>::Identity(), {{1.0}, {1.0}}, {{5.0, 5.0}, {15.0, 15.0}});
    packing.velocity(0, 1) = 2.0;
    packing.spin(0, 0) = 3.0;
    scarp::TimeStepper<Discs> stepper;
    stepper.time_step_share /= finer;
    for (int step = 0; step < 500 * finer; ++step)
      REQUIRE(stepper.step(packing, samples::study_law(), Tensor<2>::Zero()).acceptable());
    // Analytic: 0.1 % in every step of the usual length; round-off of 1500 products.
    double const kept = std::pow(1.0 - 1e-3, 500.0);
    CHECK(packing.velocity(0, 1) == samples::Approx(2.0 * kept).epsilon(1e-12));
    CHECK(packing.spin(0, 0) == samples::Approx(3.0 * kept).epsilon(1e-12));
  }
}

TEST_CASE("a packing whose list of pairs fails stays as it was") {
  using Grains = scarp::Packing<Reluctant, scarp::LinearFrictional>;
  constexpr double radius = 5e-3;
  // A cell that is to be reduced, with a grain outside.
  Tensor<2> cell;
  cell << 0.05, 0.06, 0.0, 0.05;
  auto packing = samples::place<Grains>(cell, {{radius}, {radius}}, {{0.01, 0.02}, {0.035, 0.07}});
  REQUIRE(scarp::rebuild_pairs(packing, 1e-3).acceptable());
  REQUIRE(packing.cell != cell);
  packing.cell = cell;
  packing.position.set_row(0, {0.01, 0.02});
  packing.position.set_row(1, {0.018, 0.02});  // 2 mm deep
  auto const before = packing;
  CHECK(scarp::rebuild_pairs(packing, 1e-3) ==
        scarp::Verdict{scarp::Status::failed, scarp::Reason::unconverged_normal});
  CHECK(packing == before);
}

TEST_CASE("a strain that is no number ends the step before anything moves") {
  auto packing = samples::triangular_lattice<samples::Discs>(4, 5e-3, 9.9e-3);
  auto const before = packing;
  scarp::Tensor<2> strain = scarp::Tensor<2>::Zero();
  strain(0, 1) = std::numeric_limits<double>::quiet_NaN();
  scarp::TimeStepper<samples::Discs> stepper;
  CHECK(stepper.step(packing, samples::study_law(), strain) ==
        scarp::Verdict{scarp::Status::failed, scarp::Reason::not_finite});
  CHECK(packing.cell == before.cell);
}

namespace {
/// A spring that tells the slip of its step as a loss.
template <bool Shear>
struct Telling {
  static constexpr scarp::ContactInputs inputs{.shear = Shear, .motion = true};
  double normal_stiffness = 0.0;

  template <int Dim, class T>
  constexpr scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                                scarp::ContactMemory<Dim, T>&) const {
    T const none = scarp::broadcast<T>(0);
    return {
        .normal = scarp::broadcast<T>(normal_stiffness) * scarp::lanes::at_least(approach.overlap, none),
        .dissipated = scarp::lanes::select(
            approach.overlap > none, scarp::dot(approach.tangential_increment, approach.tangential_increment), none)};
  }
  template <int Dim, class T>
  constexpr T stored_energy(scarp::ContactKinematics<Dim, T> const& approach,
                            scarp::ContactMemory<Dim, T> const&) const {
    return scarp::broadcast<T>(0) * approach.overlap;
  }
  constexpr scarp::ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness}; }
};
}  // namespace

TEST_CASE_TEMPLATE("a law that names the motion is given the slip, whether or not it stores a shear force", Law,
                   Telling<true>, Telling<false>) {
  using Pair = scarp::Packing<scarp::Disc, Law>;
  auto pair = samples::place<Pair>(scarp::Tensor<2>::Identity(), {{0.1}, {0.1}}, {{0.3, 0.5}, {0.49, 0.5}});
  scarp::TimeStepper<Pair> stepper;
  stepper.time_step_share = 1e-3;
  scarp::Tensor<2> shear = scarp::Tensor<2>::Zero();
  shear(1, 0) = 1e-4;
  scarp::StepObservation<2> seen;
  for (int k = 0; k < 2; ++k)
    REQUIRE(stepper.template step<scarp::Observe::energy>(pair, Law{1.0}, shear, &seen).acceptable());
  CHECK(std::sqrt(seen.contact_loss) == samples::Approx(1e-4 * 0.19 / 2.0).epsilon(1e-3));  // half of it is a turn
}
