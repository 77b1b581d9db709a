// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "scarp/core/named_member.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/simd/pack.hpp"

SCARP_NAMED_MEMBER(inner_radius)
SCARP_NAMED_MEMBER(check)

namespace scarp {

/// Coordinates or components of one point, or of a pack of points, in the frame of space.
template <int Dim, class T>
using Point = std::array<T, static_cast<std::size_t>(Dim)>;

/// Numbers that a rotation rate has: 1 in 2D, 3 in 3D.
template <int Dim>
inline constexpr int spin_size = Dim == 2 ? 1 : 3;

/// How two grains meet. `overlap` [m] is the least translation that parts them, positive when they touch; `normal` is
/// the unit vector of that translation, from the first grain to the second; the arms [m] reach from each centre to the
/// contact point, the middle between the two support points. `normal_error` is the angle [rad] by which the search for
/// the normal turned it last [rad], infinite where it found none, zero where the shape gives none: a touch that is far
/// from its end is searched anew, one that turned by less than 1e-8 has ended, which is right where errors fall as
/// squares.
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

/// content(size): area [m2] or volume [m3] of a grain, whose parameters are `size`.
template <class Shape>
concept HasContent = requires(SizeOf<Shape> const& size) {
  { Shape::content(size) } -> std::same_as<double>;
};
/// gyration_squared(size): second moment about the centre over the content [m2].
template <class Shape>
concept HasGyration = requires(SizeOf<Shape> const& size) {
  { Shape::gyration_squared(size) } -> std::same_as<double>;
};
/// bounding_radius(size) [m].
template <class Shape>
concept HasBoundingRadius = requires(SizeOf<Shape> const& size) {
  { Shape::bounding_radius(size) } -> std::same_as<double>;
};
/// eccentricity(size): largest change of the support function per radian [m].
template <class Shape>
concept HasEccentricity = requires(SizeOf<Shape> const& size) {
  { Shape::eccentricity(size) } -> std::same_as<double>;
};

/// Number of convex parts that a grain is composed of; one where the shape does not declare it.
template <class Shape>
constexpr int part_count() {
  if constexpr (requires { Shape::part_count; }) return Shape::part_count;
  return 1;
}

/// Whether half a turn brings every grain onto itself; no where the shape does not declare it.
template <class Shape>
constexpr bool is_point_symmetric() {
  if constexpr (requires { Shape::is_point_symmetric; }) return Shape::is_point_symmetric;
  return false;
}

/// Number of species that a shape distinguishes, 0 for none.
template <class Shape>
constexpr int species_count() {
  if constexpr (requires { Shape::species_count; }) return Shape::species_count;
  return 0;
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
constexpr auto part_pose(Size const& size, Orientation const& orientation, int part) {
  if constexpr (part_count<Shape>() == 1) {
    return Shape::pose(size, orientation);
  } else {
    return Shape::pose(size, orientation, part);
  }
}

/// A shape makes poses, what the contact search needs of grains at their present orientation, from sizes and
/// orientations.
template <class Shape>
concept HasPose = requires(SizeOf<Shape> const& size,
                           std::array<double, static_cast<std::size_t>(Shape::orientation_count)> const& orientation) {
  { part_pose<Shape>(size, orientation, 0) } -> std::same_as<PoseOf<Shape>>;
};
/// contact_radius(pose): radius [m] of the sphere or disc that curved contact laws see.
template <class Shape>
concept HasContactRadius = requires(PoseOf<Shape> const& pose) {
  { Shape::contact_radius(pose) } -> std::same_as<double>;
};
/// A shape names whether its search starts from the last normal.
template <class Shape>
concept NamesItsStart = requires {
  { Shape::warm_starts_normal } -> std::convertible_to<bool>;
};

/// touch(first, second, branch, normal): `branch` from the first grain's centre to the second's; `normal` a unit vector
/// to start from where the shape stores one (`warm_starts_normal`), ignored otherwise. Arms reach from the grains'
/// centres, also where the poses are those of parts.
template <class Shape>
concept Touches = requires(PoseOf<Shape> const& pose, Point<Shape::dim, double> const& branch) {
  { Shape::touch(pose, pose, branch, branch) } -> std::same_as<ContactGeometry<Shape::dim, double>>;
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

/// inner_radius(pose): of a disc [m] that rolls along the inside of the boundary everywhere (Blaschke), the same in all
/// orientations.
template <class Shape>
concept HasInnerRadius = requires(PoseOf<Shape> const& pose) {
  { Shape::inner_radius(pose) } -> std::same_as<double>;
};

/// check(size): rejects sizes that make no grain.
template <class Shape>
concept ChecksSizes = requires(SizeOf<Shape> const& size) {
  Shape::check(size);
};

/// A shape counts its dimensions and the numbers of a grain. Packings turn the axes (cos, sin) of plane grains; grains
/// in space are the same all round.
template <class Shape>
concept CountsNumbers = requires {
  requires Shape::dim == 2 || Shape::dim == 3;
  requires Shape::size_count >= 1 && Shape::orientation_count >= 0 && Shape::pose_count >= 1;
};
/// The orientation of a shape is one that packings turn.
template <class Shape>
concept HasAxesOfItsSpace = Shape::orientation_count == 0 || (Shape::dim == 2 && Shape::orientation_count == 2);

/// A grain shape: static functions only, templates over the scalar so that packs of lanes pass through.
template <class Shape>
concept ParticleShape = CountsNumbers<Shape> && HasAxesOfItsSpace<Shape> && HasContent<Shape> && HasGyration<Shape> &&
    HasBoundingRadius<Shape> && HasEccentricity<Shape> && HasPose<Shape> && HasContactRadius<Shape> &&
    NamesItsStart<Shape> && Touches<Shape> && TouchesInPacks<Shape>;

namespace detail {

/// Names the missing member of a type that is no `ParticleShape`.
template <class Shape>
consteval bool check_shape() {
  static_assert(CountsNumbers<Shape>,
                "scarp: a shape needs `static constexpr int` dim (2 or 3), size_count, orientation_count and "
                "pose_count");
  if constexpr (CountsNumbers<Shape>) {
    static_assert(
        HasAxesOfItsSpace<Shape>,
        "scarp: a shape's orientation_count is 2 (cos, sin of its axis) for plane grains with axes, 0 for round "
        "ones and in space");
    static_assert(
        HasContent<Shape>,
        "scarp: a shape needs `static double content(SizeOf<Shape> const&)`: area [m2] or volume [m3] of a grain");
    static_assert(
        HasGyration<Shape>,
        "scarp: a shape needs `static double gyration_squared(SizeOf<Shape> const&)` [m2]: second moment over content");
    static_assert(HasBoundingRadius<Shape>,
                  "scarp: a shape needs `static double bounding_radius(SizeOf<Shape> const&)` [m]");
    static_assert(HasEccentricity<Shape>,
                  "scarp: a shape needs `static double eccentricity(SizeOf<Shape> const&)` [m]: largest change of its "
                  "support per "
                  "radian");
    static_assert(HasPose<Shape>,
                  "scarp: a shape needs `static std::array<T, pose_count> pose(size, orientation)`, of arrays of T");
    static_assert(HasContactRadius<Shape>,
                  "scarp: a shape needs `static T contact_radius(pose)` [m], of an std::array<T, pose_count>");
    static_assert(NamesItsStart<Shape>,
                  "scarp: a shape needs `static constexpr bool warm_starts_normal`: whether its search starts from the "
                  "last normal");
    static_assert(!NamesItsStart<Shape> || Touches<Shape>,
                  "scarp: a shape needs `static ContactGeometry<dim, T> touch(pose, pose, branch, normal)`");
    static_assert(
        !(HasPose<Shape> && HasContactRadius<Shape> && Touches<Shape>) || TouchesInPacks<Shape>,
        "scarp: a shape is evaluated for several pairs at once: make pose, contact_radius and touch templates "
        "over the scalar");
  }
  if constexpr (ParticleShape<Shape> && !requires { typename Shape::Bare; }) {
    static_assert(HasInnerRadius<Shape> || !names_inner_radius<Shape>,
                  "scarp: inner_radius of a shape is never called: it needs `static double "
                  "inner_radius(std::array<double, pose_count> const& pose)` [m]");
    static_assert(ChecksSizes<Shape> || !names_check<Shape>,
                  "scarp: check of a shape is never called: it needs `static void check(SizeOf<Shape> const&)`");
  }
  return ParticleShape<Shape>;
}

/// Compiles the shape for several pairs at once, before the pair loop does: what cannot be compiled, an `if` on a
/// distance for example, is then reported with this short name, by clang with the comment below, and not from within
/// the loop.
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
concept CheckedShape =
    detail::check_shape<Shape>() && detail::a_shape_meets_many_pairs_at_once_so_it_takes_lanes_select_for_if<Shape>();

}  // namespace scarp
