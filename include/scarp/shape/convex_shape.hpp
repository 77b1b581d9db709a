// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "scarp/core/error.hpp"
#include "scarp/shape/support_contact.hpp"
#include "scarp/shape/support_integrals.hpp"

namespace scarp {

/// A number with its first and second derivative by an angle, for support functions; arithmetic and roots follow the
/// rules of differentiation.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <class T>
struct AngleJet {
  T value;     ///< itself
  T first{};   ///< derivative
  T second{};  ///< derivative of that

  /// A constant, without derivatives.
  constexpr AngleJet(double constant)
      : AngleJet(broadcast<T>(constant), broadcast<T>(0), broadcast<T>(0)) {}  // NOLINT: as numbers mix
  /// A number of which both derivatives are known.
  constexpr AngleJet(T const& number, T const& slope, T const& bend) : value(number), first(slope), second(bend) {}

  /// Sum.
  friend constexpr AngleJet operator+(AngleJet const& a, AngleJet const& b) {
    return {a.value + b.value, a.first + b.first, a.second + b.second};
  }
  /// Difference.
  friend constexpr AngleJet operator-(AngleJet const& a, AngleJet const& b) {
    return {a.value - b.value, a.first - b.first, a.second - b.second};
  }
  friend constexpr AngleJet operator-(AngleJet const& a) { return {-a.value, -a.first, -a.second}; }  ///< Negative.
  /// Product.
  friend constexpr AngleJet operator*(AngleJet const& a, AngleJet const& b) {
    T const mixed = a.first * b.first;
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + (mixed + mixed) + a.value * b.second};
  }
  /// Quotient.
  friend constexpr AngleJet operator/(AngleJet const& a, AngleJet const& b) {
    T const ratio = a.value / b.value;
    T const slope = (a.first - ratio * b.first) / b.value;
    return {ratio, slope, (a.second - (slope + slope) * b.first - ratio * b.second) / b.value};
  }
  /// Square root.
  friend constexpr AngleJet sqrt(AngleJet const& a) {
    using std::sqrt;
    T const root = sqrt(a.value);
    T const slope = broadcast<T>(0.5) * a.first / root;
    return {root, slope, (broadcast<T>(0.5) * a.second - slope * slope) / root};
  }
};

/// Base of a convex plane shape that is given by its support function alone: the distance h of the tangent line from
/// the centre of mass, as a function of the line's normal. Area, inertia, bounds and contacts follow from it.
/// \code
/// struct Oval : scarp::ConvexShape<Oval, 2> {  // two numbers: r [m], epsilon
///   template <class T>
///   static constexpr T support(std::array<T, 2> const& size, T const& cosine, T const& sine) {
///     return size[0] * (1.0 + size[1] * (cosine * cosine - sine * sine));
///   }
/// };
/// \endcode
/// cosine, sine: of the normal's angle from the grain's axis; T has +, -, *, / and sqrt, and mixes with doubles.
/// A member of the same name in the shape takes the place of one here, such as a closed form of `content`.
/// \tparam Numbers how many describe a grain, lengths first [m]
template <class Own, int Numbers>
struct ConvexShape {
  static constexpr int dim = 2;                     ///< grains of a plane
  static constexpr int size_count = Numbers;        ///< numbers of a grain
  static constexpr int orientation_count = 2;       ///< cosine and sine of the grain's axis
  static constexpr int pose_count = Numbers + 2;    ///< the axis, then the numbers of the grain
  static constexpr bool warm_starts_normal = true;  ///< a step of Newton's method starts from the stored normal

  template <class T>
  using Size = std::array<T, static_cast<std::size_t>(size_count)>;  ///< Numbers of a grain.
  template <class T>
  using Pose = std::array<T, static_cast<std::size_t>(pose_count)>;  ///< Axis and numbers of a grain.

  /// \throws InputError for a grain that is not convex, and for one whose centre of mass is not the centre
  static void check(Size<double> const& size) {
    auto const sums = integrals(size);
    if (!(sums.inner_radius > 0.0))
      reject("a grain of size {} is not convex (a radius of curvature is {:.4g} m): choose other numbers", size[0],
             sums.inner_radius);
    if (!(sums.off_centre <= 1e-6 * sums.bounding_radius))
      reject("a grain of size {} has its centre of mass {:.4g} m from its centre: give the support function from there",
             size[0], sums.off_centre);
  }
  static double content(Size<double> const& size) { return integrals(size).content; }  ///< Area [m2].
  /// Polar second moment about the centre over the area [m2].
  static double gyration_squared(Size<double> const& size) { return integrals(size).gyration_squared; }
  /// Farthest point of the boundary from the centre [m].
  static double bounding_radius(Size<double> const& size) { return integrals(size).bounding_radius; }
  /// Largest change of the support function per radian [m].
  static double eccentricity(Size<double> const& size) { return integrals(size).eccentricity; }

  /// Axis and numbers as they are.
  template <class T>
  static constexpr Pose<T> pose(Size<T> const& size, std::array<T, 2> const& axis) {
    Pose<T> made{axis[0], axis[1]};
    for (std::size_t k = 0; k < size.size(); ++k) made[k + 2] = size[k];
    return made;
  }

  /// Mean of the support function over eight normals [m]: for a smooth grain its perimeter over that of the unit
  /// circle.
  template <class T>
  static constexpr T contact_radius(Pose<T> const& pose) {
    T sum = broadcast<T>(0);
    constexpr double half = std::numbers::sqrt2 / 2.0;
    for (auto const& [x, y] :
         {std::array{1.0, 0.0}, std::array{half, half}, std::array{0.0, 1.0}, std::array{-half, half}}) {
      Point<2, T> const normal{broadcast<T>(x), broadcast<T>(y)};
      sum = sum + along(pose, normal).value + along(pose, {-normal[0], -normal[1]}).value;
    }
    return sum * broadcast<T>(0.125);
  }

  /// Support functions of both grains of a pair, the first's along the normal, the second's against it.
  template <class T>
  static constexpr std::array<Support<T>, 2> supports(Pose<T> const& first, Pose<T> const& second,
                                                      Point<2, T> const& normal) {
    return {along(first, normal), along(second, {-normal[0], -normal[1]})};
  }

  /// One step of Newton's method for a pair, by `support_contact`; branch [m], `normal` the unit vector to start from.
  template <class T>
  static constexpr ContactGeometry<2, T> touch(Pose<T> const& first, Pose<T> const& second, Point<2, T> const& branch,
                                               Point<2, T> const& normal) {
    return support_contact<Own>(first, second, branch, normal);
  }

 private:
  template <class T>
  static constexpr Support<T> along(Pose<T> const& pose, Point<2, T> const& normal) {
    using Jet = AngleJet<T>;
    T const zero = broadcast<T>(0);
    std::array<Jet, static_cast<std::size_t>(size_count)> const size = [&]<std::size_t... K>(
        std::index_sequence<K...>) {
      return std::array<Jet, static_cast<std::size_t>(size_count)>{Jet{pose[K + 2], zero, zero}...};
    }
    (std::make_index_sequence<static_cast<std::size_t>(size_count)>{});
    T const cosine = normal[0] * pose[0] + normal[1] * pose[1];
    T const sine = normal[1] * pose[0] - normal[0] * pose[1];
    Jet const h = Own::support(size, Jet{cosine, -sine, -cosine}, Jet{sine, cosine, -sine});
    return {h.value, h.first, h.value + h.second};
  }

  static SupportIntegrals integrals(Size<double> const& size) {
    auto const made = pose(size, std::array{1.0, 0.0});
    return SupportIntegrals::of([&](auto const& normal) { return along(made, normal); });
  }
};

}  // namespace scarp
