// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <type_traits>

#include "../../benchmarks/shared/state_bytes.hpp"
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
static_assert(scarp::RowLayout<scarp::Disc, scarp::LinearFrictional>::used == 6,
              "position, velocity, spin and radius of a disc: no mass and no species");

}  // namespace

TEST_CASE("the state of four hundred ellipses fits in 150 kilobytes") {
  auto const& packing = samples::consolidated<Ellipses>(400).packing;
  MESSAGE("bytes of a state: " << benchmarks::state_bytes(packing));
  CHECK(benchmarks::state_bytes(packing) <= 150'000);
  CHECK(benchmarks::state_bytes(packing) > 400 * 7 * sizeof(double));  // places, velocities, spins, directions at least
}

TEST_CASE("copies of a state share their grains") {
  auto const& packing = samples::consolidated<Ellipses>(400).packing;
  auto const copy = packing;
  CHECK(copy.population.get() == packing.population.get());
  CHECK(copy == packing);
}
