// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/strip_on_surface.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <set>

#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/ground.hpp"
#include "scarp/fault/tied_footing.hpp"
#include "scarp/mesh/mesh.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

constexpr double centre = -12.0;
constexpr double width = 7.0;
constexpr double height = 1.5;

template <class Element>
scarp::Mesh<Element> ground() {
  return scarp::StructuredGround<Element>{{.size = 2.0}}.mesh({centre - width / 2.0, centre + width / 2.0});
}

template <class Element>
scarp::Mesh<Element> with_block() {
  auto mesh = ground<Element>();
  scarp::mark_footing_base(mesh, centre, width);
  scarp::add_footing_block(mesh, height, 2.0);
  return mesh;
}

template <class Element>
double length(scarp::Mesh<Element> const& mesh, char const* name) {
  double sum = 0.0;
  for (auto const& facet : scarp::boundary(mesh, name)) {
    sum += (mesh.nodes[static_cast<std::size_t>(facet[1])] - mesh.nodes[static_cast<std::size_t>(facet[0])]).norm();
  }
  return sum;
}

#define PLANE_ELEMENTS scarp::Tri3, scarp::Tri6, scarp::Quad4, scarp::Quad8

}  // namespace

TEST_CASE_TEMPLATE("the surface below a footing becomes its base", Element, PLANE_ELEMENTS) {
  auto mesh = ground<Element>();
  auto const facets = scarp::boundary(mesh, "surface").size();
  scarp::mark_footing_base(mesh, centre, width);
  CHECK(length(mesh, "footing_base") == samples::Approx(width).epsilon(1e-13));
  CHECK(length(mesh, "surface") == samples::Approx(75.0 - width).epsilon(1e-13));
  CHECK(scarp::boundary(mesh, "surface").size() + scarp::boundary(mesh, "footing_base").size() == facets);
  for (int const node : scarp::boundary_nodes(mesh, "footing_base")) {
    auto const& place = mesh.nodes[static_cast<std::size_t>(node)];
    CHECK(place.y() == 25.0);
    CHECK(std::abs(place.x() - centre) <= width / 2.0);
  }
  scarp::mark_footing_base(mesh, centre, width);  // marked already, at the same place
  CHECK(length(mesh, "footing_base") == samples::Approx(width).epsilon(1e-13));
}

TEST_CASE_TEMPLATE("a block on the base shares its nodes", Element, PLANE_ELEMENTS) {
  auto const mesh = with_block<Element>();
  CHECK_NOTHROW(scarp::validate(mesh));
  CHECK(scarp::region_area(mesh, "footing", mesh.nodes) == samples::Approx(width * height).epsilon(1e-13));  // analytic
  CHECK(scarp::region_area(mesh, "soil", mesh.nodes) ==
        samples::Approx(75.0 * 25.0).epsilon(1e-12));  // analytic; round-off of 1e4 terms
  CHECK(length(mesh, "footing_top") == samples::Approx(width).epsilon(1e-13));
  std::set<std::pair<double, double>> places;
  for (auto const& node : mesh.nodes) places.insert({node.x(), node.y()});
  CHECK(places.size() == mesh.nodes.size());  // no two nodes at one place
  std::set<int> of_block;
  std::set<double> levels;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.element_region[e] != scarp::region_number(mesh, "footing")) continue;
    for (int const node : mesh.elements[e]) {
      of_block.insert(node);
      levels.insert(mesh.nodes[static_cast<std::size_t>(node)].y());
    }
  }
  for (int const node : scarp::boundary_nodes(mesh, "footing_base")) CHECK(of_block.count(node) == 1);
  CHECK(levels.count(25.75) == 1);  // two rows, though one of 1.5 m is nearer to the wanted 2 m
}

TEST_CASE("the tied footing on crossed triangles is the one of former releases") {
  // Regression: at commit e668971 FaultMesh{.size = 1.25, .footing = Footing{-12.0, 7.0, 1.5}} had these numbers; the
  // places of all nodes were compared bit for bit when the block came here.
  auto mesh = scarp::FaultMesh{}.generate({-15.5, -8.5});
  scarp::mark_footing_base(mesh, centre, width);
  scarp::add_footing_block(mesh, height, 1.25);
  CHECK(mesh.nodes.size() == 2015);
  CHECK(mesh.elements.size() == 3888);
  CHECK(scarp::boundary(mesh, "footing_base").size() == 6);
}

TEST_CASE("an edge beside the corner nodes is refused with the nearest ones") {
  auto mesh = scarp::FaultMesh{.size = 2.5, .band_left = -52.0, .band_right = 23.0}.generate();
  CHECK_REFUSED(scarp::mark_footing_base(mesh, -9.0, 7.0), "x = -12.5 m", "-12.38095", "-14.85714 m");
  CHECK(mesh.boundaries.count("footing_base") == 0);
  auto quadratic = scarp::FaultMesh{.size = 2.0}.generate<scarp::Quad8>({-8.0, -10.0});
  CHECK_REFUSED(scarp::mark_footing_base(quadratic, -8.5, 1.0), "x = -9 m", "corner node");  // at a mid-side node
}

TEST_CASE("a base that the mesh has elsewhere is refused with both places") {
  auto mesh = ground<scarp::Tri3>();
  scarp::mark_footing_base(mesh, centre, width);
  CHECK_THROWS_WITH_AS(scarp::mark_footing_base(mesh, -11.0, width),
                       doctest::Contains("from x = -15.5 to -8.5 m (the footing reaches from -14.5 to -7.5 m)"),
                       scarp::InputError);
  mesh.boundaries["footing_base"].clear();
  CHECK_REFUSED(scarp::mark_footing_base(mesh, centre, width), "footing_base");
  CHECK_REFUSED(scarp::add_footing_block(mesh, height, 2.0), "footing_base", "no facets");
}

TEST_CASE("a footing over a gap in the surface is refused") {
  auto mesh = scarp::FaultMesh{}.generate({-16.0, -14.0, -12.0, -10.0});
  scarp::mark_footing_base(mesh, -13.0, 2.0);
  mesh.boundaries.erase("footing_base");
  CHECK_THROWS_WITH_AS(scarp::mark_footing_base(mesh, -13.0, 6.0),
                       doctest::Contains("put the footing where the surface"), scarp::InputError);
}

TEST_CASE("a block that the mesh has is taken as it is, if it is as high as the footing") {
  auto mesh = with_block<scarp::Tri6>();
  auto const elements = mesh.elements.size();
  scarp::add_footing_block(mesh, height, 2.0);
  CHECK(mesh.elements.size() == elements);
  CHECK_THROWS_WITH_AS(scarp::add_footing_block(mesh, 1.0, 2.0),
                       doctest::Contains("'footing_top' of the mesh is 1.5 m above the base (the footing is 1 m high)"),
                       scarp::InputError);
  auto pinched = mesh;
  for (auto& node : pinched.nodes) {
    if (node.y() > 25.0) node.x() = centre + (node.x() - centre) * (1.0 - 0.5 * (node.y() - 25.0) / height);
  }
  CHECK_THROWS_WITH_AS(scarp::add_footing_block(pinched, height, 2.0), doctest::Contains("make it a rectangle"),
                       scarp::InputError);
  mesh.boundaries.erase("footing_top");
  CHECK_THROWS_WITH_AS(scarp::add_footing_block(mesh, height, 2.0), doctest::Contains("no boundary 'footing_top'"),
                       scarp::InputError);
}

TEST_CASE("a base whose side has its node beside the middle cannot carry a block") {
  auto mesh = ground<scarp::Quad8>();
  scarp::mark_footing_base(mesh, centre, width);
  int const middle = scarp::boundary(mesh, "footing_base").front()[2];
  mesh.nodes[static_cast<std::size_t>(middle)].x() += 0.01;
  CHECK_THROWS_WITH_AS(scarp::add_footing_block(mesh, height, 2.0),
                       doctest::Contains("a side's node must be in its middle"), scarp::InputError);
}

TEST_CASE("sizes of footings that are not positive or not finite are refused") {
  auto mesh = ground<scarp::Tri3>();
  double const nan = std::numeric_limits<double>::quiet_NaN();
  for (double const wrong : {nan, 0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    CHECK_REFUSED(scarp::mark_footing_base(mesh, centre, wrong), fmt::format("width of the footing is {}", wrong));
    CHECK_REFUSED(scarp::add_footing_block(mesh, wrong, 1.0), fmt::format("height of the footing is {}", wrong));
    CHECK_REFUSED(scarp::add_footing_block(mesh, 1.0, wrong), fmt::format("size of the footing is {}", wrong));
  }
  CHECK_REFUSED(scarp::mark_footing_base(mesh, nan, width), "centre of the footing is nan");
}

TEST_CASE("a footing that cannot be is refused before it is placed") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto const refused = [](scarp::StripFooting const& footing, std::string_view what) {
    CHECK_REFUSED(footing.validate(), what);
    CHECK_REFUSED(scarp::TiedFooting{.footing = footing}.edges(), what);
    CHECK_REFUSED(scarp::FrictionalFooting<>{.footing = footing}.edges(), what);
  };
  refused({.centre = nan}, "centre of the footing");
  refused({.width = 0.0}, "width of the footing");
  refused({.width = nan}, "width of the footing");
  refused({.bearing = -1.0}, "mean pressure below the footing");
  refused({.bearing = nan}, "mean pressure below the footing");
}
