// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstddef>

#include "scarp/element/reference_element.hpp"

namespace scarp {

/// Gauss-Legendre points and weights on [-1, 1], exact up to degree 2 Points - 1.
/// Abramowitz and Stegun, Handbook of Mathematical Functions (1964), table 25.4; digits of double precision.
template <int Points>
struct GaussLine {
  static_assert(Points >= 1 && Points <= 5, "Gauss rules are tabulated for one to five points per axis");

  static constexpr std::array<double, Points> points() {
    if constexpr (Points == 1) {
      return {0.0};
    } else if constexpr (Points == 2) {
      return {-0.57735026918962576, 0.57735026918962576};
    } else if constexpr (Points == 3) {
      return {-0.77459666924148338, 0.0, 0.77459666924148338};
    } else if constexpr (Points == 4) {
      return {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258};
    } else {
      return {-0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309, 0.90617984593866399};
    }
  }

  static constexpr std::array<double, Points> weights() {
    if constexpr (Points == 1) {
      return {2.0};
    } else if constexpr (Points == 2) {
      return {1.0, 1.0};
    } else if constexpr (Points == 3) {
      return {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    } else if constexpr (Points == 4) {
      return {0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386};
    } else {
      return {0.23692688505618909, 0.47862867049936647, 128.0 / 225.0, 0.47862867049936647, 0.23692688505618909};
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
  constexpr auto points = GaussLine<PerAxis>::points();
  constexpr auto weights = GaussLine<PerAxis>::weights();
  std::array<QuadraturePoint<Dim>, detail::power(PerAxis, Dim)> rule;
  for (std::size_t p = 0; p < rule.size(); ++p) {
    std::size_t rest = p;
    rule[p].weight = 1.0;
    for (int axis = 0; axis < Dim; ++axis) {
      rule[p].xi(axis) = points[rest % PerAxis];
      rule[p].weight *= weights[rest % PerAxis];
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

}  // namespace scarp
