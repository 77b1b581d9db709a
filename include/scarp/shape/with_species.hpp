// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scarp/core/error.hpp"
#include "scarp/shape/minimum_translation.hpp"
#include "scarp/shape/particle_shape.hpp"

namespace scarp {

/// Grains of one shape and of several species, for `LawPerSpecies`: size is that of the shape, then the species 1 to
/// `Species`.
template <CheckedShape Shape, int Species>
struct WithSpecies {
  using Bare = Shape;                                                    ///< grains without species
  static constexpr int dim = Shape::dim;                                 ///< of `Shape`
  static constexpr int size_count = Shape::size_count + 1;               ///< those of `Shape`, then the species
  static constexpr int orientation_count = Shape::orientation_count;     ///< of `Shape`
  static constexpr int pose_count = Shape::pose_count + 1;               ///< those of `Shape`, then the species
  static constexpr int part_count = scarp::part_count<Shape>();          ///< of `Shape`
  static constexpr int species_count = Species;                          ///< species are numbered from one
  static constexpr bool warm_starts_normal = Shape::warm_starts_normal;  ///< of `Shape`
  static constexpr bool is_point_symmetric = scarp::is_point_symmetric<Shape>();  ///< of `Shape`

  template <class T>
  using Size = SizeOf<WithSpecies, T>;  ///< that of `Shape`, then the species as a number
  template <class T>
  using Pose = PoseOf<WithSpecies, T>;  ///< that of `Shape`, then the species as a number

  /// \throws InputError for another species, and for sizes that the shape rejects
  static void check(Size<double> const& size) {
    double const species = size.back();
    if (!(species >= 1.0 && species <= Species && species == std::floor(species)))
      reject("a grain is of species {} (there are 1 to {}): give the last number of its size", species, Species);
    if constexpr (ChecksSizes<Shape>) Shape::check(bare(size));
  }

  /// Area [m2] or volume [m3] by `Shape`.
  static double content(Size<double> const& size) { return Shape::content(bare(size)); }
  /// Second moment over content [m2] by `Shape`.
  static double gyration_squared(Size<double> const& size) { return Shape::gyration_squared(bare(size)); }
  /// By `Shape` [m].
  static constexpr double bounding_radius(Size<double> const& size) { return Shape::bounding_radius(bare(size)); }
  /// Largest change of the support function per radian by `Shape` [m].
  static double eccentricity(Size<double> const& size) { return Shape::eccentricity(bare(size)); }

  /// Pose of a grain by `Shape`, or of its part `part`, with the species as last number.
  template <class T, class Orientation, class... Part>
  static constexpr Pose<T> pose(std::array<T, static_cast<std::size_t>(size_count)> const& size,
                                Orientation const& orientation, Part... part) {
    auto const own = Shape::pose(bare(size), orientation, part...);
    Pose<T> pose;
    std::copy(own.begin(), own.end(), pose.begin());
    pose.back() = size.back();
    return pose;
  }

  /// Number of the species, from one.
  template <class T>
  static constexpr T species(std::array<T, static_cast<std::size_t>(pose_count)> const& pose) {
    return pose.back();
  }
  /// By `Shape` [m].
  template <class T>
  static constexpr T contact_radius(std::array<T, static_cast<std::size_t>(pose_count)> const& pose) {
    return Shape::contact_radius(bare(pose));
  }
  /// By `Shape` [m].
  static constexpr double inner_radius(Pose<double> const& pose) requires HasInnerRadius<Shape> {
    return Shape::inner_radius(bare(pose));
  }

  /// By `Shape`, which does not see the species.
  template <class T>
  static constexpr ContactGeometry<dim, T> touch(std::array<T, static_cast<std::size_t>(pose_count)> const& first,
                                                 std::array<T, static_cast<std::size_t>(pose_count)> const& second,
                                                 Point<dim, T> const& branch, Point<dim, T> const& normal) {
    return Shape::touch(bare(first), bare(second), branch, normal);
  }
  /// Support function by `Shape` along a unit normal.
  static constexpr auto support(Pose<double> const& pose,
                                Point<2, double> const& normal) requires HasSupportOfOne<Shape> {
    return Shape::support(bare(pose), normal);
  }
  /// Support functions of a pair by `Shape` along one unit normal.
  static constexpr auto supports(Pose<double> const& first, Pose<double> const& second,
                                 Point<2, double> const& normal) requires HasSupportOfPair<Shape> {
    return Shape::supports(bare(first), bare(second), normal);
  }

 private:
  template <class T, std::size_t Size>
  static constexpr std::array<T, Size - 1> bare(std::array<T, Size> const& numbers) {
    std::array<T, Size - 1> own;
    std::copy_n(numbers.begin(), own.size(), own.begin());
    return own;
  }
};

}  // namespace scarp
