// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "scarp/core/precompiled.hpp"
#include "scarp/simd/pack.hpp"

namespace scarp {

/// Coordinates or components of one point, or of a pack of points, in the frame of space.
template <int Dim, class T>
using Point = std::array<T, static_cast<std::size_t>(Dim)>;

/// Numbers that a rotation rate has: 1 in 2D, 3 in 3D.
template <int Dim>
inline constexpr int spin_size = Dim == 2 ? 1 : 3;

/// How two grains meet. `overlap` [m] is the least translation that parts them, positive when they touch; `normal` is the
/// unit vector of that translation, from the first grain to the second; the arms [m] reach from each centre to the
/// contact point, the middle between the two support points. `normal_error` is the angle [rad] by which the search for the normal
/// turned it last [rad], infinite where it found none, zero where the shape gives none: a touch that is far from its end is
/// searched anew, one that turned by less than 1e-8 has ended, which is right where errors fall as squares.
/// \tparam Dim 2 or 3
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <int Dim, class T>
struct ContactGeometry {
  T overlap;                 ///< [m], positive where the grains touch
  Point<Dim, T> normal;      ///< unit vector from the first grain to the second
  Point<Dim, T> arm_first;   ///< from the first centre to the contact point [m]
  Point<Dim, T> arm_second;  ///< from the second centre to the contact point [m]
  T normal_error{};          ///< angle of the search's last step [rad]
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
  { Shape::min_curvature_radius(size) } -> std::same_as<double>;  // [m]
};

/// Number of convex parts that a grain is composed of; one where the shape does not declare it.
template <class Shape>
constexpr int part_count() {
  if constexpr (requires { Shape::part_count; }) {
    return Shape::part_count;
  } else {
    return 1;
  }
}

/// Number of species that a shape distinguishes, 0 for none.
template <class Shape>
constexpr int species_count() {
  if constexpr (requires { Shape::species_count; }) {
    return Shape::species_count;
  } else {
    return 0;
  }
}

/// Numbers from which the contact search sees one part of a grain at its present orientation, or of a pack of grains.
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

/// A shape makes poses from sizes and orientation, and has a contact radius.
template <class Shape>
concept HasPose = requires(std::array<double, static_cast<std::size_t>(Shape::size_count)> const& size,
                           std::array<double, static_cast<std::size_t>(Shape::orientation_count)> const& orientation,
                           PoseOf<Shape> const& pose) {
  { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape>>;
  { Shape::contact_radius(pose) } -> std::same_as<double>;  // of the sphere or disc that curved contact laws see [m]
};

/// touch(first, second, branch, normal): `branch` from the first grain's centre to the second's; `normal` a unit vector to
/// start from where the shape stores one (`warm_starts_normal`), ignored otherwise. Arms reach from the grains' centres,
/// also where the poses are those of parts.
template <class Shape>
concept Touches = requires(PoseOf<Shape> const& pose, Point<Shape::dim, double> const& branch) {
  { Shape::touch(pose, pose, branch, branch) } -> std::same_as<ContactGeometry<Shape::dim, double>>;
  { Shape::warm_starts_normal } -> std::convertible_to<bool>;
};

/// pose, contact_radius and touch accept packs too: the pair loop evaluates several pairs at once.
template <class Shape>
concept TouchesInPacks =
    requires(SizeOf<Shape, lanes::Pack<double>> const& size,
             std::array<lanes::Pack<double>, static_cast<std::size_t>(Shape::orientation_count)> const& orientation,
             PoseOf<Shape, lanes::Pack<double>> const& pose, Point<Shape::dim, lanes::Pack<double>> const& branch) {
  { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape, lanes::Pack<double>>>;
  { Shape::contact_radius(pose) } -> std::same_as<lanes::Pack<double>>;
  { Shape::touch(pose, pose, branch, branch) } -> std::same_as<ContactGeometry<Shape::dim, lanes::Pack<double>>>;
};

/// A grain shape: static functions only, templates over the scalar so that packs of lanes pass through.
template <class Shape>
concept ParticleShape = HasGrainSize<Shape> && HasPose<Shape> && Touches<Shape> && TouchesInPacks<Shape>;

/// inner_radius(pose): of a disc [m] that rolls along the inside of the boundary everywhere (Blaschke); its least over
/// all poses is min_curvature_radius(size).
template <class Shape>
concept HasInnerRadius = requires(PoseOf<Shape> const& pose) {
  { Shape::inner_radius(pose) } -> std::same_as<double>;
};

namespace detail {

template <class Shape>
concept HasShapeCounts = requires {
  requires Shape::dim == 2 || Shape::dim == 3;
  requires Shape::size_count >= 1 && Shape::orientation_count >= 0 && Shape::pose_count >= 1;
};
/// Packings turn the axes (cos, sin) of plane grains; grains in space are the same all round.
template <class Shape>
concept HasAxesOfItsSpace = Shape::orientation_count == 0 || (Shape::dim == 2 && Shape::orientation_count == 2);
/// What of a shape is missing, in words.
template <class Shape, bool counted = HasShapeCounts<Shape>>
struct MissingOfShape {
  static_assert(counted,
                "scarp: a shape needs `static constexpr int` dim (2 or 3), size_count, orientation_count and "
                "pose_count");
  static constexpr bool nothing = false;
};
template <class Shape>
struct MissingOfShape<Shape, true> {
  static_assert(
      HasAxesOfItsSpace<Shape>,
      "scarp: a shape's orientation_count is 2 (cos, sin of its axis) for plane grains with axes, 0 for round "
      "ones and in space");
  static_assert(
      requires(SizeOf<Shape> const& size) {
        { Shape::content(size) } -> std::same_as<double>;
      },
      "scarp: a shape needs `static double content(SizeOf<Shape> const&)`: area [m2] or volume [m3] of a grain");
  static_assert(
      requires(SizeOf<Shape> const& size) {
        { Shape::gyration_squared(size) } -> std::same_as<double>;
      },
      "scarp: a shape needs `static double gyration_squared(SizeOf<Shape> const&)` [m2]: second moment over content");
  static_assert(
      requires(SizeOf<Shape> const& size) {
        { Shape::bounding_radius(size) } -> std::same_as<double>;
      },
      "scarp: a shape needs `static double bounding_radius(SizeOf<Shape> const&)` [m]");
  static_assert(
      requires(SizeOf<Shape> const& size) {
        { Shape::eccentricity(size) } -> std::same_as<double>;
      },
      "scarp: a shape needs `static double eccentricity(SizeOf<Shape> const&)` [m]: largest change of its support per "
      "radian");
  static_assert(
      requires(SizeOf<Shape> const& size) {
        { Shape::min_curvature_radius(size) } -> std::same_as<double>;
      },
      "scarp: a shape needs `static double min_curvature_radius(SizeOf<Shape> const&)` [m]");
  static_assert(
      requires(SizeOf<Shape> const& size,
               std::array<double, static_cast<std::size_t>(Shape::orientation_count)> const& orientation) {
        { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape>>;
      },
      "scarp: a shape needs `static std::array<T, pose_count> pose(size, orientation)`, of arrays of T");
  static_assert(
      requires(PoseOf<Shape> const& pose) {
        { Shape::contact_radius(pose) } -> std::same_as<double>;
      },
      "scarp: a shape needs `static T contact_radius(pose)` [m], of an std::array<T, pose_count>");
  static constexpr bool remembers = requires {
    { Shape::warm_starts_normal } -> std::convertible_to<bool>;
  };
  static_assert(remembers,
                "scarp: a shape needs `static constexpr bool warm_starts_normal`: whether its search starts from the "
                "last normal");
  static_assert(!remembers || Touches<Shape>,
                "scarp: a shape needs `static ContactGeometry<dim, T> "
                "touch(pose, pose, branch, normal)`");
  static_assert(!(HasPose<Shape> && Touches<Shape>) || TouchesInPacks<Shape>,
                "scarp: a shape is evaluated for several "
                "pairs at once: make pose, contact_radius and touch templates over the scalar");
  static constexpr bool nothing = false;
};

/// Compiles the shape for several pairs at once, before the pair loop does: what cannot be compiled, an `if` on a distance
/// for example, is then reported with this short name, by clang with the comment below, and not from within the loop.
template <class Shape>
constexpr bool a_shape_meets_many_pairs_at_once_so_it_takes_lanes_select_for_if() {
  if constexpr (!is_precompiled<Shape>) {
    using T = lanes::Pack<double>;
    [[maybe_unused]] auto const meet = [](PoseOf<Shape, T> const& pose, Point<Shape::dim, T> const& branch) {
      return Shape::touch(pose, pose, branch, branch);  // many_pairs_at_once: lanes::select in the place of `if`
    };
  }
  return true;
}

}  // namespace detail

/// A `ParticleShape`; for another type the compiler names the missing member.
template <class Shape>
concept CheckedShape = ((ParticleShape<Shape> && detail::HasAxesOfItsSpace<Shape>) ||
                        detail::MissingOfShape<Shape>::nothing) &&
                       detail::a_shape_meets_many_pairs_at_once_so_it_takes_lanes_select_for_if<Shape>();

}  // namespace scarp
