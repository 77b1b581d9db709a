// SPDX-License-Identifier: BSL-1.0
#include "scarp/element/reference_element.hpp"

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <type_traits>

#include "scarp/core/random.hpp"
#include "scarp/element/hex20.hpp"
#include "scarp/element/map.hpp"
#include "scarp/element/tet10.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"

namespace {

struct WithoutQuadrature {
  static constexpr int dim = 2;
  static constexpr int nodes = 3;
  static scarp::ShapeValues<scarp::Tri3> shape(scarp::Vector<2> const& xi) { return scarp::Tri3::shape(xi); }
  static scarp::ShapeGradients<scarp::Tri3> shape_gradients(scarp::Vector<2> const& xi) {
    return scarp::Tri3::shape_gradients(xi);
  }
};
static_assert(scarp::GivesShapeValues<WithoutQuadrature>);
static_assert(!scarp::GivesQuadrature<WithoutQuadrature> && !scarp::ReferenceElement<WithoutQuadrature>);

struct WrongFacet : scarp::Tri3 {
  using Facet = scarp::Tri3;
};
static_assert(!scarp::HasFacets<WrongFacet>, "the side of a plane element must be a line");
static_assert(!scarp::ReferenceElement<scarp::Line2>, "a line is a side here, not an element");
static_assert(!scarp::HasNodes<int>);
static_assert(!scarp::GivesReducedQuadrature<scarp::Tri6>, "one point would leave nine of its twelve motions free");
static_assert(!scarp::HasMidSides<scarp::Quad4> && !scarp::HasGmshType<WithoutQuadrature>);

/// Corners of the reference cell and its volume, written down from the elements' definitions.
template <class Element>
struct Expected : Expected<typename Element::Linear> {};
template <>
struct Expected<scarp::Line2> {
  static constexpr double volume = 1.0;
  static constexpr double corners[2][1] = {{0}, {1}};
};
template <>
struct Expected<scarp::Tri3> {
  static constexpr double volume = 0.5;
  static constexpr double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}};
};
template <>
struct Expected<scarp::Quad4> {
  static constexpr double volume = 4.0;
  static constexpr double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
};
template <>
struct Expected<scarp::Tet4> {
  static constexpr double volume = 1.0 / 6.0;
  static constexpr double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};
template <>
struct Expected<scarp::Hex8> {
  static constexpr double volume = 8.0;
  static constexpr double corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                           {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
};

/// Corners that each further node lies between, in VTK's order of nodes (VTK User's Guide, "quadratic" cells).
template <class Element>
struct Middles {
  static constexpr std::array<std::array<int, 2>, 0> between{};
};
template <>
struct Middles<scarp::Line3> {
  static constexpr int between[1][2] = {{0, 1}};
};
template <>
struct Middles<scarp::Tri6> {
  static constexpr int between[3][2] = {{0, 1}, {1, 2}, {2, 0}};
};
template <>
struct Middles<scarp::Quad8> {
  static constexpr int between[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
};
template <>
struct Middles<scarp::Tet10> {
  static constexpr int between[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
};
template <>
struct Middles<scarp::Hex20> {
  static constexpr int between[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                         {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
};

/// Positions of an element's nodes on its reference cell.
template <class Element>
scarp::Corners<Element, Element::dim> reference_nodes() {
  scarp::Corners<Element, Element::dim> rows;
  int a = 0;
  for (auto const& corner : Expected<Element>::corners) {
    for (int i = 0; i < Element::dim; ++i) {
      rows(a, i) = corner[i];
    }
    ++a;
  }
  for (auto const& pair : Middles<Element>::between) {
    rows.row(a++) = (rows.row(pair[0]) + rows.row(pair[1])) / 2.0;
  }
  REQUIRE(a == Element::nodes);
  return rows;
}

template <class Element>
scarp::Vector<Element::dim> inner_point() {
  return reference_nodes<Element>().colwise().mean().transpose() + scarp::Vector<Element::dim>::LinSpaced(0.03, 0.11);
}

/// \f$ \int \prod_i x_i^{k_i} \f$ over the reference cell. Analytic: products of integrals on [-1, 1];
/// \f$ \prod k_i! / (d + \sum k_i)! \f$ on the unit simplex.
template <class Element>
double moment(std::array<int, 3> const& powers) {
  bool const simplex = Expected<Element>::volume < 2.0;
  double integral = 1.0;
  int total = Element::dim;
  for (int i = 0; i < Element::dim; ++i) {
    int const k = powers[static_cast<std::size_t>(i)];
    total += k;
    integral *= simplex ? std::tgamma(k + 1.0) : (k % 2 == 0 ? 2.0 / (k + 1.0) : 0.0);
  }
  return simplex ? integral / std::tgamma(total + 1.0) : integral;
}

/// Largest error of a rule for monomials up to a degree: of the sum of the exponents on a simplex, of each elsewhere.
template <class Element, class Rule>
double worst_moment(Rule const& rule, int degree) {
  bool const simplex = Expected<Element>::volume < 2.0;
  double worst = 0.0;
  auto const most = [&](int axis) { return axis < Element::dim ? degree : 0; };
  for (int i = 0; i <= most(0); ++i) {
    for (int j = 0; j <= most(1); ++j) {
      for (int k = 0; k <= most(2); ++k) {
        if (simplex && i + j + k > degree) {
          continue;
        }
        double sum = 0.0;
        for (auto const& point : rule) {
          std::array<int, 3> const powers{i, j, k};
          double value = point.weight;
          for (int axis = 0; axis < Element::dim; ++axis) {
            value *= std::pow(point.xi(axis), powers[static_cast<std::size_t>(axis)]);
          }
          sum += value;
        }
        worst = std::max(worst, std::abs(sum - moment<Element>({i, j, k})));
      }
    }
  }
  return worst;
}

/// A rule of a degree must be exact up to it and have points inside the cell with positive weights.
template <class Element, int Degree>
void check_rule() {
  auto const rule = Element::template rule<Degree>();
  CAPTURE(Degree);
  CHECK(worst_moment<Element>(rule, Degree) < 1e-14);  // round-off of up to 64 terms whose sum is at most 8
  for (auto const& point : rule) {
    CHECK(point.weight > 0.0);
    double const least = Expected<Element>::volume < 2.0 ? 0.0 : -1.0;
    CHECK(point.xi.minCoeff() > least);
    CHECK((least < 0.0 ? point.xi.maxCoeff() : point.xi.sum()) < 1.0);
  }
}

/// Integral of the outward normal times what `of` gives, over all facets of a body with the given nodes; `of` takes a
/// position.
template <class Element, class Of>
auto surface_integral(scarp::Corners<Element, Element::dim> const& nodes, Of const& of) {
  using Facet = typename Element::Facet;
  constexpr int dim = Element::dim;
  scarp::Vector<dim> total = scarp::Vector<dim>::Zero();
  for (auto const& facet : Element::facets()) {
    scarp::Corners<Facet, dim> rows;
    for (int a = 0; a < Facet::nodes; ++a) {
      rows.row(a) = nodes.row(facet[static_cast<std::size_t>(a)]);
    }
    for (auto const& point : Facet::quadrature()) {
      auto const along = scarp::jacobian<Facet, dim>(rows, point.xi);
      scarp::Vector<dim> normal;
      if constexpr (dim == 2) {
        normal << along(1, 0), -along(0, 0);
      } else {
        normal = scarp::Vector<3>(along.col(0)).cross(scarp::Vector<3>(along.col(1)));
      }
      scarp::Vector<dim> const position = rows.transpose() * Facet::shape(point.xi);
      total += point.weight * of(position) * normal;
    }
  }
  return total;
}

}  // namespace

TEST_CASE_TEMPLATE("a shape function is one at its own node and zero at the others", Element, scarp::Line2,
                   scarp::Line3, ALL_ELEMENTS) {
  auto const rows = reference_nodes<Element>();
  for (int a = 0; a < Element::nodes; ++a) {
    scarp::ShapeValues<Element> const expected = scarp::ShapeValues<Element>::Unit(a);
    CHECK(Element::shape(rows.row(a).transpose()) == expected);  // analytic and exact: sums and products of 0, 1/2, 1
  }
}

TEST_CASE_TEMPLATE("shape functions add up to one and reproduce position", Element, scarp::Line2, scarp::Line3,
                   ALL_ELEMENTS) {
  auto const xi = inner_point<Element>();
  auto const shape = Element::shape(xi);
  CHECK(shape.sum() == samples::Approx(1.0).epsilon(2e-15));  // analytic; round-off of 20 terms
  CHECK((reference_nodes<Element>().transpose() * shape - xi).norm() < 2e-15);
}

TEST_CASE_TEMPLATE("elements with nodes on their edges reproduce every quadratic function", Element, scarp::Line3,
                   scarp::Tri6, scarp::Quad8, scarp::Tet10, scarp::Hex20) {
  auto const xi = inner_point<Element>();
  auto const shape = Element::shape(xi);
  auto const rows = reference_nodes<Element>();
  for (int i = 0; i < Element::dim; ++i) {
    for (int j = i; j < Element::dim; ++j) {
      scarp::ShapeValues<Element> const values = rows.col(i).cwiseProduct(rows.col(j));
      CHECK(std::abs(values.dot(shape) - xi(i) * xi(j)) < 2e-15);  // analytic; round-off of 20 terms
    }
  }
}

TEST_CASE_TEMPLATE("shape gradients are the derivatives of the shape functions", Element, scarp::Line2, scarp::Line3,
                   ALL_ELEMENTS) {
  auto const xi = inner_point<Element>();
  auto const gradients = Element::shape_gradients(xi);
  double const step = 1e-3;
  for (int i = 0; i < Element::dim; ++i) {
    scarp::Vector<Element::dim> const along = step * scarp::Vector<Element::dim>::Unit(i);
    scarp::ShapeValues<Element> const slope = (Element::shape(xi + along) - Element::shape(xi - along)) / (2.0 * step);
    // Central differences are exact for functions that are at most quadratic along an axis; round-off 1e-16/step.
    CHECK((slope - gradients.col(i)).norm() < 1e-12);
  }
}

TEST_CASE_TEMPLATE("rules are exact up to their degree, with inner points and positive weights", Element,
                   ALL_ELEMENTS) {
  check_rule<Element, 1>();
  check_rule<Element, 2>();
  check_rule<Element, 3>();
  check_rule<Element, 4>();
  check_rule<Element, 5>();
  check_rule<Element, 6>();
  check_rule<Element, 7>();
}

TEST_CASE_TEMPLATE("quadrature is exact to the degree of the stiffness of an undistorted element and no further",
                   Element, ALL_ELEMENTS) {
  // Degree of the product of two shape gradients: in total on simplices, along each axis otherwise.
  int const degree = Element::nodes == Element::dim + 1                       ? 0
                     : Expected<Element>::volume < 2.0                        ? 2
                     : Element::nodes == static_cast<int>(1U << Element::dim) ? 2
                                                                              : 4;
  CHECK(worst_moment<Element>(Element::quadrature(), degree) < 1e-14);
  CHECK(worst_moment<Element>(Element::quadrature(), degree + 2) > 1e-4);  // the test can tell a weaker rule
}

TEST_CASE_TEMPLATE("reduced quadrature is exact to two degrees less", Element, scarp::Quad4, scarp::Quad8, scarp::Hex8,
                   scarp::Hex20) {
  int const points = static_cast<int>(Element::reduced_quadrature().size());
  int const per_axis = points == 1 ? 1 : 2;
  CHECK(points == static_cast<int>(std::pow(per_axis, Element::dim)));
  CHECK(worst_moment<Element>(Element::reduced_quadrature(), 2 * per_axis - 1) < 1e-14);
  CHECK(worst_moment<Element>(Element::reduced_quadrature(), 2 * per_axis) > 1e-3);
}

TEST_CASE_TEMPLATE("quadrature of a side is exact for a linear traction", Side, scarp::Line3, scarp::Tri6,
                   scarp::Quad8) {
  // Degree of a quadratic shape times a linear function, but for the side of Tet10, which is exact for constant ones.
  int const degree = std::is_same_v<Side, scarp::Tri6> ? 2 : 3;
  CHECK(worst_moment<Side>(Side::quadrature(), degree) < 1e-14);
}

TEST_CASE_TEMPLATE("the facets close around the element with outward normals", Element, ALL_ELEMENTS) {
  auto nodes = reference_nodes<Element>();
  auto const one = [](auto const&) { return 1.0; };
  CHECK(surface_integral<Element>(nodes, one).norm() < 1e-14);  // analytic: a closed surface has no resultant
  for (int i = 0; i < Element::dim; ++i) {
    auto const coordinate = [i](auto const& position) { return position(i); };
    scarp::Vector<Element::dim> const expected = Expected<Element>::volume * scarp::Vector<Element::dim>::Unit(i);
    // Analytic: Gauss's theorem for the function x_i; inward normals would change the sign.
    CHECK((surface_integral<Element>(nodes, coordinate) - expected).norm() < 1e-14);
  }
  // Facets that named a wrong node on an edge would not close any more once the nodes have moved.
  scarp::Random random(11);
  for (auto& coordinate : nodes.reshaped()) {
    coordinate += random.uniform(-0.1, 0.1);
  }
  CHECK(surface_integral<Element>(nodes, one).norm() < 1e-14);
}

TEST_CASE_TEMPLATE("every facet is the element's shape on its side", Element, ALL_ELEMENTS) {
  using Facet = typename Element::Facet;
  auto const rows = reference_nodes<Element>();
  scarp::Vector<Facet::dim> const place = Facet::quadrature()[0].xi;
  auto const on_side = Facet::shape(place);
  for (auto const& facet : Element::facets()) {
    scarp::Vector<Element::dim> xi = scarp::Vector<Element::dim>::Zero();
    scarp::ShapeValues<Element> expected = scarp::ShapeValues<Element>::Zero();
    for (int a = 0; a < Facet::nodes; ++a) {
      int const node = facet[static_cast<std::size_t>(a)];
      xi += on_side(a) * rows.row(node).transpose();
      expected(node) = on_side(a);
    }
    CHECK((Element::shape(xi) - expected).norm() < 1e-14);  // analytic: conforming elements; the facet's own node order
  }
}

TEST_CASE("Gmsh's local nodes lie between the corners that Gmsh's manual gives them") {
  // Gmsh reference manual, "Node ordering": edges in the order of their nodes.
  constexpr int triangle[3][2] = {{0, 1}, {1, 2}, {0, 2}};
  constexpr int quadrangle[4][2] = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  constexpr int tetrahedron[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
  constexpr int hexahedron[12][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                     {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  auto const check = [](auto const& own, auto const& order, auto const& edges, std::size_t corners) {
    for (std::size_t a = 0; a < corners; ++a) {
      CHECK(order[a] == static_cast<int>(a));
    }
    for (std::size_t m = 0; m < own.size(); ++m) {
      auto const& edge = edges[static_cast<std::size_t>(order[corners + m]) - corners];
      CHECK(std::minmax(own[m][0], own[m][1]) == std::minmax(edge[0], edge[1]));
    }
  };
  check(scarp::Tri6::mid_sides(), scarp::Tri6::gmsh_order, triangle, 3);
  check(scarp::Quad8::mid_sides(), scarp::Quad8::gmsh_order, quadrangle, 4);
  check(scarp::Tet10::mid_sides(), scarp::Tet10::gmsh_order, tetrahedron, 4);
  check(scarp::Hex20::mid_sides(), scarp::Hex20::gmsh_order, hexahedron, 8);
}
