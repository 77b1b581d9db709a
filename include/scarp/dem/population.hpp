// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/shape/particle_shape.hpp"
#include "scarp/shape/support_integrals.hpp"
#include "scarp/simd/soa_array.hpp"

namespace scarp {

/// The grains of a packing as far as they never change: sizes, masses, inertias. One copy serves every state.
/// `thickness` [m] is the out-of-plane length in 2D and 1 in 3D, so that content x thickness is a volume.
/// \tparam Shape a `ParticleShape`
/// \tparam Scalar float or double
template <CheckedShape Shape, class Scalar = double>
class Population {
 public:
  using Size = std::array<double, static_cast<std::size_t>(Shape::size_count)>;  ///< parameters of one grain [m]

  /// density [kg/m3]
  /// \throws InputError on an empty list, on sizes that are not finite and positive, on those that the shape rejects,
  /// and for a shape whose area, inertia or bounds are not those of its support function
  Population(std::vector<Size> const& sizes, double density, double thickness)
      : density_(density), thickness_(thickness) {
    require_positive("grain density", density);
    require_positive("out-of-plane thickness", thickness);
    if (Shape::dim == 3 && thickness != 1.0) {
      reject("out-of-plane thickness of grains in space is {} m (stresses would be off by it): leave it 1", thickness);
    }
    if (sizes.empty())
      reject("a packing of zero grains was requested (nothing can carry stress): give at least one grain");
    if constexpr (!is_precompiled<Shape>) detail::require_closed_forms<Shape>(sizes.front());
    size_.resize(sizes.size(), Scalar(1));
    bounding_radius_.reserve(sizes.size());
    inverse_mass_.resize(sizes.size());
    inverse_inertia_.resize(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      for (int k = 0; k < Shape::size_count; ++k) {
        size_(i, k) = static_cast<Scalar>(require_positive("grain size", sizes[i][detail::index(k)]));
      }
      if constexpr (ChecksSizes<Shape>) Shape::check(sizes[i]);
      Size const grain = size(i);  // as stored: a population made from another one's sizes has the same bits
      double const content = Shape::content(grain);
      double const mass = density * content * thickness;
      double const inertia = mass * Shape::gyration_squared(grain);
      auto const fits = [](double value) {
        return std::isnormal(value) && std::isnormal(static_cast<Scalar>(1.0 / value));
      };
      if (!(fits(mass) && fits(inertia))) {
        reject(
            "a grain of size {} has a mass of {} kg and an inertia of {} kg m2 (beyond what a number here can hold): "
            "check "
            "the units of its size and density",
            size(i)[0], mass, inertia);
      }
      content_ += content;
      mass_ += mass;
      inverse_mass_(i, 0) = static_cast<Scalar>(1.0 / mass);
      inverse_inertia_(i, 0) = static_cast<Scalar>(1.0 / inertia);
      double const radius = Shape::bounding_radius(grain);
      double const eccentricity = Shape::eccentricity(grain);
      bounding_radius_.push_back(radius);
      smallest_radius_ = std::min(smallest_radius_, radius);
      largest_radius_ = std::max(largest_radius_, radius);
      double const width = content / (std::numbers::pi * std::pow(radius, Shape::dim - 1));
      largest_normal_change_ = std::min(largest_normal_change_, 0.01 / (0.5 + eccentricity / width));
      largest_eccentricity_ = std::max(largest_eccentricity_, eccentricity);
    }
    // In a loop of its own: a product that is used twice is fused with no sum, which would change an inertia's last
    // digit.
    if constexpr (HasInnerRadius<Shape>) {
      std::array<double, static_cast<std::size_t>(Shape::orientation_count)> axis{};
      if (!axis.empty()) axis.front() = 1.0;
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        for (int part = 0; part < part_count<Shape>(); ++part) {
          double const radius = Shape::inner_radius(part_pose<Shape>(size(i), axis, part));
          unique_minimum_depth_ = std::min(unique_minimum_depth_, 2.0 * radius);
        }
      }
    }
  }

  /// Number of grains.
  std::size_t count() const { return size_.rows(); }
  /// [kg/m3]
  double density() const { return density_; }
  /// Out of the plane [m]; 1 in space.
  double thickness() const { return thickness_; }
  /// Sum of the grains' areas (2D) [m2] or volumes (3D) [m3].
  double content() const { return content_; }
  /// Mass of all grains together [kg].
  double mass() const { return mass_; }
  /// Least bounding radius of a grain [m].
  double smallest_radius() const { return smallest_radius_; }
  /// Greatest bounding radius of a grain [m].
  double largest_radius() const { return largest_radius_; }
  /// Bounding radius of one grain [m].
  double bounding_radius(std::size_t grain) const { return bounding_radius_[grain]; }
  /// Bounding radii of all grains [m].
  std::vector<double> const& bounding_radii() const { return bounding_radius_; }
  /// Greatest change of a grain's support function per radian [m].
  double largest_eccentricity() const { return largest_eccentricity_; }

  /// Up to this angle [rad] one Newton step for the normal of a contact leaves an error of the overlap below 1e-6 of
  /// the grains' size: it grows with the cube of the angle and with how fast curvature changes.
  double largest_normal_change() const { return largest_normal_change_; }

  /// Up to this overlap [m] of any two grains a normal at which it is stationary is that of the least overlap. Infinite
  /// for shapes without a bound.
  double unique_minimum_depth() const { return unique_minimum_depth_; }

  /// Parameters of a grain [m] as stored, in double precision.
  Size size(std::size_t grain) const {
    Size values;
    for (int k = 0; k < Shape::size_count; ++k) {
      values[detail::index(k)] = static_cast<double>(size_(grain, k));
    }
    return values;
  }
  /// Parameters of all grains [m], a column for each.
  SoaArray<Scalar, Shape::size_count> const& sizes() const { return size_; }
  /// [1/kg]; zero in the padding, which therefore never moves
  Scalar const* inverse_mass() const { return inverse_mass_.column(0); }
  /// [1/(kg m2)]
  Scalar const* inverse_inertia() const { return inverse_inertia_.column(0); }

  /// Calls visit(name, member) for what the rest follows from, and for the content, which distinguishes shapes that
  /// have equally many sizes.
  template <class Visit>
  static void members(Population const& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(density_, thickness_, content_, mass_, smallest_radius_, largest_radius_, largest_eccentricity_,
                      largest_normal_change_, unique_minimum_depth_, bounding_radius_, size_, inverse_mass_,
                      inverse_inertia_);
    visit("density", self.density_);
    visit("thickness", self.thickness_);
    visit("content", self.content_);
    visit("sizes", self.size_);
  }

  /// The population whose members visit(name, member) fills in.
  /// \throws InputError when they are another shape's
  template <class Visit>
  static std::shared_ptr<Population const> restored(Visit&& visit) {
    double density = 0.0;
    double thickness = 0.0;
    double content = 0.0;
    SoaArray<Scalar, Shape::size_count> stored;
    visit("density", density);
    visit("thickness", thickness);
    visit("content", content);
    visit("sizes", stored);
    std::vector<Size> sizes(stored.rows());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      for (std::size_t k = 0; k < sizes[i].size(); ++k) {
        sizes[i][k] = static_cast<double>(stored(i, static_cast<int>(k)));
      }
    }
    auto population = std::make_shared<Population const>(sizes, density, thickness);
    constexpr double round_off = 1e-12;  // sums of the same numbers by another compiler's code
    if (!(std::abs(content - population->content()) <= round_off * population->content())) {
      reject(
          "its grains have a content of {} (of the requested shape they would have {}): load it as the shape that was "
          "saved",
          content, population->content());
    }
    return population;
  }

 private:
  double density_;
  double thickness_;
  double content_ = 0.0;
  double mass_ = 0.0;
  double smallest_radius_ = std::numeric_limits<double>::infinity();
  double largest_radius_ = 0.0;
  double largest_eccentricity_ = 0.0;
  double largest_normal_change_ = 1.0;
  double unique_minimum_depth_ = std::numeric_limits<double>::infinity();
  std::vector<double> bounding_radius_;
  SoaArray<Scalar, Shape::size_count> size_;
  SoaArray<Scalar, 1> inverse_mass_;
  SoaArray<Scalar, 1> inverse_inertia_;
};

}  // namespace scarp
