// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/surface_profile.hpp"

#include <doctest/doctest.h>

#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

constexpr double round_off = 1e-12;

/// Positions at rest lie 1 m below the mesh, as if the ground had settled; then it settles by 0.25 x and moves along by
/// 0.5.
template <class Element>
struct Moved {
  std::vector<scarp::Vector<Element::dim>> rest;
  std::vector<scarp::Vector<Element::dim>> now;

  explicit Moved(scarp::Mesh<Element> const& mesh) : rest(mesh.nodes), now(mesh.nodes) {
    constexpr int up = Element::dim - 1;
    for (std::size_t n = 0; n < rest.size(); ++n) {
      rest[n](up) -= 1.0;
      now[n](up) -= 1.0 + 0.25 * rest[n](0);
      now[n](0) += 0.5;
    }
  }
};

}  // namespace

TEST_CASE_TEMPLATE("the profile of a slab runs along x through all nodes of its surface, whatever its elements",
                   Element, scarp::Tri3, scarp::Tri6, scarp::Quad4, scarp::Quad8, scarp::Tet4, scarp::Tet10,
                   scarp::Hex8, scarp::Hex20) {
  scarp::BoxMesh<Element> box;
  box.lengths(0) = 4.0;
  box.cells.fill(2);
  box.cells[0] = 4;
  auto const mesh = box.generate();
  Moved<Element> const moved(mesh);
  auto const profile = scarp::surface_profile(mesh, moved.rest, moved.now, {"top"});
  // Analytic: four cells along x, with a further node in the middle of each where sides are quadratic.
  std::size_t const parts = scarp::HasMidSides<Element> ? 8 : 4;
  REQUIRE(profile.size() == parts + 1);
  CHECK_FALSE(profile.front().joined);
  for (std::size_t k = 0; k <= parts; ++k) {
    double const x = 4.0 * static_cast<double>(k) / static_cast<double>(parts);
    CHECK(std::abs(profile[k].x_initial - x) < round_off);
    CHECK(std::abs(profile[k].x - x - 0.5) < round_off);
    CHECK(std::abs(profile[k].settlement - 0.25 * x) < round_off);
    if (k > 0) CHECK(profile[k].joined);
  }
}

TEST_CASE("in space a place is the mean along the strike") {
  scarp::BoxMesh<scarp::Hex8> box;
  box.cells = {2, 3, 1};
  auto const mesh = box.generate();
  auto positions = mesh.nodes;
  for (auto& position : positions) position(2) -= position(0) * (1.0 + position(1));
  auto const profile = scarp::surface_profile(mesh, mesh.nodes, positions, {"top"});
  REQUIRE(profile.size() == 3);
  // Analytic: 1 + y over y = 0, 1/3, 2/3, 1 is 1.5 in the mean.
  CHECK(profile[1].settlement == samples::Approx(0.75).epsilon(round_off));
  CHECK(profile[2].settlement == samples::Approx(1.5).epsilon(round_off));
}

TEST_CASE("ground below a footing is part of the profile, and a gap without it") {
  for (bool const meshed : {true, false}) {
    auto mesh = scarp::FaultMesh{.size = 5.0}.generate({-15.0, -5.0});
    scarp::mark_footing_base(mesh, -10.0, 10.0);
    if (meshed) scarp::add_footing_block(mesh, 5.0, 5.0);
    Moved<scarp::Tri3> const moved(mesh);
    auto const whole = scarp::surface_profile(mesh, moved.rest, moved.now);
    for (std::size_t k = 1; k < whole.size(); ++k) CHECK(whole[k].joined);
    CHECK(scarp::settlement_at(whole, -10.0) == samples::Approx(-2.5).epsilon(round_off));
    auto const beside = scarp::surface_profile(mesh, moved.rest, moved.now, {"surface"});
    CHECK(beside.size() < whole.size());
    CHECK(std::count_if(beside.begin() + 1, beside.end(), [](auto const& point) { return !point.joined; }) == 1);
    auto const edge = std::find_if(beside.begin() + 1, beside.end(), [](auto const& point) { return !point.joined; });
    CHECK(edge->x_initial == -5.0);
    CHECK(std::isnan(scarp::settlement_at(beside, -10.0)));
    CHECK(scarp::settlement_at(beside, -5.0) == samples::Approx(-1.25).epsilon(round_off));
    CHECK(scarp::settlement_at(beside, -15.0) == samples::Approx(-3.75).epsilon(round_off));
  }
}

TEST_CASE("settlement is linear between the points and constant beyond them") {
  std::vector<scarp::SurfacePoint> const profile{
      {-20.0, -20.0, 0.0}, {-10.0, -10.0, 0.0}, {0.0, 0.0, 2.0}, {10.0, 10.0, 2.1}};
  CHECK(scarp::settlement_at(profile, -100.0) == 0.0);
  CHECK(scarp::settlement_at(profile, -12.0) == 0.0);
  CHECK(scarp::settlement_at(profile, -5.0) == samples::Approx(1.0).epsilon(round_off));
  CHECK(scarp::settlement_at(profile, 0.0) == 2.0);
  CHECK(scarp::settlement_at(profile, 5.0) == samples::Approx(2.05).epsilon(round_off));
  CHECK(scarp::settlement_at(profile, 100.0) == 2.1);
  CHECK(std::isnan(scarp::settlement_at({}, 0.0)));
}

TEST_CASE("positions of another mesh and unknown boundaries are refused") {
  auto const mesh = scarp::BoxMesh<scarp::Tri3>{}.generate();
  CHECK_REFUSED(scarp::surface_profile(mesh, {}, mesh.nodes, {"top"}), "0 are given");
  CHECK_REFUSED(scarp::surface_profile(mesh, mesh.nodes, {}, {"top"}), "0 are given");
  CHECK_REFUSED(scarp::surface_profile(mesh, mesh.nodes, mesh.nodes), "'surface'", "top");  // no "surface"
}

TEST_CASE("without positions at rest settlement counts from the mesh") {
  auto const mesh = scarp::BoxMesh<scarp::Tri3>{}.generate();
  scarp::GroundAtRest<2> rest;
  CHECK(rest.of(mesh.nodes) == mesh.nodes);
  rest.positions = mesh.nodes;
  rest.positions.front().x() = 7.0;
  CHECK(rest.of(mesh.nodes) == rest.positions);
}
