// SPDX-License-Identifier: BSL-1.0
#include "scarp/mesh/refined.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/mesh/mesh_checks.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/refusals.hpp"

#define PLANE_ELEMENTS scarp::Tri3, scarp::Quad8 ALSO_NIGHTLY(scarp::Tri6, scarp::Quad4)

namespace {

using scarp::Vector;

struct Everywhere {
  double metres;
  double size(Vector<2> const&) const { return metres; }
};

/// Fine around a place inside, coarse beside it.
struct Around {
  Vector<2> place{-7.0, 12.0};
  double fine = 0.6;
  double size(Vector<2> const& at) const { return fine + 0.25 * (at - place).norm(); }
};

template <class Field, class Element>
concept Refines = requires(scarp::Mesh<Element> const& mesh, Field const& field) {
  scarp::refined(mesh, field);
};
struct NoSize {};
static_assert(Refines<Around, scarp::Quad8> && !Refines<Around, scarp::Hex8> && !Refines<NoSize, scarp::Tri3>);

/// Cells are squares of 5 m.
constexpr scarp::FaultMesh squares{.left = -50.0, .right = 25.0, .size = 5.0, .coarsening = 1.0};

scarp::FaultMesh jittered(std::uint64_t seed) {
  auto layer = squares;
  layer.jitter = 0.25;
  layer.seed = seed;
  return layer;
}

template <class Element>
std::vector<Vector<2>> ring_of(scarp::Mesh<Element> const& mesh, std::size_t element) {
  std::vector<Vector<2>> ring;
  for (std::size_t k = 0; k < scarp::LinearOf<Element>::nodes; ++k) {
    ring.push_back(mesh.nodes[static_cast<std::size_t>(mesh.elements[element][k])]);
  }
  return ring;
}

struct Shapes {
  double least = 180.0;    ///< angle [degrees]
  double largest = 0.0;    ///< angle [degrees]
  double over_size = 0.0;  ///< largest of longest side over size at the centre
};

template <class Element, class Field>
Shapes shapes_of(scarp::Mesh<Element> const& mesh, Field const& field) {
  Shapes shapes;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    auto const ring = ring_of(mesh, e);
    std::size_t const corners = ring.size();
    double longest = 0.0;
    for (std::size_t k = 0; k < corners; ++k) {
      Vector<2> const next = ring[(k + 1) % corners] - ring[k];
      Vector<2> const last = ring[(k + corners - 1) % corners] - ring[k];
      double const angle =
          std::atan2(next.x() * last.y() - next.y() * last.x(), next.dot(last)) * 180.0 / std::numbers::pi;
      shapes.least = std::min(shapes.least, angle);
      shapes.largest = std::max(shapes.largest, angle);
      longest = std::max(longest, next.norm());
    }
    Vector<2> const zero = Vector<2>::Zero();
    Vector<2> const centre = std::accumulate(ring.begin(), ring.end(), zero) / static_cast<double>(corners);
    shapes.over_size = std::max(shapes.over_size, longest / field.size(centre));
  }
  return shapes;
}

/// The sum of a boundary's facets as vectors, and of their lengths.
template <class Element>
std::pair<Vector<2>, double> way_along(scarp::Mesh<Element> const& mesh, std::string const& name) {
  std::pair<Vector<2>, double> way{Vector<2>::Zero(), 0.0};
  for (auto const& facet : scarp::boundary(mesh, name)) {
    Vector<2> const step =
        mesh.nodes[static_cast<std::size_t>(facet[1])] - mesh.nodes[static_cast<std::size_t>(facet[0])];
    way.first += step;
    way.second += step.norm();
  }
  return way;
}

template <class Element>
void check_conforming(scarp::Mesh<Element> const& mesh) {
  CHECK_NOTHROW(scarp::validate(mesh));
  CHECK_NOTHROW(scarp::require_no_duplicate_nodes(mesh));
  CHECK_NOTHROW(scarp::require_no_hanging_nodes(mesh));
  std::map<std::array<int, Element::facet_nodes>, int> owners;
  for (auto const& element : mesh.elements) {
    for (auto facet : Element::facets()) {
      for (int& node : facet) node = element[static_cast<std::size_t>(node)];
      std::sort(facet.begin(), facet.end());
      ++owners[facet];
    }
  }
  for (char const* const name : {"left", "right", "bottom", "surface"}) {
    for (auto facet : scarp::boundary(mesh, name)) {
      std::sort(facet.begin(), facet.end());
      ++owners[facet];  // an outer side has its boundary as second owner
    }
  }
  CHECK(std::all_of(owners.begin(), owners.end(), [](auto const& entry) { return entry.second == 2; }));
}

}  // namespace

TEST_CASE_TEMPLATE("a refined mesh fits: two elements at every inner side, one boundary at every outer one", Element,
                   PLANE_ELEMENTS) {
  for (auto const& layer : {squares, jittered(1), jittered(2)}) {
    auto const coarse = layer.template generate<Element>();
    auto const fine = scarp::refined(coarse, Around{});
    CHECK(fine.elements.size() > 2 * coarse.elements.size());
    check_conforming(fine);
    CHECK(scarp::region_area(fine, "soil", fine.nodes) ==
          samples::Approx(75.0 * 25.0));  // round-off of some thousand terms
    for (char const* const name : {"left", "right", "bottom", "surface"}) {
      auto const [before, length_before] = way_along(coarse, name);
      auto const [after, length_after] = way_along(fine, name);
      CHECK((after - before).norm() < 1e-12 * length_before);  // round-off, in the sense of the outward normal
      CHECK(length_after == samples::Approx(length_before));
    }
    CHECK(scarp::boundary(fine, "surface").size() > scarp::boundary(coarse, "surface").size());
  }
}

TEST_CASE_TEMPLATE("nodes of the coarse mesh stay, those in the middle of sides are there again", Element,
                   PLANE_ELEMENTS) {
  auto const coarse = scarp::corner_mesh(jittered(3).generate<Element>());
  auto const fine = scarp::refined(jittered(3).generate<Element>(), Around{});
  CHECK(std::equal(coarse.nodes.begin(), coarse.nodes.end(), fine.nodes.begin()));
  if constexpr (scarp::HasMidSides<Element>) {
    double worst = 0.0;
    for (auto const& element : fine.elements) {
      auto const at = [&](int local) {
        return fine.nodes[static_cast<std::size_t>(element[static_cast<std::size_t>(local)])];
      };
      int middle = scarp::LinearOf<Element>::nodes;
      for (auto const& [a, b] : Element::mid_sides()) {
        worst = std::max(worst, (at(middle++) - (at(a) + at(b)) / 2.0).norm());
      }
    }
    CHECK(worst < 1e-14 * 50.0);  // round-off of a mean of places up to 50 m away
  }
}

TEST_CASE("triangles of squares stay right-angled with equal legs") {
  for (auto const pattern : {scarp::Pattern::crossed, scarp::Pattern::left, scarp::Pattern::right}) {
    auto layer = squares;
    layer.pattern = pattern;
    auto const shapes = shapes_of(scarp::refined(layer.generate(), Around{}), Around{});
    CHECK(shapes.least == samples::Approx(45.0));  // analytic: both halves of such a triangle are such triangles
    CHECK(shapes.largest == samples::Approx(90.0));
    CHECK(shapes.over_size < 1.1893);
  }
}

TEST_CASE("triangles of a jittered mesh keep half of its least angle and their size") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    auto const coarse = jittered(seed).generate();
    auto const shapes = shapes_of(scarp::refined(coarse, Around{}), Around{});
    CHECK(shapes.least >= 0.5 * shapes_of(coarse, Around{}).least);  // analytic: bisection of the longest side
    CHECK(shapes.over_size < 1.1893);
  }
}

TEST_CASE("quadrilaterals of squares become squares and thirds of right-angled triangles") {
  auto layer = squares;
  layer.size = 25.0 / 3.0;
  auto const fine = scarp::refined(layer.generate<scarp::Quad4>(), Around{});
  auto const shapes = shapes_of(fine, Around{});
  // Analytic: a third of the triangle (0, 0), (1, 0), (0, 1) has angles from 45 degrees to 90 + 2 atan(1/2) degrees.
  CHECK(shapes.least == samples::Approx(45.0));
  CHECK(shapes.largest == samples::Approx(90.0 + 2.0 * std::atan(0.5) * 180.0 / std::numbers::pi));
  // Half of a hypotenuse, 1.1893 * sqrt(2) sizes; the size, with its slope of 0.25, counts at the centre of the
  // triangle, 0.2 hypotenuses from that of the third.
  double const largest = 1.1893 * std::numbers::sqrt2;
  CHECK(shapes.over_size < largest / (1.0 - 0.25 * 0.2 * 2.0 * largest));
}

TEST_CASE("quadrilaterals of jittered ones keep angles from 20 to 165 degrees") {
  Shapes worst;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto const shapes = shapes_of(scarp::refined(jittered(seed).generate<scarp::Quad4>(), Around{}), Around{});
    worst.least = std::min(worst.least, shapes.least);
    worst.largest = std::max(worst.largest, shapes.largest);
  }
  CHECK(worst.least > 20.0);
  CHECK(worst.largest < 165.0);
}

TEST_CASE("two triangles become one quadrilateral unless it has a corner of more than 160 degrees") {
  auto const parts = [](Vector<2> const& corner) {
    scarp::Mesh<scarp::Quad4> const mesh{
        {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, corner}, {{0, 1, 2, 3}}, {0}, {"soil"}, {}};
    return scarp::refined(mesh, Everywhere{6.0}).elements.size();
  };
  CHECK(parts({0.0, 10.0}) == 4);
  CHECK(parts({4.8, 5.2}) == 6);  // 175 degrees; analytic: three quadrilaterals in each triangle
}

TEST_CASE("even refinement divides every element alike") {
  auto const triangles = squares.generate();
  CHECK(scarp::refined(triangles, Everywhere{2.5}).elements.size() == 4 * triangles.elements.size());
  CHECK(scarp::refined(triangles, Everywhere{5.0 / std::numbers::sqrt2}).elements.size() ==
        2 * triangles.elements.size());
  auto const quads = squares.generate<scarp::Quad4>();
  CHECK(scarp::refined(quads, Everywhere{2.5}).elements.size() == 4 * quads.elements.size());
  CHECK(scarp::refined(quads, Everywhere{1.25}).elements.size() == 16 * quads.elements.size());
}

TEST_CASE_TEMPLATE("a mesh that is fine enough is returned as it is", Element, PLANE_ELEMENTS) {
  auto const mesh = jittered(1).generate<Element>();
  auto const same = scarp::refined(mesh, Everywhere{50.0});
  CHECK(same.nodes == mesh.nodes);
  CHECK(same.elements == mesh.elements);
  CHECK(same.boundaries == mesh.boundaries);
}

TEST_CASE_TEMPLATE("regions and the boundary between them stay", Element, PLANE_ELEMENTS) {
  auto mesh = squares.generate<Element>({-15.0, -5.0});
  scarp::mark_footing_base(mesh, -10.0, 10.0);
  scarp::add_footing_block(mesh, 2.0, 1.0);
  auto const fine = scarp::refined(mesh, Around{{-9.0, 25.0}, 0.4});
  CHECK(fine.regions == mesh.regions);
  for (auto const& region : mesh.regions) {
    double const area = scarp::region_area(mesh, region, mesh.nodes);
    CHECK(scarp::region_area(fine, region, fine.nodes) == samples::Approx(area));
  }
  CHECK(way_along(fine, "footing_base").second == samples::Approx(10.0));
  CHECK(scarp::boundary(fine, "footing_base").size() > scarp::boundary(mesh, "footing_base").size());
  CHECK_NOTHROW(scarp::validate(fine));  // all facets are sides of elements: none lies inside a quadrilateral
}

TEST_CASE("the same mesh and sizes give the same bits, another jitter does not") {
  auto const once = scarp::refined(jittered(7).generate<scarp::Quad8>(), Around{});
  auto const again = scarp::refined(jittered(7).generate<scarp::Quad8>(), Around{});
  auto const other = scarp::refined(jittered(8).generate<scarp::Quad8>(), Around{});
  CHECK(once.nodes == again.nodes);
  CHECK(once.elements == again.elements);
  CHECK(once.boundaries == again.boundaries);
  CHECK(once.nodes != other.nodes);
}

TEST_CASE("sizes that no element can have are refused with their place") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  auto const mesh = squares.generate();
  CHECK_REFUSED(scarp::refined(mesh, Everywhere{0.0}), "the element size at (", "is 0 m", "above 0");
  CHECK_REFUSED(scarp::refined(mesh, Everywhere{-1.0}), "is -1 m", "above 0");
  CHECK_REFUSED(scarp::refined(mesh, Everywhere{nan}), "is nan m", "finite");
  CHECK_REFUSED(scarp::refined(mesh, Everywhere{infinity}), "is inf m", "finite");
  CHECK_REFUSED(scarp::refined(mesh, Everywhere{1e-3}), "elements (up to 1e+07 are supported)", "larger sizes");
  CHECK_REFUSED(scarp::refined(scarp::Mesh<scarp::Tri3>{}, Everywhere{1.0}), "it is empty");
}
