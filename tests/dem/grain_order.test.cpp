// SPDX-License-Identifier: BSL-1.0
// Grains have numbers, and pairs an order, for the computer only.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "scarp/dem/time_stepping.hpp"
#include "support/packings.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using scarp::Tensor;
using scarp::Vector;

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  scarp::Random random(seed);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  return order;
}

template <int Count>
void reorder(scarp::SoaArray<double, Count>& columns, std::vector<std::size_t> const& new_of) {
  auto const old = columns;
  for (std::size_t i = 0; i < new_of.size(); ++i) columns.set_row(new_of[i], old.row(i));
}

/// The same packing with grain i under the number new_of[i] and its list of pairs, memories included, in another order.
template <class PackingType>
PackingType renumbered(PackingType packing, std::vector<std::size_t> const& new_of) {
  std::vector<typename PackingType::Shape::template Size<double>> sizes(new_of.size());
  for (std::size_t i = 0; i < new_of.size(); ++i) sizes[new_of[i]] = packing.population->size(i);
  packing.population = std::make_shared<scarp::Population<typename PackingType::Shape> const>(
      sizes, packing.population->density(), packing.population->thickness());
  reorder(packing.position, new_of);
  reorder(packing.velocity, new_of);
  reorder(packing.spin, new_of);
  reorder(packing.orientation, new_of);
  auto& pairs = packing.pairs;
  auto const grains = static_cast<std::int32_t>(new_of.size());
  auto const renamed = [&](std::int32_t grain) {
    return grain < grains ? static_cast<std::int32_t>(new_of[static_cast<std::size_t>(grain)]) : grain;
  };
  auto const pair_order = shuffled(pairs.count(), 99);
  auto const first = pairs.first;
  auto const second = pairs.second;
  for (std::size_t p = 0; p < first.size(); ++p) {
    pairs.first[pair_order[p]] = renamed(first[p]);
    pairs.second[pair_order[p]] = renamed(second[p]);
  }
  reorder(pairs.normal, pair_order);
  reorder(pairs.shear, pair_order);
  for (auto& owner : pairs.ghost_owner) owner = renamed(owner);
  return packing;
}

/// Under pressure and sheared a little, so that contacts hold and slide, at rest.
template <class PackingType>
PackingType sheared_sample() {
  auto packing = samples::consolidated<PackingType>(80).packing;
  scarp::TimeStepper<PackingType> stepper;
  Tensor<2> strain;
  strain << 1e-5, 1e-5, 0.0, -1e-5;
  for (int step = 0; step < 200; ++step) REQUIRE(stepper.step(packing, samples::study_law(), strain).acceptable());
  packing.rest();
  return packing;
}

template <class PackingType>
double velocity_difference(PackingType const& a, PackingType const& b, std::vector<std::size_t> const& new_of) {
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < new_of.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      worst = std::max(worst, std::abs(a.velocity(i, axis) - b.velocity(new_of[i], axis)));
      largest = std::max(largest, std::abs(a.velocity(i, axis)));
    }
  }
  return worst / largest;
}

}  // namespace

TEST_CASE_TEMPLATE("forces and stress do not depend on how grains and contacts are numbered", PackingType, Discs,
                   Ellipses) {
  auto const law = samples::study_law();
  auto packing = sheared_sample<PackingType>();
  scarp::TimeStepper<PackingType> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  for (std::uint64_t const seed : {1ULL, 2ULL, 3ULL}) {
    auto const new_of = shuffled(packing.grain_count(), seed);
    auto other = renumbered(packing, new_of);
    auto moved = packing;
    scarp::StepObservation<2> seen, seen_other;
    REQUIRE(stepper.template step<scarp::Observe::balance>(moved, law, Tensor<2>::Zero(), &seen).acceptable());
    REQUIRE(stepper.template step<scarp::Observe::balance>(other, law, Tensor<2>::Zero(), &seen_other).acceptable());
    REQUIRE(seen.contacts > 100.0);
    CHECK(seen_other.contacts == seen.contacts);
    // From rest, a grain's velocity is its force times time step over mass. Sums of some ten forces round differently.
    double worst_force = 0.0;
    double worst_torque = 0.0;
    double largest_force = 0.0;
    double const time_step = packing.pairs.critical_step;
    for (std::size_t i = 0; i < new_of.size(); ++i) {
      double const mass = 1.0 / packing.population->inverse_mass()[i];
      double const inertia = 1.0 / packing.population->inverse_inertia()[i];
      Vector<2> const force = mass / time_step * Vector<2>(moved.velocity(i, 0), moved.velocity(i, 1));
      Vector<2> const again = mass / time_step * Vector<2>(other.velocity(new_of[i], 0), other.velocity(new_of[i], 1));
      largest_force = std::max(largest_force, force.norm());
      worst_force = std::max(worst_force, (force - again).norm());
      worst_torque =
          std::max(worst_torque, std::abs(inertia / time_step * (moved.spin(i, 0) - other.spin(new_of[i], 0))));
    }
    double const contact_force =
        seen.stress.norm() * 5e-3 * samples::thickness;  // typical: pressure x radius x thickness
    REQUIRE(largest_force > 1e-3 * contact_force);
    CHECK(worst_force < 1e-13 * contact_force);
    CHECK(worst_torque < 1e-13 * contact_force * 5e-3);
    CHECK((seen.stress - seen_other.stress).norm() < 1e-13 * seen.stress.norm());
  }
}

TEST_CASE_TEMPLATE("a list made anew knows renumbered grains again", PackingType, Discs, Ellipses) {
  auto packing = sheared_sample<PackingType>();
  auto const new_of = shuffled(packing.grain_count(), 4);
  auto other = renumbered(packing, new_of);
  double const skin = packing.pairs.skin;
  REQUIRE(scarp::rebuild_pairs(packing, skin).acceptable());
  REQUIRE(scarp::rebuild_pairs(other, skin).acceptable());
  auto const shears = [](PackingType const& of) {
    std::vector<double> values;
    for (std::size_t p = 0; p < of.pairs.count(); ++p) values.push_back(of.pairs.shear(p, 0));
    std::sort(values.begin(), values.end());
    return values;
  };
  CHECK(shears(packing) == shears(other));
  CHECK(shears(packing).back() > 1.0);
}

TEST_CASE_TEMPLATE("a short path does not depend on numbers either", PackingType, Discs, Ellipses) {
  auto const law = samples::study_law();
  auto packing = sheared_sample<PackingType>();
  auto const new_of = shuffled(packing.grain_count(), 5);
  auto other = renumbered(packing, new_of);
  scarp::TimeStepper<PackingType> stepper;
  Tensor<2> strain;
  strain << 2e-5, 3e-5, 0.0, -1e-5;
  scarp::StepObservation<2> seen, seen_other;
  int lists = 0;
  for (int step = 0; step < 300; ++step) {
    double const drift = packing.pairs.drift;
    REQUIRE(stepper.template step<scarp::Observe::balance>(packing, law, strain, &seen).acceptable());
    REQUIRE(stepper.template step<scarp::Observe::balance>(other, law, strain, &seen_other).acceptable());
    if (packing.pairs.drift < drift) ++lists;
  }
  CHECK(lists >= 1);
  double const difference = velocity_difference(packing, other, new_of);
  double const stress_difference = (seen.stress - seen_other.stress).norm() / seen.stress.norm();
  MESSAGE("after 300 steps velocities differ by " << difference << ", stresses by " << stress_difference);
  // Round-off of 1e-17 m in places of 0.1 m is 1e-12 of overlaps of 1e-5 m, and sliding lets it grow; unbalanced
  // forces, which the velocities follow, are a thousandth of those at the contacts.
  CHECK(stress_difference < 1e-10);
  CHECK(difference < 1e-7);
}
