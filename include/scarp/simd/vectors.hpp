// SPDX-License-Identifier: BSL-1.0
/// \file
/// Vectors of the kernel: arrays of numbers or of packs. A number alone is a tangential quantity or a rotation in the
/// plane.
#pragma once

#include <array>

namespace scarp {

/// Product of two numbers.
template <class T>
constexpr T dot(T const& a, T const& b) {
  return a * b;
}
/// Scalar product in the plane.
template <class T>
constexpr T dot(std::array<T, 2> const& a, std::array<T, 2> const& b) {
  return a[0] * b[0] + a[1] * b[1];
}
/// Scalar product in space.
template <class T>
constexpr T dot(std::array<T, 3> const& a, std::array<T, 3> const& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Vector product in the plane: the number along its normal.
template <class T>
constexpr T cross(std::array<T, 2> const& a, std::array<T, 2> const& b) {
  return a[0] * b[1] - a[1] * b[0];
}
/// Vector product in space.
template <class T>
constexpr std::array<T, 3> cross(std::array<T, 3> const& a, std::array<T, 3> const& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A number times a factor.
template <class T>
constexpr T scaled(T const& value, T const& factor) {
  return value * factor;
}
/// A vector times a factor.
template <class T>
constexpr std::array<T, 3> scaled(std::array<T, 3> const& value, T const& factor) {
  return {value[0] * factor, value[1] * factor, value[2] * factor};
}

/// Sum of two numbers.
template <class T>
constexpr T sum(T const& a, T const& b) {
  return a + b;
}
/// Sum of two vectors.
template <class T>
constexpr std::array<T, 3> sum(std::array<T, 3> const& a, std::array<T, 3> const& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// Difference of two numbers.
template <class T>
constexpr T difference(T const& a, T const& b) {
  return a - b;
}
/// Difference of two vectors.
template <class T>
constexpr std::array<T, 3> difference(std::array<T, 3> const& a, std::array<T, 3> const& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace scarp
