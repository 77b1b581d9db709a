// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/rupture_survey.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "support/approx.hpp"

namespace {

constexpr double width = 30.0;
constexpr double depth = 8.0;
constexpr double slope = 0.05;  // of settlement along x
constexpr double dip = 1.1;     // of the lines of equal settlement

/// Every element represents it exactly.
double settlement(scarp::Vector<2> const& place) { return slope * (place.x() + place.y() / std::tan(dip)); }

std::vector<scarp::Vector<2>> settled(std::vector<scarp::Vector<2>> positions) {
  for (auto& position : positions) position += scarp::Vector<2>(0.125, -settlement(position));
  return positions;
}

template <class Element>
scarp::BoxMesh<Element> box() {
  scarp::BoxMesh<Element> box;
  box.lengths = {width, depth};
  box.cells = {12, 5};
  box.distortion = 0.2;
  return box;
}

/// Renamed as the ground of a fault.
template <class Element>
scarp::Mesh<Element> ground() {
  auto mesh = box<Element>().generate();
  mesh.boundaries["surface"] = mesh.boundaries.at("top");
  return mesh;
}

}  // namespace

TEST_CASE_TEMPLATE("a level inside the ground shows the field on it, whatever the elements and their pattern", Element,
                   scarp::Tri3, scarp::Tri6, scarp::Quad4, scarp::Quad8) {
  auto const mesh = ground<Element>();
  auto const positions = settled(mesh.nodes);
  for (double const height : {0.3, depth / 4.0, 1.6, 4.0, 7.9}) {
    auto const profile = scarp::level_profile(mesh, mesh.nodes, positions, height);
    REQUIRE(profile.size() > 12);
    CHECK(std::abs(profile.front().x_initial) < 1e-12);
    CHECK(profile.back().x_initial == samples::Approx(width).epsilon(1e-12));
    for (std::size_t k = 0; k < profile.size(); ++k) {
      auto const& point = profile[k];
      // Analytic: linear along every line; round-off of coordinates of 30 m.
      CHECK(std::abs(point.settlement - settlement({point.x_initial, height})) < 1e-13);
      CHECK(std::abs(point.x - point.x_initial - 0.125) < 1e-13);
      CHECK(point.joined == (k > 0));
      if (k > 0) CHECK(point.x_initial > profile[k - 1].x_initial);
    }
  }
}

TEST_CASE_TEMPLATE("a band at a level has the place, widths and dip of the field", Element, scarp::Tri3, scarp::Tri6,
                   scarp::Quad4, scarp::Quad8) {
  auto const mesh = ground<Element>();
  scarp::FaultOffset const fault{.tip = 15.0, .foot = 0.25, .hanging = 1.25};
  auto const survey = scarp::rupture_survey(mesh, mesh.nodes, settled(mesh.nodes), fault);
  CHECK(survey.depth == depth);
  for (std::size_t k = 0; k < 3; ++k) {
    auto const& band = survey.bands[k];
    CHECK(band.height == samples::Approx(depth * (static_cast<double>(k) + 1.0) / 4.0).epsilon(1e-12));
    // Analytic: settlement 0.75 where x + y / tan(dip) = 15; nine tenths of the offset over 0.9 / slope = 18 m.
    CHECK(band.band_x50 == samples::Approx(15.0 - band.height / std::tan(dip)).epsilon(1e-12));
    CHECK(band.band_width == samples::Approx(18.0).epsilon(1e-12));
    CHECK(band.band_across == samples::Approx(18.0 * std::sin(dip)).epsilon(1e-12));
    CHECK(band.band_dip == samples::Approx(dip).epsilon(1e-12));
  }
  CHECK(survey.surface.surface_x50 == samples::Approx(15.0 - depth / std::tan(dip)).epsilon(1e-12));
  CHECK(survey.surface.rupture_dip == samples::Approx(dip).epsilon(1e-12));
}

TEST_CASE("a level through rows of nodes finds each of them once") {
  auto layer = scarp::FaultMesh{.left = -10.0, .right = 10.0, .depth = 10.0, .size = 2.5, .coarsening = 1.0};
  auto const mesh = layer.generate();
  auto const profile = scarp::level_profile(mesh, mesh.nodes, settled(mesh.nodes), 5.0);
  REQUIRE(profile.size() == 9);
  for (std::size_t k = 0; k < 9; ++k) CHECK(profile[k].x_initial == -10.0 + 2.5 * static_cast<double>(k));
  // The surface is the level's upper end, the bottom crosses nothing.
  auto const top = scarp::level_profile(mesh, mesh.nodes, settled(mesh.nodes), 10.0);
  auto const surface = scarp::surface_profile(mesh, mesh.nodes, settled(mesh.nodes));
  REQUIRE(top.size() == surface.size());
  for (std::size_t k = 0; k < top.size(); ++k)
    CHECK(top[k].settlement == samples::Approx(surface[k].settlement).epsilon(1e-12));
  CHECK(scarp::level_profile(mesh, mesh.nodes, mesh.nodes, 0.0).empty());
  CHECK(scarp::level_profile(mesh, mesh.nodes, mesh.nodes, 11.0).empty());
}

TEST_CASE("a hole in the ground is a gap of the level that crosses it") {
  auto mesh = box<scarp::Quad4>().generate();
  auto const inside = [&](auto const& nodes) {
    return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
      auto const& place = mesh.nodes[static_cast<std::size_t>(node)];
      return place.x() > 9.0 && place.x() < 21.0;
    });
  };
  std::erase_if(mesh.elements, inside);
  auto const profile = scarp::level_profile(mesh, mesh.nodes, settled(mesh.nodes), 4.0);
  CHECK(std::count_if(profile.begin() + 1, profile.end(), [](auto const& point) { return !point.joined; }) == 1);
}

TEST_CASE("settlement is linear on each half of a quadratic side") {
  // One element that settles by y^2: 0.25 at the nodes half way up.
  scarp::Mesh<scarp::Quad8> mesh;
  mesh.nodes = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.5, 0.0}, {1.0, 0.5}, {0.5, 1.0}, {0.0, 0.5}};
  mesh.elements = {{0, 1, 2, 3, 4, 5, 6, 7}};
  mesh.element_region = {0};
  mesh.regions = {"soil"};
  auto positions = mesh.nodes;
  for (auto& position : positions) position.y() -= position.y() * position.y();
  auto const profile = scarp::level_profile(mesh, mesh.nodes, positions, 0.25);
  REQUIRE(profile.size() == 2);
  CHECK(profile[0].settlement ==
        samples::Approx(0.125).epsilon(
            1e-12));  // linear from 0 at the bottom, half way to that node; the full side would give 0.25
}
