// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/neighbour_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/shape/clump.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using scarp::Reason;
using scarp::Status;
using scarp::Tensor;
using scarp::Vector;
using scarp::Verdict;

using Dumbbells = scarp::Packing<scarp::Clump<scarp::DumbbellTemplate>, scarp::LinearFrictional>;

/// Lower grain, higher grain, gap.
using Meeting = std::tuple<std::size_t, std::size_t, double>;

void add_meeting(std::vector<Meeting>& meetings, std::size_t i, std::size_t j, double gap) {
  meetings.emplace_back(std::min(i, j), std::max(i, j), gap);
}

/// Every pair of a grain with every image of another within several cells, found by trying all: each pair once.
template <class PackingType>
std::vector<Meeting> all_meetings(PackingType const& packing, double skin) {
  constexpr int cells = 8;
  constexpr std::size_t parts = scarp::part_count<typename PackingType::Shape>();
  std::vector<Meeting> meetings;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (std::size_t j = i; j < packing.grain_count(); ++j) {
      for (int u = -cells; u <= cells; ++u) {
        for (int v = -cells; v <= cells; ++v) {
          if (i == j && (u < 0 || (u == 0 && v <= 0))) continue;
          Vector<2> const shift = packing.cell * Vector<2>(u, v);
          auto const from = scarp::row_position(packing, i * parts);
          auto const to = scarp::row_position(packing, j * parts);
          scarp::Point<2, double> const branch{to[0] + shift(0) - from[0], to[1] + shift(1) - from[1]};
          double const distance = std::hypot(branch[0], branch[1]);
          if (distance > 2.0 * packing.population->largest_radius() + skin) continue;
          for (std::size_t k = 0; k < parts * parts; ++k) {
            auto const touch = scarp::converged_contact<typename PackingType::Shape>(
                scarp::row_pose(packing, i * parts + k / parts), scarp::row_pose(packing, j * parts + k % parts),
                branch, {branch[0] / distance, branch[1] / distance});
            if (-touch.overlap <= skin) add_meeting(meetings, i, j, -touch.overlap);
          }
        }
      }
    }
  }
  std::sort(meetings.begin(), meetings.end());
  return meetings;
}

template <class PackingType>
std::vector<Meeting> listed_meetings(PackingType const& packing, typename PackingType::Law const& law) {
  std::vector<Meeting> meetings;
  scarp::for_each_near_pair(packing, law, [&](scarp::Contact<2> const& contact) {
    add_meeting(meetings, contact.first, contact.second, -contact.touch.overlap);
  });
  std::sort(meetings.begin(), meetings.end());
  return meetings;
}

/// Grains thrown anywhere, overlapping at will and lying up to two cells outside; sizes from 1 to `ratio`.
template <class PackingType>
PackingType random_heap(scarp::Random& random, int grains, double ratio, double side, double shear) {
  Tensor<2> cell;
  cell << side, shear * side, 0.1 * side, side * random.uniform(0.8, 1.3);
  std::vector<typename PackingType::Shape::template Size<double>> sizes;
  std::vector<Vector<2>> places;
  std::vector<double> angles;
  for (int i = 0; i < grains; ++i) {
    double const size = std::pow(ratio, random.uniform());
    if constexpr (PackingType::Shape::size_count == 1) {
      sizes.push_back({size});
    } else {
      sizes.push_back({size, size * random.uniform(0.6, 1.0)});
    }
    Vector<2> inside;
    inside(0) = random.uniform(-2.0, 3.0);
    inside(1) = random.uniform(-2.0, 3.0);
    places.emplace_back(cell * inside);
    angles.push_back(random.uniform(0.0, 3.0));
  }
  return samples::place<PackingType>(cell, sizes, places, angles);
}

/// The same grains at rest, with contacts of another law that have not met yet.
template <class Law, class PackingType>
auto with_law(PackingType const& grains) {
  scarp::Packing<typename PackingType::Shape, Law> same;
  same.population = grains.population;
  same.cell = grains.cell;
  same.position = grains.position;
  same.orientation = grains.orientation;
  same.rest();
  return same;
}

/// The list that a stepper makes of these grains for a law.
template <class Law, class PackingType>
auto list_for(PackingType const& grains, Law const& law) {
  auto same = with_law<Law>(grains);
  scarp::TimeStepper<decltype(same)> const stepper;
  REQUIRE(stepper.refresh(same, law).acceptable());
  return std::pair{same.pairs.first, same.pairs.second};
}

}  // namespace

TEST_CASE_TEMPLATE(
    "the list is that of the grains, whatever their law; only a law that acts across a gap has a longer one",
    PackingType, Discs, Ellipses) {
  auto const& grains = samples::consolidated<PackingType>(80).packing;
  auto const law = samples::study_law();
  auto const listed = list_for(grains, law);
  REQUIRE(listed.first.size() > 80);
  CHECK(list_for(grains, scarp::Frictionless{.normal_stiffness = 6e6}) == listed);
  CHECK(list_for(grains, scarp::HertzMindlin<>::of({.modulus = 1e9, .poisson = 0.3}, 0.5)) == listed);

  using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;
  CHECK(list_for(grains, Bond{.law = law}) == listed);
  Bond const pulled{.law = law, .tensile_strength = 0.1 * law.normal_stiffness * grains.population->largest_radius()};
  auto const longer = list_for(grains, pulled);
  CHECK(longer.first.size() > listed.first.size());
  // The reach of 0.1 radii is as another skin of that width.
  auto wider = with_law<scarp::LinearFrictional>(grains);
  double const skin = scarp::TimeStepper<PackingType>{}.skin_ratio * grains.population->largest_radius();
  REQUIRE(scarp::rebuild_pairs(wider, skin + pulled.interaction_range()).acceptable());
  CHECK(longer == std::pair{wider.pairs.first, wider.pairs.second});
}

TEST_CASE_TEMPLATE("the list holds every near pair of all images once", PackingType, Discs, Ellipses, Dumbbells) {
  scarp::Random random(17);
  auto const law = samples::study_law();
  for (double const ratio : {1.0, 3.0, 10.0}) {
    for (double const shear : {0.0, 0.4, -0.9, 2.3}) {
      CAPTURE(ratio);
      CAPTURE(shear);
      int const grains = ratio < 5.0 ? 60 : 40;
      double const side = 4.0 * ratio + 0.25 * std::sqrt(static_cast<double>(grains)) * ratio;
      double const skin = 0.1 * ratio;
      auto packing = random_heap<PackingType>(random, grains, ratio, side, shear);
      auto const expected = all_meetings(packing, skin);
      REQUIRE(scarp::rebuild_pairs(packing, skin).acceptable());
      auto const listed = listed_meetings(packing, law);
      REQUIRE(expected.size() > 20);
      REQUIRE(listed.size() == expected.size());
      int compared = 0;
      for (std::size_t k = 0; k < listed.size(); ++k) {
        CHECK(std::get<0>(listed[k]) == std::get<0>(expected[k]));
        CHECK(std::get<1>(listed[k]) == std::get<1>(expected[k]));
        // Grains on top of each other have several directions of least overlap; which one is found depends on the
        // start.
        if (std::get<2>(expected[k]) < -0.1) continue;
        ++compared;
        // Round-off of positions up to 100 sizes, where flat minima amplify it.
        CHECK(std::abs(std::get<2>(listed[k]) - std::get<2>(expected[k])) < 1e-10 * ratio);
      }
      CHECK(compared > 5);
    }
  }
}

TEST_CASE_TEMPLATE("a new list of the same grains keeps normals and shear forces, also over a change of base",
                   PackingType, Discs, Ellipses) {
  auto const law = samples::study_law();
  PackingType packing = samples::consolidated<PackingType>(80).packing;
  Tensor<2> const stress = scarp::balance(packing, law).stress;
  auto const shears = [&](PackingType const& of) {
    std::vector<double> values;
    scarp::for_each_contact(of, law, [&](auto const& contact) { values.push_back(contact.memory.shear); });
    std::sort(values.begin(), values.end());
    return values;
  };
  auto const before = shears(packing);
  double const largest = std::max(-before.front(), before.back());
  REQUIRE(largest > 1.0);
  double const skin = packing.pairs.skin;
  REQUIRE(scarp::rebuild_pairs(packing, skin).acceptable());
  auto const after = shears(packing);
  REQUIRE(after.size() == before.size());
  for (std::size_t k = 0; k < after.size(); ++k) CHECK(std::abs(after[k] - before[k]) < 1e-12 * largest);
  CHECK((scarp::balance(packing, law).stress - stress).norm() < 1e-12 * stress.norm());

  // The same lattice in base vectors that need a reduction; ghosts are renamed with them.
  auto sheared = packing;
  sheared.cell.col(1) += 3.0 * sheared.cell.col(0);
  for (auto& shift : sheared.pairs.ghost_shift) shift[0] = static_cast<std::int8_t>(shift[0] - 3 * shift[1]);
  CHECK((scarp::balance(sheared, law).stress - stress).norm() < 1e-10 * stress.norm());
  REQUIRE(scarp::rebuild_pairs(sheared, skin).acceptable());
  CHECK((sheared.cell - packing.cell).norm() < 1e-14);
  CHECK(sheared.pairs.count() == packing.pairs.count());
  // Overlaps of 1e-5 m are differences of places up to 0.5 m: 1e-16 x 0.5 / 1e-5.
  CHECK((scarp::balance(sheared, law).stress - stress).norm() < 1e-10 * stress.norm());
}

TEST_CASE("under simple shear of three hundred per cent no change of the list touches the stress") {
  auto const law = samples::study_law();
  Ellipses packing = samples::consolidated<Ellipses>(60).packing;
  scarp::TimeStepper<Ellipses> stepper;
  Tensor<2> strain = Tensor<2>::Zero();
  strain(0, 1) = 3e-4;
  int changes_of_base = 0;
  double worst = 0.0;
  for (int step = 1; step <= 10'000; ++step) {
    Tensor<2> const before = packing.cell;
    REQUIRE(stepper.step(packing, law, strain).acceptable());
    // A step moves the cell by 3e-4 of its size; a change of base moves a base vector by a whole other one.
    if ((packing.cell - before).norm() > 0.1 * before.norm()) ++changes_of_base;
    if (step % 250 != 0) continue;
    auto renewed = packing;
    REQUIRE(scarp::rebuild_pairs(renewed, packing.pairs.skin).acceptable());
    Tensor<2> const stress = scarp::balance(packing, law).stress;
    worst = std::max(worst, (scarp::balance(renewed, law).stress - stress).norm() / stress.norm());
  }
  CHECK(changes_of_base >= 2);
  MESSAGE("largest relative change of stress over a renewed list: " << worst);
  CHECK(worst < 1e-10);  // round-off of positions of 0.1 m over overlaps of 1e-5 m, with a margin
  CHECK(packing.void_ratio() < 0.6);
}

TEST_CASE_TEMPLATE("a cell thinner than two grains is refused as collapsed", PackingType, Discs, Ellipses) {
  auto packing = samples::loose_cloud<PackingType>(10, 3);
  packing.cell = Tensor<2>::Identity() * 1.9 * packing.population->largest_radius();
  CHECK(scarp::rebuild_pairs(packing, 1e-4) == Verdict{Status::failed, Reason::cell_collapsed});
  packing.cell = Tensor<2>::Identity();
  packing.cell(1, 1) = -1.0;  // inside out
  CHECK(scarp::rebuild_pairs(packing, 1e-4) == Verdict{Status::failed, Reason::cell_collapsed});
  packing.cell(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(scarp::rebuild_pairs(packing, 1e-4) == Verdict{Status::failed, Reason::cell_collapsed});
}

TEST_CASE("only the reduced cell counts as thin") {
  // Row on row of the same lattice, but with base vectors sheared so far that their parallelogram is thinner than a
  // grain.
  auto packing = samples::triangular_lattice<Discs>(4, 5e-3, 1e-2);
  packing.cell.col(1) += 3.0 * packing.cell.col(0);
  CHECK(scarp::cell_is_wide_enough(packing, 1e-4));
  CHECK(scarp::rebuild_pairs(packing, 1e-4).acceptable());
}

TEST_CASE_TEMPLATE("a position that is no number is reported and never hangs", PackingType, Discs, Ellipses) {
  auto const law = samples::study_law();
  for (double const broken : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    auto packing = samples::loose_cloud<PackingType>(10, 3);
    packing.position(4, 1) = broken;
    CHECK(scarp::rebuild_pairs(packing, 1e-4) == Verdict{Status::failed, Reason::not_finite});
    // In the middle of a run the next moves carry it on until the list has to be made anew.
    auto running = samples::consolidated<PackingType>(80).packing;
    running.position(4, 1) = broken;
    scarp::TimeStepper<PackingType> stepper;
    Verdict verdict;
    for (int step = 0; step < 50 && verdict.acceptable(); ++step)
      verdict = stepper.step(running, law, Tensor<2>::Zero());
    CHECK(verdict == Verdict{Status::failed, Reason::not_finite});
  }
}

TEST_CASE_TEMPLATE("a grain that has been lost far away is reported, one some cells away is fetched", PackingType,
                   Discs, Ellipses) {
  auto const sound = samples::loose_cloud<PackingType>(10, 3);
  double const side = sound.cell(0, 0);
  for (double const cells : {2e6, -2e6, 1e12, -1e12, 1e300}) {
    auto packing = sound;
    packing.position(4, 1) = cells * side;
    auto const before = packing;
    CHECK(scarp::rebuild_pairs(packing, 1e-4) == Verdict{Status::failed, Reason::lost_grain});
    CHECK(packing == before);
  }
  auto packing = sound;
  packing.position(4, 1) += 1e5 * side;
  REQUIRE(scarp::rebuild_pairs(packing, 1e-4).acceptable());
  CHECK(std::abs(packing.position(4, 1) - sound.position(4, 1)) < 1e-10 * side);  // round-off at 1e5 cells
}

TEST_CASE("a grain that shoots away ends the run as a status") {
  auto const law = samples::study_law();
  auto packing = samples::consolidated<Discs>(80).packing;
  packing.velocity(4, 0) = 1e30;
  scarp::TimeStepper<Discs> stepper;
  Verdict verdict = stepper.step(packing, law, Tensor<2>::Zero());
  CHECK(verdict.acceptable());  // the move itself has nothing to look at
  verdict = stepper.step(packing, law, Tensor<2>::Zero());
  CHECK(verdict == Verdict{Status::failed, Reason::lost_grain});
}

TEST_CASE("a saved packing whose list leads outside its arrays is refused") {
  auto sound = samples::triangular_lattice<Discs>(4, 5e-3, 9.99e-3);
  REQUIRE(scarp::rebuild_pairs(sound, 1e-4).acceptable());
  REQUIRE(!sound.pairs.ghost_owner.empty());
  CHECK_NOTHROW(sound.after_loading());
  auto const refused = [&](auto const& change, std::string_view what) {
    auto packing = sound;
    change(packing);
    CHECK_REFUSED(packing.after_loading(), what);
  };
  auto const grains = static_cast<std::int32_t>(sound.grain_count());
  auto const rows = grains + static_cast<std::int32_t>(sound.pairs.ghost_owner.size());
  refused([](Discs& packing) { packing.pairs.first[7] = -1; }, "pairs name");
  refused([&](Discs& packing) { packing.pairs.first[7] = grains; }, "pairs name");
  refused([](Discs& packing) { packing.pairs.second[7] = packing.pairs.first[7]; }, "pairs name");
  refused([&](Discs& packing) { packing.pairs.second[7] = rows; }, "pairs name");
  refused([](Discs& packing) { packing.pairs.second.pop_back(); }, "arrays of pairs");
  refused([](Discs& packing) { packing.pairs.ghost_owner[0] = -1; }, "ghosts");
  refused([&](Discs& packing) { packing.pairs.ghost_owner[0] = grains; }, "ghosts");
  refused([](Discs& packing) { packing.pairs.ghost_shift.pop_back(); }, "arrays of pairs");
  refused([](Discs& packing) { packing.velocity.resize(packing.grain_count() - 1); }, "arrays of grains");
  refused([](Discs& packing) { packing.cell.col(0) *= -1.0; }, "cell");
  refused([](Discs& packing) { packing.population = nullptr; }, "arrays of grains");
}
