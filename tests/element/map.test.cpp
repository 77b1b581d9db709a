// SPDX-License-Identifier: BSL-1.0
#include "scarp/element/map.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scarp/element/quad4.hpp"
#include "scarp/element/tet4.hpp"
#include "scarp/element/tri3.hpp"
#include "support/approx.hpp"

namespace {

using samples::Approx;
using scarp::Corners;
using scarp::mean_ratio;
using scarp::Vector;

}  // namespace

TEST_CASE("a moved and stretched triangle has the area and the gradients of the plane through its corners") {
  Corners<scarp::Tri3, 2> rows;
  rows << 1.0, 2.0, 4.0, 2.5, 2.0, 6.0;
  auto const shape = scarp::spatial_shape<scarp::Tri3>(rows, scarp::Tri3::quadrature()[0]);
  // Analytic: half the cross product of the edges (3, 0.5) and (1, 4).
  CHECK(shape.volume == Approx((3.0 * 4.0 - 0.5 * 1.0) / 2.0).epsilon(1e-15));
  Vector<2> const slope(0.7, -1.3);
  Vector<3> const heights = rows * slope;  // of the plane through the corners
  CHECK((shape.gradients.transpose() * heights - slope).norm() < 1e-14);
}

TEST_CASE("the side of an element has its length or area in space") {
  Corners<scarp::Line2, 2> line;
  line << 1.0, 1.0, 4.0, 5.0;
  CHECK(scarp::measure<scarp::Line2, 2>(line, Vector<1>(0.5)) == Approx(5.0));  // analytic: 3-4-5
  Corners<scarp::Tri3, 3> side;
  side << 0.0, 0.0, 1.0, 2.0, 0.0, 1.0, 0.0, 3.0, 1.0;
  CHECK(0.5 * scarp::measure<scarp::Tri3, 3>(side, Vector<2>::Zero()) == Approx(3.0));  // analytic: 2 * 3 / 2
}

TEST_CASE("an element turned inside out has a negative measure") {
  Corners<scarp::Tri3, 2> rows;
  rows << 0.0, 0.0, 0.0, 1.0, 1.0, 0.0;
  CHECK(scarp::measure<scarp::Tri3, 2>(rows, Vector<2>::Zero()) == -1.0);
}

TEST_CASE("the mean ratio is that of closed forms") {
  // Analytic: regular cells have 1 whatever their size; a half square |A|^2 = 8 / 3, det A = 2 / sqrt(3).
  Corners<scarp::Tri3, 2> triangle;
  triangle << 0.0, 0.0, 3.0, 0.0, 1.5, 1.5 * std::sqrt(3.0);
  CHECK(mean_ratio<scarp::Tri3>(triangle, Vector<2>(0.2, 0.3)) == Approx(1.0).epsilon(1e-14));
  triangle << 0.0, 0.0, 1.0, 0.0, 0.0, 1.0;
  CHECK(mean_ratio<scarp::Tri3>(triangle, Vector<2>(0.2, 0.3)) == Approx(std::sqrt(3.0) / 2.0).epsilon(1e-14));
  triangle << 0.0, 0.0, 0.0, 1.0, 1.0, 0.0;
  CHECK(mean_ratio<scarp::Tri3>(triangle, Vector<2>(0.2, 0.3)) == 0.0);  // inside out
  Corners<scarp::Quad4, 2> square;
  square << 0.0, 0.0, 2.0, 0.0, 2.0, 2.0, 0.0, 2.0;
  CHECK(mean_ratio<scarp::Quad4>(square, Vector<2>(0.1, 0.7)) == Approx(1.0).epsilon(1e-14));
  Corners<scarp::Tet4, 3> tetrahedron;
  tetrahedron << 1, 1, 1, 1, -1, -1, -1, -1, 1, -1, 1, -1;
  CHECK(mean_ratio<scarp::Tet4>(tetrahedron, Vector<3>(0.2, 0.2, 0.2)) == Approx(1.0).epsilon(1e-14));
}
