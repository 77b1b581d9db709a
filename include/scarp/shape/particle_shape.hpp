// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "scarp/core/pack.hpp"

namespace scarp {

template <int Dim, class T>
using Point = std::array<T, static_cast<std::size_t>(Dim)>;

/// Numbers that a rotation rate has: 1 in 2D, 3 in 3D.
template <int Dim>
inline constexpr int spin_size = Dim == 2 ? 1 : 3;

/// How two grains meet. `overlap` [m] is the least translation that parts them, positive when they touch; `normal` is the
/// unit vector of that translation, from the first grain to the second; the arms [m] reach from each centre to the
/// contact point, the middle between the two support points. `unsettled` tells by what angle the search for the normal
/// turned it last [rad], infinite where it found none, zero where it does not say: a touch that is far from its end is
/// searched anew, one that turned by less than 1e-8 has ended, which is right where errors fall as squares.
template <int Dim, class T>
struct Touch {
  T overlap;
  Point<Dim, T> normal;
  Point<Dim, T> arm_first;
  Point<Dim, T> arm_second;
  T unsettled{};
};

/// Parameters of one grain [m], as a scalar each or as packs of as many grains as a register holds.
template <class Shape, class T = double>
using SizeOf = std::array<T, static_cast<std::size_t>(Shape::size_count)>;

/// Everything in the same file and frame: `size` are the shape's parameters of one grain [m], `pose` what the contact
/// search needs of a grain at its present orientation.
template <class Shape>
concept HasGrainSize = requires(std::array<double, static_cast<std::size_t>(Shape::size_count)> const& size) {
  { Shape::content(size) } -> std::same_as<double>;           // area (2D) [m2] or volume [m3]
  { Shape::gyration_squared(size) } -> std::same_as<double>;  // second moment about the centre / content [m2]
  { Shape::bounding_radius(size) } -> std::same_as<double>;   // [m]
  { Shape::eccentricity(size) } -> std::same_as<double>;      // largest change of the support function per radian [m]
  { Shape::least_curvature_radius(size) } -> std::same_as<double>;  // [m]
};

/// Number of convex parts that a grain is composed of; a shape that does not say has one.
template <class Shape>
constexpr int part_count() {
  if constexpr (requires { Shape::part_count; }) {
    return Shape::part_count;
  } else {
    return 1;
  }
}

template <class Shape, class T = double>
using PoseOf = std::array<T, static_cast<std::size_t>(Shape::pose_count)>;

/// A shape of one part has pose(size, orientation), others pose(size, orientation, part).
template <class Shape, class Size, class Orientation>
concept MakesPose = (part_count<Shape>() == 1 &&
                     requires(Size const& size, Orientation const& orientation) { Shape::pose(size, orientation); }) ||
                    (part_count<Shape>() != 1 && requires(Size const& size, Orientation const& orientation, int part) {
                      Shape::pose(size, orientation, part);
                    });

/// Pose of a part of a grain.
template <class Shape, class Size, class Orientation>
  requires MakesPose<Shape, Size, Orientation>
auto part_pose(Size const& size, Orientation const& orientation, int part) {
  if constexpr (part_count<Shape>() == 1) {
    return Shape::pose(size, orientation);
  } else {
    return Shape::pose(size, orientation, part);
  }
}

template <class Shape>
concept HasPose = requires(std::array<double, static_cast<std::size_t>(Shape::size_count)> const& size,
                           std::array<double, static_cast<std::size_t>(Shape::orientation_count)> const& orientation,
                           PoseOf<Shape> const& pose) {
  { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape>>;
  { Shape::contact_radius(pose) } -> std::same_as<double>;  // of the sphere or disc that curved contact laws see [m]
};

/// touch(first, second, branch, normal): `branch` from the first grain's centre to the second's; `normal` a unit vector to
/// start from where the shape remembers one (`remembers_normal`), ignored otherwise. Arms reach from the grains' centres,
/// also where the poses are those of parts.
template <class Shape>
concept Touches = requires(PoseOf<Shape> const& pose, Point<Shape::dim, double> const& branch) {
  { Shape::touch(pose, pose, branch, branch) } -> std::same_as<Touch<Shape::dim, double>>;
  { Shape::remembers_normal } -> std::convertible_to<bool>;
};

/// pose, contact_radius and touch also take packs: the pair loop asks for several pairs at once.
template <class Shape>
concept TouchesInPacks =
    requires(SizeOf<Shape, lanes::Pack<double>> const& size,
             std::array<lanes::Pack<double>, static_cast<std::size_t>(Shape::orientation_count)> const& orientation,
             PoseOf<Shape, lanes::Pack<double>> const& pose, Point<Shape::dim, lanes::Pack<double>> const& branch) {
  { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape, lanes::Pack<double>>>;
  { Shape::contact_radius(pose) } -> std::same_as<lanes::Pack<double>>;
  { Shape::touch(pose, pose, branch, branch) } -> std::same_as<Touch<Shape::dim, lanes::Pack<double>>>;
};

/// A grain shape: static functions only, templates over the scalar so that packs of lanes pass through.
template <class Shape>
concept ParticleShape = HasGrainSize<Shape> && HasPose<Shape> && Touches<Shape> && TouchesInPacks<Shape>;

/// inner_radius(pose): of a disc [m] that rolls along the inside of the boundary everywhere (Blaschke); its least over
/// all poses is least_curvature_radius(size).
template <class Shape>
concept TellsInnerRadius = requires(PoseOf<Shape> const& pose) {
  { Shape::inner_radius(pose) } -> std::same_as<double>;
};

}  // namespace scarp
