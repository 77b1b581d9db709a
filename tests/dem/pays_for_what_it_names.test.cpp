// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <type_traits>

#include "support/packings.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using samples::SmoothDiscs;
using SmoothEllipses = scarp::Packing<scarp::Ellipse, scarp::Frictionless>;

template <class PackingType>
using OrientationOf = decltype(PackingType::orientation);
template <class PackingType>
using NormalOf = decltype(PackingType::pairs.normal);
template <class PackingType>
using ShearOf = decltype(PackingType::pairs.shear);

static_assert(std::is_empty_v<OrientationOf<Discs>> && !std::is_empty_v<OrientationOf<Ellipses>>,
              "a disc packing has no orientation");
static_assert(std::is_empty_v<NormalOf<Discs>> && !std::is_empty_v<NormalOf<Ellipses>>,
              "a disc packing stores no normals");
static_assert(std::is_empty_v<ShearOf<SmoothDiscs>> && std::is_empty_v<ShearOf<SmoothEllipses>> &&
                  !std::is_empty_v<ShearOf<Discs>>,
              "a frictionless packing has no tangential memory");
static_assert(sizeof(SmoothDiscs) < sizeof(Discs) && sizeof(Discs) < sizeof(Ellipses));
// A disc's row in the loop: place, velocity, spin, radius; an ellipse's has two more numbers, and both are padded to four.
static_assert(scarp::RowLayout<scarp::Disc, scarp::LinearFrictional>::used == 6 &&
              scarp::RowLayout<scarp::Ellipse, scarp::LinearFrictional>::used == 8);

template <class PackingType>
std::size_t bytes_of(PackingType packing, typename PackingType::Law const& law) {
  scarp::TimeStepper<PackingType> stepper;
  REQUIRE(stepper.refresh(packing, law).acceptable());
  return scarp::state_bytes(packing);
}

}  // namespace

TEST_CASE("the state of a scene holds the numbers that its shape and law need and no more") {
  scarp::Frictionless const smooth{.normal_stiffness = 6e6};
  auto const frictional = bytes_of(samples::triangular_lattice<Discs>(4, 5e-3, 9.99e-3), samples::study_law());
  auto const frictionless = bytes_of(samples::triangular_lattice<SmoothDiscs>(4, 5e-3, 9.99e-3), smooth);
  // Analytic: 48 near pairs carry one shear force each; 16 grains and 48 pairs are whole multiples of the padding.
  CHECK(frictional - frictionless == 48 * sizeof(double) + sizeof(Discs) - sizeof(SmoothDiscs));
  // The same lattice of round ellipses adds two normals per pair and two directions per grain.
  Ellipses round = [] {
    auto const discs = samples::triangular_lattice<Discs>(4, 5e-3, 9.99e-3);
    std::vector<scarp::Vector<2>> places;
    for (std::size_t i = 0; i < discs.grain_count(); ++i)
      places.emplace_back(discs.position(i, 0), discs.position(i, 1));
    return samples::place<Ellipses>(discs.cell, {16, {5e-3, 5e-3}}, places);
  }();
  auto const ellipses = bytes_of(round, samples::study_law());
  CHECK(ellipses - frictional == (2 * 48 + 2 * 16) * sizeof(double) + sizeof(Ellipses) - sizeof(Discs));
}

TEST_CASE("the state of four hundred ellipses fits in 150 kilobytes") {
  auto const& packing = samples::consolidated<Ellipses>(400).packing;
  MESSAGE("bytes of a state: " << scarp::state_bytes(packing));
  CHECK(scarp::state_bytes(packing) <= 150'000);
  CHECK(scarp::state_bytes(packing) > 400 * 7 * sizeof(double));  // places, velocities, spins, directions at least
}

TEST_CASE("copies of a state share their grains") {
  auto const& packing = samples::consolidated<Ellipses>(400).packing;
  auto const copy = packing;
  CHECK(copy.population.get() == packing.population.get());
  CHECK(copy == packing);
}
