// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/error.hpp"
#include "scarp/core/random.hpp"
#include "scarp/shape/particle_shape.hpp"

namespace scarp {

// A program includes the shapes that it names.
struct Disc;
struct Sphere;
struct Ellipse;
struct Superellipse;
template <class Template>
struct Clump;

namespace detail {
inline void validate_grading(double smallest, double largest, double aspect = 1.0, double exponent = 1.0) {
  require_positive("smallest size of the grading", smallest);
  require_at_least("largest size of the grading", require_positive("largest size of the grading", largest), smallest);
  require_positive("aspect ratio of the grading", aspect);
  require_positive("exponent of the grading", exponent);
}
}  // namespace detail

/// Radii of round grains, or scales of clumps, uniform between two bounds [m].
/// \tparam ShapePolicy a `ParticleShape` of one parameter
template <class ShapePolicy>
struct RadiusGrading {
  using Shape = ShapePolicy;  ///< of the grains that it samples

  double smallest = 0.0;  ///< radius or scale [m]
  double largest = 0.0;   ///< radius or scale [m]

  /// \throws InputError, as those of all gradings
  void validate() const { detail::validate_grading(smallest, largest); }

  SizeOf<Shape> sample(Random& random) const { return {random.uniform(smallest, largest)}; }
};

/// Radii of discs.
using DiscGrading = RadiusGrading<Disc>;
/// Radii of spheres.
using SphereGrading = RadiusGrading<Sphere>;
/// Scales of the clumps of a template.
template <class Template>
using ClumpGrading = RadiusGrading<Clump<Template>>;

/// Semi-major axes uniform between two bounds [m]; semi-minor = aspect x semi-major.
/// \tparam ShapePolicy a `ParticleShape` of two parameters
template <class ShapePolicy>
struct AxesGrading {
  using Shape = ShapePolicy;  ///< of the grains that it samples

  double smallest = 0.0;  ///< semi-major axis [m]
  double largest = 0.0;   ///< semi-major axis [m]
  double aspect = 1.0;    ///< semi-minor over semi-major axis

  void validate() const { detail::validate_grading(smallest, largest, aspect); }

  SizeOf<Shape> sample(Random& random) const {
    double const major = random.uniform(smallest, largest);
    return {major, aspect * major};
  }
};

/// Axes of ellipses.
using EllipseGrading = AxesGrading<Ellipse>;

/// Axes as of ellipses, and one exponent for all grains.
/// \tparam ShapePolicy a `ParticleShape` of three parameters
template <class ShapePolicy>
struct ExponentGrading {
  using Shape = ShapePolicy;  ///< of the grains that it samples

  double smallest = 0.0;  ///< semi-major axis [m]
  double largest = 0.0;   ///< semi-major axis [m]
  double aspect = 1.0;    ///< semi-minor over semi-major axis
  double exponent = 1.0;  ///< of all grains, see `Superellipse`

  void validate() const { detail::validate_grading(smallest, largest, aspect, exponent); }

  SizeOf<Shape> sample(Random& random) const {
    double const major = random.uniform(smallest, largest);
    return {major, aspect * major, exponent};
  }
};

/// Axes and exponent of superellipses.
using SuperellipseGrading = ExponentGrading<Superellipse>;

}  // namespace scarp
