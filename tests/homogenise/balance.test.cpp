// SPDX-License-Identifier: BSL-1.0
#include "scarp/homogenise/balance.hpp"

#include <doctest/doctest.h>

#include "../../examples/shared/sliding_contacts.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using samples::Discs;
using scarp::Tensor;
using scarp::Vector;
using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;
using BondedDiscs = scarp::Packing<scarp::Disc, Bond>;

/// Two discs of 5 mm that overlap by 10 um: a normal force of 60 N, Coulomb's limit at 33 N.
template <class PackingType>
PackingType two_discs(double shear) {
  auto packing = samples::place<PackingType>(Tensor<2>::Identity() * 0.1, {{5e-3}, {5e-3}},
                                             {Vector<2>(0.02, 0.05), Vector<2>(0.02 + 9.99e-3, 0.05)});
  REQUIRE(scarp::rebuild_pairs(packing, 1e-4).acceptable());
  REQUIRE(packing.pairs.count() == 1);
  packing.pairs.shear(0, 0) = shear;
  return packing;
}

}  // namespace

TEST_CASE("balance() sees what a step observes") {
  auto const law = samples::study_law();
  auto packing = two_discs<Discs>(20.0);
  auto const state = scarp::balance(packing, law);
  scarp::StepObservation<2> seen;
  REQUIRE(scarp::TimeStepper<Discs>{}.observe(packing, law, seen).acceptable());
  CHECK((state.stress - seen.stress).norm() < 1e-12 * seen.stress.norm());  // round-off: sums in another order
  CHECK(state.contacts == seen.contacts);
  CHECK(state.unbalanced_ratio == samples::Approx(seen.unbalanced_ratio));
  CHECK(state.deepest_overlap == samples::Approx(seen.deepest_overlap));
  CHECK(state.deepest_overlap == samples::Approx(1e-5 / 2.5e-3).epsilon(1e-9));  // analytic: over half the radius
}

TEST_CASE("a contact counts as sliding as long as it refuses more shear force") {
  auto const law = samples::study_law();
  CHECK(examples::sliding_share(two_discs<Discs>(33.0), law) == 1.0);
  CHECK(examples::sliding_share(two_discs<Discs>(-33.0), law) == 1.0);
  // While grains move, the normal force has grown a little since the last slip.
  CHECK(examples::sliding_share(two_discs<Discs>(32.99), law) == 1.0);
  CHECK(examples::sliding_share(two_discs<Discs>(31.0), law) == 0.0);
  CHECK(examples::sliding_share(two_discs<Discs>(0.0), law) == 0.0);
}

TEST_CASE("an intact bond beyond Coulomb's limit does not slide, a broken one does") {
  Bond const law{.law = samples::study_law(), .tensile_strength = 100.0, .shear_strength = 100.0};
  auto packing = two_discs<BondedDiscs>(50.0);
  scarp::ContactMemory<2, double> memory;
  Bond::bond(memory);
  packing.pairs.scalars(0, 0) = memory.scalars[0];
  auto const bonded = scarp::balance(packing, law);
  CHECK(examples::sliding_share(packing, law) == 0.0);
  // Analytic: a force of 60 N along x and 50 N across, on a branch of 9.99 mm, in a volume of 0.002 m3.
  CHECK(bonded.stress(0, 0) == samples::Approx(-60.0 * 9.99e-3 / 2e-3).epsilon(1e-9));  // overlap is a small difference
  CHECK(bonded.stress(1, 0) == samples::Approx(-50.0 * 9.99e-3 / 2e-3).epsilon(1e-9));
  packing.pairs.scalars(0, 0) = 0.0;
  CHECK(examples::sliding_share(packing, law) == 1.0);
}

TEST_CASE("moving grains carry a pressure of mass times velocity squared over the content") {
  scarp::Tensor<2> cell;
  cell << 0.1, 0.02, 0.0, 0.2;
  auto packing = samples::place<samples::SmoothDiscs>(cell, {{5e-3}, {2e-3}}, {{0.02, 0.05}, {0.07, 0.1}});
  CHECK(scarp::kinetic_stress(packing).isZero(0.0));
  packing.velocity(0, 0) = 3.0;
  packing.velocity(0, 1) = -2.0;
  packing.velocity(1, 1) = 5.0;
  // Analytic: -sum m v v / V.
  auto const mass = [](double radius) {
    return samples::density * samples::thickness * scarp::Disc::content({radius});
  };
  double const content = 0.1 * 0.2 * samples::thickness;
  auto const stress = scarp::kinetic_stress(packing);
  CHECK(stress(0, 0) == samples::Approx(-9.0 * mass(5e-3) / content).epsilon(1e-12));
  CHECK(stress(0, 1) == samples::Approx(6.0 * mass(5e-3) / content).epsilon(1e-12));
  CHECK(stress(1, 0) == stress(0, 1));
  CHECK(stress(1, 1) == samples::Approx(-(4.0 * mass(5e-3) + 25.0 * mass(2e-3)) / content).epsilon(1e-12));
}
