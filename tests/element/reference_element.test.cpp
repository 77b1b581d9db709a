// SPDX-License-Identifier: BSL-1.0
#include "scarp/element/reference_element.hpp"

#include <doctest/doctest.h>

#include "approx.hpp"
#include "scarp/element/map.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/tet4.hpp"
#include "scarp/element/tri3.hpp"

namespace {

struct WithoutQuadrature {
  static constexpr int dim = 2;
  static constexpr int nodes = 3;
  static scarp::ShapeValues<scarp::Tri3> shape(scarp::Vector<2> const& xi) { return scarp::Tri3::shape(xi); }
  static scarp::ShapeGradients<scarp::Tri3> shape_gradients(scarp::Vector<2> const& xi) {
    return scarp::Tri3::shape_gradients(xi);
  }
};
static_assert(scarp::GivesShapes<WithoutQuadrature>);
static_assert(!scarp::GivesQuadrature<WithoutQuadrature> && !scarp::ReferenceElement<WithoutQuadrature>);

struct WrongFacet : scarp::Tri3 {
  using Facet = scarp::Tri3;
};
static_assert(!scarp::HasFacets<WrongFacet>, "the side of a plane element must be a line");
static_assert(!scarp::ReferenceElement<scarp::Line2>, "a line is a side here, not an element");
static_assert(!scarp::HasNodes<int>);

/// Corners of the reference cell and its volume, written down from the elements' definitions.
template <class Element>
struct Expected;
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

template <class Element>
scarp::Corners<Element, Element::dim> reference_corners() {
  scarp::Corners<Element, Element::dim> rows;
  for (int a = 0; a < Element::nodes; ++a) {
    for (int i = 0; i < Element::dim; ++i) {
      rows(a, i) = Expected<Element>::corners[a][i];
    }
  }
  return rows;
}

template <class Element>
scarp::Vector<Element::dim> inner_point() {
  return reference_corners<Element>().colwise().mean().transpose() + scarp::Vector<Element::dim>::LinSpaced(0.03, 0.11);
}

}  // namespace

TEST_CASE_TEMPLATE("a shape function is one at its own node and zero at the others", Element, scarp::Line2, scarp::Tri3,
                   scarp::Quad4, scarp::Tet4) {
  auto const rows = reference_corners<Element>();
  for (int a = 0; a < Element::nodes; ++a) {
    scarp::ShapeValues<Element> const expected = scarp::ShapeValues<Element>::Unit(a);
    CHECK(Element::shape(rows.row(a).transpose()) == expected);  // analytic and exact: sums and products of 0 and 1
  }
}

TEST_CASE_TEMPLATE("shape functions add up to one and reproduce position", Element, scarp::Line2, scarp::Tri3,
                   scarp::Quad4, scarp::Tet4) {
  auto const xi = inner_point<Element>();
  auto const shape = Element::shape(xi);
  CHECK(shape.sum() == samples::Approx(1.0).epsilon(1e-15));  // analytic; round-off
  CHECK((reference_corners<Element>().transpose() * shape - xi).norm() < 1e-15);
}

TEST_CASE_TEMPLATE("shape gradients are the derivatives of the shape functions", Element, scarp::Line2, scarp::Tri3,
                   scarp::Quad4, scarp::Tet4) {
  auto const xi = inner_point<Element>();
  auto const gradients = Element::shape_gradients(xi);
  double const step = 1e-3;
  for (int i = 0; i < Element::dim; ++i) {
    scarp::Vector<Element::dim> const along = step * scarp::Vector<Element::dim>::Unit(i);
    scarp::ShapeValues<Element> const slope = (Element::shape(xi + along) - Element::shape(xi - along)) / (2.0 * step);
    // Central differences are exact for functions that are at most linear along an axis; round-off 1e-16/step.
    CHECK((slope - gradients.col(i)).norm() < 1e-12);
  }
}

TEST_CASE_TEMPLATE("quadrature is exact for linear functions on the reference cell", Element, scarp::Line2, scarp::Tri3,
                   scarp::Quad4, scarp::Tet4) {
  double volume = 0.0;
  scarp::Vector<Element::dim> moment = scarp::Vector<Element::dim>::Zero();
  for (auto const& point : Element::quadrature()) {
    volume += point.weight;
    moment += point.weight * point.xi;
  }
  scarp::Vector<Element::dim> const centre = reference_corners<Element>().colwise().mean().transpose();
  // Analytic: volume of the reference cell; its centre is the mean of the corners.
  CHECK(volume == samples::Approx(Expected<Element>::volume).epsilon(1e-15));
  CHECK((moment - volume * centre).norm() < 1e-15);
}

TEST_CASE_TEMPLATE("the facets close around the element with outward normals", Element, scarp::Tri3, scarp::Quad4,
                   scarp::Tet4) {
  auto const rows = reference_corners<Element>();
  scarp::Vector<Element::dim> total = scarp::Vector<Element::dim>::Zero();
  scarp::Vector<Element::dim> const centre = rows.colwise().mean().transpose();
  for (auto const& facet : Element::facets()) {
    scarp::Vector<Element::dim> const first = rows.row(facet[0]).transpose();
    scarp::Vector<Element::dim> const second = rows.row(facet[1]).transpose();
    scarp::Vector<Element::dim> normal;
    if constexpr (Element::dim == 2) {
      normal << second.y() - first.y(), first.x() - second.x();
    } else {
      scarp::Vector<3> const a = second - first;
      scarp::Vector<3> const b = rows.row(facet[2]).transpose() - first;
      normal << a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x();
    }
    CHECK(normal.dot(first - centre) > 0.0);
    total += normal;
  }
  CHECK(total.norm() < 1e-15);  // analytic: the normals of a closed surface add up to zero
}

TEST_CASE("a moved and stretched triangle has the area and the gradients of the plane through its corners") {
  scarp::Corners<scarp::Tri3, 2> rows;
  rows << 1.0, 2.0, 4.0, 2.5, 2.0, 6.0;
  auto const shape = scarp::spatial_shape<scarp::Tri3>(rows, scarp::Tri3::quadrature()[0]);
  // Analytic: half the cross product of the edges (3, 0.5) and (1, 4).
  CHECK(shape.volume == samples::Approx((3.0 * 4.0 - 0.5 * 1.0) / 2.0).epsilon(1e-15));
  scarp::Vector<2> const slope(0.7, -1.3);
  scarp::Vector<3> const heights = rows * slope;  // of the plane through the corners
  CHECK((shape.gradients.transpose() * heights - slope).norm() < 1e-14);
}

TEST_CASE("the side of an element has its length or area in space") {
  scarp::Corners<scarp::Line2, 2> line;
  line << 1.0, 1.0, 4.0, 5.0;
  CHECK(scarp::measure<scarp::Line2, 2>(line, scarp::Vector<1>(0.5)) == samples::Approx(5.0));  // analytic: 3-4-5
  scarp::Corners<scarp::Tri3, 3> side;
  side << 0.0, 0.0, 1.0, 2.0, 0.0, 1.0, 0.0, 3.0, 1.0;
  CHECK(0.5 * scarp::measure<scarp::Tri3, 3>(side, scarp::Vector<2>::Zero()) ==
        samples::Approx(3.0));  // analytic: 2 * 3 / 2
}

TEST_CASE("an element turned inside out has a negative measure") {
  scarp::Corners<scarp::Tri3, 2> rows;
  rows << 0.0, 0.0, 0.0, 1.0, 1.0, 0.0;
  CHECK(scarp::measure<scarp::Tri3, 2>(rows, scarp::Vector<2>::Zero()) == -1.0);
}
