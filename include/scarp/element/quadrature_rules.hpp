// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstddef>

#include "scarp/core/index.hpp"
#include "scarp/element/reference_element.hpp"

namespace scarp {

/// Gauss-Legendre points and weights on [-1, 1], exact up to degree 2 Points - 1.
/// Abramowitz and Stegun, Handbook of Mathematical Functions (1964), table 25.4; digits of double precision.
template <int Points>
struct GaussLine {
  static_assert(Points >= 1 && Points <= 5, "Gauss rules are tabulated for one to five points per axis");

  std::array<double, detail::index(Points)> points;   ///< ascending, in (-1, 1)
  std::array<double, detail::index(Points)> weights;  ///< of the points; they add up to 2

  /// The tabulated rule of one to five points.
  static constexpr GaussLine make() {
    if constexpr (Points == 1) {
      return {{0.0}, {2.0}};
    } else if constexpr (Points == 2) {
      return {{-0.57735026918962576, 0.57735026918962576}, {1.0, 1.0}};
    } else if constexpr (Points == 3) {
      return {{-0.77459666924148338, 0.0, 0.77459666924148338}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
    } else if constexpr (Points == 4) {
      return {{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258},
              {0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386}};
    } else {
      return {{-0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309, 0.90617984593866399},
              {0.23692688505618909, 0.47862867049936647, 128.0 / 225.0, 0.47862867049936647, 0.23692688505618909}};
    }
  }
};

namespace detail {

constexpr std::size_t power(int base, int exponent) {
  return exponent == 0 ? 1 : static_cast<std::size_t>(base) * power(base, exponent - 1);
}

}  // namespace detail

/// Product of `PerAxis` Gauss points along every axis of [-1, 1]^Dim, exact up to degree 2 PerAxis - 1 along each axis.
/// The first axis runs fastest.
template <int Dim, int PerAxis>
std::array<QuadraturePoint<Dim>, detail::power(PerAxis, Dim)> gauss_rule() {
  constexpr auto line = GaussLine<PerAxis>::make();
  std::array<QuadraturePoint<Dim>, detail::power(PerAxis, Dim)> rule;
  for (std::size_t p = 0; p < rule.size(); ++p) {
    std::size_t rest = p;
    rule[p].weight = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      rule[p].xi(axis) = line.points[rest % PerAxis];
      rule[p].weight *= line.weights[rest % PerAxis];
      rest /= PerAxis;
    }
  }
  return rule;
}

/// As many Gauss points as a polynomial of degree `Degree` along each axis of [-1, 1]^Dim needs.
template <int Dim, int Degree>
auto cube_rule() {
  return gauss_rule<Dim, Degree / 2 + 1>();
}

namespace detail {

/// Conical product: Gauss points of the cube drawn together towards a corner of the simplex, \f$ x_1 = t_1,\;
/// x_2 = (1 - t_1) t_2,\; x_3 = (1 - t_1)(1 - t_2) t_3 \f$. The Jacobian \f$ (1 - t_1)^2 (1 - t_2) \f$ (in space)
/// raises the degree by Dim - 1. Stroud, Approximate Calculation of Multiple Integrals (1971)
template <int Dim, int Degree>
auto conical_rule() {
  auto rule = cube_rule<Dim, Degree + Dim - 1>();
  for (auto& point : rule) {
    double left = 1.0;  // of the sum of all coordinates
    for (int axis = 0; axis < Dim; ++axis) {
      double const part = (1.0 + point.xi(axis)) / 2.0;
      point.weight *= left / 2.0;
      point.xi(axis) = left * part;
      left *= 1.0 - part;
    }
  }
  return rule;
}

/// A point all of whose coordinates are `all`, then those of which one, each in turn, is `one`.
template <int Dim>
std::array<QuadraturePoint<Dim>, index(Dim + 1)> orbit(double all, double one, double weight) {
  std::array<QuadraturePoint<Dim>, index(Dim + 1)> points;
  for (auto& point : points) point = {Vector<Dim>::Constant(all), weight};
  for (std::size_t axis = 0; axis < Dim; ++axis) points[axis + 1].xi(static_cast<int>(axis)) = one;
  return points;
}

}  // namespace detail

/// Points in the simplex with corners at the origin and the unit points, exact up to the total degree `Degree`.
/// Degree 1: centroid. Degree 2: three or four inner points, Hammer and Stroud, Math. Tables Aids Comp. 10 (1956) 137.
/// Degree 4 of the triangle: six points, Cowper, Int. J. Numer. Meth. Engng 7 (1973) 405. Degree 5 of the tetrahedron:
/// fourteen points, Walkington, Quadrature on simplices of arbitrary dimension (2000). Others: conical product.
template <int Dim, int Degree>
auto simplex_rule() {
  using Point = QuadraturePoint<Dim>;
  if constexpr (Dim == 2 && Degree == 1) {
    return std::array<Point, 1>{{{Vector<2>(1.0 / 3.0, 1.0 / 3.0), 0.5}}};
  } else if constexpr (Dim == 2 && Degree == 2) {
    return detail::orbit<2>(1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0);
  } else if constexpr (Dim == 2 && (Degree == 3 || Degree == 4)) {
    double const a = 0.44594849091596489;
    double const b = 0.091576213509770743;
    auto const [a0, a1, a2] = detail::orbit<2>(a, 1.0 - 2.0 * a, 0.11169079483900573);
    auto const [b0, b1, b2] = detail::orbit<2>(b, 1.0 - 2.0 * b, 0.054975871827660933);
    return std::array<Point, 6>{a0, a1, a2, b0, b1, b2};
  } else if constexpr (Dim == 3 && Degree == 1) {
    return std::array<Point, 1>{{{Vector<3>::Constant(0.25), 1.0 / 6.0}}};
  } else if constexpr (Dim == 3 && Degree == 2) {
    return detail::orbit<3>(0.13819660112501051, 0.58541019662496852,
                            1.0 / 24.0);  // (5 - sqrt 5)/20, (5 + 3 sqrt 5)/20
  } else if constexpr (Dim == 3 && (Degree >= 3 && Degree <= 5)) {
    double const a = 0.31088591926330061;
    double const b = 0.092735250310891226;
    double const c = 0.045503704125649649;
    double const w = 0.0070910034628469110;
    auto const [a0, a1, a2, a3] = detail::orbit<3>(a, 1.0 - 3.0 * a, 0.018781320953002642);
    auto const [b0, b1, b2, b3] = detail::orbit<3>(b, 1.0 - 3.0 * b, 0.012248840519393658);
    auto const [c0, c1, c2, c3] = detail::orbit<3>(c, 0.5 - c, w);
    auto const [d0, d1, d2, d3] = detail::orbit<3>(0.5 - c, c, w);
    return std::array<Point, 14>{a0, a1, a2, a3, b0, b1, b2, b3, c1, c2, c3, d1, d2, d3};
  } else {
    return detail::conical_rule<Dim, Degree>();
  }
}

namespace detail {

/// What all elements on a simplex share.
template <int Dim>
struct OnSimplex {
  static constexpr int dim = Dim;

  template <int Degree>
  static auto rule() {
    return simplex_rule<Dim, Degree>();
  }
};

/// What all elements on [-1, 1]^Dim share.
template <int Dim>
struct OnCube {
  static constexpr int dim = Dim;

  template <int Degree>
  static auto rule() {
    return cube_rule<Dim, Degree>();
  }
};

}  // namespace detail

}  // namespace scarp
