// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/precompiled.hpp"
#include "scarp/shape/particle_shape.hpp"

namespace scarp {

namespace detail {

template <class Shape>
concept TellsShapeCounts = requires {
  requires Shape::dim == 2 || Shape::dim == 3;
  requires Shape::size_count >= 1 && Shape::orientation_count >= 0 && Shape::pose_count >= 1;
};
/// Packings turn the axes (cos, sin) of plane grains; grains in space are the same all round.
template <class Shape>
concept HasAxesOfItsSpace = Shape::orientation_count == 0 || (Shape::dim == 2 && Shape::orientation_count == 2);
template <class Shape>
concept TellsContent = requires(SizeOf<Shape> const& size) {
  { Shape::content(size) } -> std::same_as<double>;
};
template <class Shape>
concept TellsGyration = requires(SizeOf<Shape> const& size) {
  { Shape::gyration_squared(size) } -> std::same_as<double>;
};
template <class Shape>
concept TellsBoundingRadius = requires(SizeOf<Shape> const& size) {
  { Shape::bounding_radius(size) } -> std::same_as<double>;
};
template <class Shape>
concept TellsEccentricity = requires(SizeOf<Shape> const& size) {
  { Shape::eccentricity(size) } -> std::same_as<double>;
};
template <class Shape>
concept TellsLeastCurvature = requires(SizeOf<Shape> const& size) {
  { Shape::least_curvature_radius(size) } -> std::same_as<double>;
};
template <class Shape>
concept MakesPoseOfSize =
    requires(SizeOf<Shape> const& size,
             std::array<double, static_cast<std::size_t>(Shape::orientation_count)> const& orientation) {
  { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape>>;
};
template <class Shape>
concept TellsContactRadius = requires(PoseOf<Shape> const& pose) {
  { Shape::contact_radius(pose) } -> std::same_as<double>;
};
template <class Shape>
concept SaysWhetherItRemembers = requires {
  { Shape::remembers_normal } -> std::convertible_to<bool>;
};

/// What of a shape is missing, in words.
template <class Shape, bool counted = TellsShapeCounts<Shape>>
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
  static_assert(TellsContent<Shape>,
                "scarp: a shape needs `static double content(SizeOf<Shape> const&)`: area [m2] or "
                "volume [m3] of a grain");
  static_assert(TellsGyration<Shape>,
                "scarp: a shape needs `static double gyration_squared(SizeOf<Shape> const&)` [m2]: "
                "second moment over content");
  static_assert(TellsBoundingRadius<Shape>,
                "scarp: a shape needs `static double bounding_radius(SizeOf<Shape> const&)` "
                "[m]");
  static_assert(TellsEccentricity<Shape>,
                "scarp: a shape needs `static double eccentricity(SizeOf<Shape> const&)` [m]: "
                "largest change of its support per radian");
  static_assert(TellsLeastCurvature<Shape>,
                "scarp: a shape needs `static double least_curvature_radius(SizeOf<Shape> "
                "const&)` [m]");
  static_assert(MakesPoseOfSize<Shape>,
                "scarp: a shape needs `static std::array<T, pose_count> pose(size, "
                "orientation)`, of arrays of T");
  static_assert(TellsContactRadius<Shape>,
                "scarp: a shape needs `static T contact_radius(pose)` [m], of an "
                "std::array<T, pose_count>");
  static_assert(SaysWhetherItRemembers<Shape>,
                "scarp: a shape needs `static constexpr bool remembers_normal`: whether "
                "its search starts from the last normal");
  static_assert(!SaysWhetherItRemembers<Shape> || Touches<Shape>,
                "scarp: a shape needs `static Touch<dim, T> "
                "touch(pose, pose, branch, normal)`");
  static_assert(!(HasPose<Shape> && Touches<Shape>) || TouchesInPacks<Shape>,
                "scarp: a shape is asked for several "
                "pairs at once: make pose, contact_radius and touch templates over the scalar");
  static constexpr bool nothing = false;
};

/// Compiles the shape for several pairs at once, before the pair loop does: what cannot be compiled, an `if` on a distance
/// say, is then reported with this short name, by clang with the comment below, and not from within the loop.
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

/// A `ParticleShape`; of one that is none the compiler says in words what is missing.
template <class Shape>
concept CheckedShape = ((ParticleShape<Shape> && detail::HasAxesOfItsSpace<Shape>) ||
                        detail::MissingOfShape<Shape>::nothing) &&
                       detail::a_shape_meets_many_pairs_at_once_so_it_takes_lanes_select_for_if<Shape>();

}  // namespace scarp
