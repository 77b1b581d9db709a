// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace scarp {

/// The columns of a table that hold the sizes of a shape's grains, in the shape's order. A shape that has an
/// orientation in the plane also names the column of its angle [rad], counter-clockwise from x. Another shape is one
/// specialisation more.
template <class Shape>
struct GrainColumns;

struct Disc;
struct Sphere;
struct Ellipse;
struct Superellipse;
template <class Template>
struct Clump;

template <>
struct GrainColumns<Disc> {
  static constexpr std::array<std::string_view, 1> size{"r"};
};

template <>
struct GrainColumns<Sphere> {
  static constexpr std::array<std::string_view, 1> size{"r"};
};

template <>
struct GrainColumns<Ellipse> {
  static constexpr std::array<std::string_view, 2> size{"a", "b"};
  static constexpr std::string_view angle = "angle";
};

template <>
struct GrainColumns<Superellipse> {
  static constexpr std::array<std::string_view, 3> size{"a", "b", "eps"};
  static constexpr std::string_view angle = "angle";
};

template <class Template>
struct GrainColumns<Clump<Template>> {
  static constexpr std::array<std::string_view, 1> size{"scale"};
  static constexpr std::string_view angle = "angle";
};

template <class Shape>
concept HasGrainColumns = requires {
  requires GrainColumns<Shape>::size.size() == static_cast<std::size_t>(Shape::size_count);
  requires Shape::orientation_count == 0 || (Shape::orientation_count == 2 && requires {
    { GrainColumns<Shape>::angle } -> std::convertible_to<std::string_view>;
  });
};

}  // namespace scarp
