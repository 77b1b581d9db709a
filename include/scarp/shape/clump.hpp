// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/simd/pack.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// A disc of a clump: centre and radius in the clump's own frame.
struct ClumpMember {
  double x;       ///< centre in the template's frame
  double y;       ///< centre in the template's frame
  double radius;  ///< in units of the clump's scale

  Vector<2> centre() const { return {x, y}; }  ///< In the template's frame, in units of the clump's scale.
};

/// Area, centroid and polar second moment about the centroid of a union of discs.
struct DiscUnion {
  double area;          ///< each point counted once, where discs overlap too
  Vector<2> centroid;   ///< in the frame of the discs
  double polar_moment;  ///< about the centroid, length to the fourth power
};

namespace detail {

/// How the boundary of a disc lies to another disc; discs that touch to round-off do not cross.
enum class Meeting { apart, inside, around, crossing };

inline Meeting meeting(ClumpMember const& own, ClumpMember const& other) {
  double const distance = (other.centre() - own.centre()).norm();
  double const slight = 1e-12 * (own.radius + other.radius);
  if (distance >= own.radius + other.radius - slight) return Meeting::apart;
  if (distance <= std::abs(own.radius - other.radius) + slight)
    return own.radius <= other.radius ? Meeting::inside : Meeting::around;
  return Meeting::crossing;
}

/// Angles at which the boundary of a disc enters or leaves other discs, with both ends of the full turn, sorted.
inline std::vector<double> crossing_angles(std::span<ClumpMember const> discs, std::size_t i) {
  std::vector<double> angles{-std::numbers::pi, std::numbers::pi};
  for (std::size_t j = 0; j < discs.size(); ++j) {
    auto const& other = discs[j];
    if (j == i || meeting(discs[i], other) != Meeting::crossing) continue;
    Vector<2> const branch = other.centre() - discs[i].centre();
    double const distance = branch.norm();
    double const own = discs[i].radius;
    double const direction = std::atan2(branch(1), branch(0));
    double const half =
        std::acos((distance * distance + own * own - other.radius * other.radius) / (2.0 * distance * own));
    for (double const angle : {direction - half, direction + half}) {
      angles.push_back(std::remainder(angle, 2.0 * std::numbers::pi));
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// Does another disc hide that point of the boundary of disc i?
inline bool is_covered(std::span<ClumpMember const> discs, std::size_t i, Vector<2> const& point) {
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    auto const how = meeting(discs[i], discs[j]);
    if (how == Meeting::crossing && (point - discs[j].centre()).norm() < discs[j].radius) return true;
    // The first of equal discs is seen.
    if (how == Meeting::inside && (meeting(discs[j], discs[i]) != Meeting::inside || j < i)) return true;
  }
  return false;
}

}  // namespace detail

/// Moments by Gauss's theorem over the arcs that no other disc covers; exact for any overlaps, also around holes.
/// \f$ A = \tfrac12\oint x\cdot n,\; A\bar x = \tfrac13\oint x\,(x\cdot n),\; J = \tfrac14\oint |x|^2\,(x\cdot n) \f$
/// with \f$ x = c + r e(t),\; x\cdot n\,ds = r (r + c\cdot e)\,dt \f$ on an arc
inline DiscUnion disc_union(std::span<ClumpMember const> discs) {
  double area = 0.0;
  Vector<2> first_moment = Vector<2>::Zero();
  double polar = 0.0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    double const r = discs[i].radius;
    Vector<2> const c = discs[i].centre();
    auto const angles = detail::crossing_angles(discs, i);
    for (std::size_t k = 0; k + 1 < angles.size(); ++k) {
      double const begin = angles[k];
      double const end = angles[k + 1];
      double const middle = (begin + end) / 2.0;
      if (detail::is_covered(discs, i, c + r * Vector<2>(std::cos(middle), std::sin(middle)))) continue;
      // Integrals of 1, e and e (x) e.
      double const turn = end - begin;
      Vector<2> const e(std::sin(end) - std::sin(begin), std::cos(begin) - std::cos(end));
      double const cos_squared = turn / 2.0 + (std::sin(2.0 * end) - std::sin(2.0 * begin)) / 4.0;
      double const mixed = (std::cos(2.0 * begin) - std::cos(2.0 * end)) / 4.0;
      Tensor<2> ee;
      ee << cos_squared, mixed, mixed, turn - cos_squared;

      double const swept = r * (r * turn + c.dot(e));
      area += swept / 2.0;
      first_moment += (c * swept + r * r * (r * e + ee * c)) / 3.0;
      polar += ((c.squaredNorm() + r * r) * swept + 2.0 * r * r * (r * c.dot(e) + c.dot(ee * c))) / 4.0;
    }
  }
  Vector<2> const centroid = first_moment / area;
  return {area, centroid, polar - area * centroid.squaredNorm()};
}

/// Rigid composition of discs in the plane; size is (scale), which multiplies `Template::members`, orientation (cos,
/// sin) of the template's x axis. The centre is the centroid of the union, whose area and inertia are those of the
/// grain. The pose of a part is its disc: offset (x, y) from the grain's centre in the frame of space, radius.
/// \tparam Template has the discs as `members`, a constant std::array of `ClumpMember`
template <class Template>
struct Clump {
  static constexpr int dim = 2;                ///< discs lie in a plane
  static constexpr int size_count = 1;         ///< the scale
  static constexpr int orientation_count = 2;  ///< cosine and sine of the template's x axis
  static constexpr int pose_count = 3;         ///< offset x, offset y and radius of one disc [m]
  static constexpr int part_count = detail::count(Template::members);  ///< discs of the template
  static constexpr bool warm_starts_normal = false;                    ///< the touch of two discs has a closed form
  static_assert(part_count > 0, "a clump needs at least one disc");

  template <class T>
  using Size = std::array<T, 1>;  ///< (scale), the length [m] of the template's unit

  /// Area [m2] of the union.
  static double content(Size<double> const& size) { return unit().area * size[0] * size[0]; }
  /// Polar second moment of the union about its centroid over its area [m2].
  static double gyration_squared(Size<double> const& size) { return unit().gyration_squared * size[0] * size[0]; }
  /// Distance of the centroid from the farthest point of a disc [m].
  static double bounding_radius(Size<double> const& size) { return unit().bounding_radius * size[0]; }
  /// Distance of the centroid from the farthest centre of a disc [m].
  static double eccentricity(Size<double> const& size) { return unit().largest_offset * size[0]; }

  /// Offset (x, y) of disc `part` from the grain's centre in the frame of space, and its radius [m].
  template <class T>
  static constexpr std::array<T, 3> pose(Size<T> const& size, std::array<T, 2> const& orientation, int part = 0) {
    ClumpMember const& member = unit().members[detail::index(part)];
    T const x = broadcast<T>(member.x) * size[0];
    T const y = broadcast<T>(member.y) * size[0];
    return {orientation[0] * x - orientation[1] * y, orientation[1] * x + orientation[0] * y,
            broadcast<T>(member.radius) * size[0]};
  }

  /// Radius of the disc that a part is [m].
  template <class T>
  static constexpr T contact_radius(std::array<T, 3> const& pose) {
    return pose[2];
  }

  /// Two discs, poses of parts of both grains; `branch` [m] joins the grains' centres and the arms start there.
  /// `normal` is ignored.
  template <class T>
  static constexpr ContactGeometry<2, T> touch(std::array<T, 3> const& first, std::array<T, 3> const& second,
                                               Point<2, T> const& branch, Point<2, T> const& normal) {
    Point<2, T> const between{branch[0] + second[0] - first[0], branch[1] + second[1] - first[1]};
    auto const discs = Disc::touch<T>({first[2]}, {second[2]}, between, normal);
    return {discs.overlap,
            discs.normal,
            {first[0] + discs.arm_first[0], first[1] + discs.arm_first[1]},
            {second[0] + discs.arm_second[0], second[1] + discs.arm_second[1]}};
  }

 private:
  /// The clump of scale one.
  struct Unit {
    std::array<ClumpMember, Template::members.size()> members = Template::members;  // about the union's centroid
    double area = 0.0;
    double gyration_squared = 0.0;
    double bounding_radius = 0.0;
    double largest_offset = 0.0;

    Unit() {
      DiscUnion const whole = disc_union(Template::members);
      area = whole.area;
      gyration_squared = whole.polar_moment / whole.area;
      for (ClumpMember& member : members) {
        member.x -= whole.centroid(0);
        member.y -= whole.centroid(1);
        double const offset = member.centre().norm();
        largest_offset = std::max(largest_offset, offset);
        bounding_radius = std::max(bounding_radius, offset + member.radius);
      }
    }
  };

  static Unit const& unit() {
    static Unit const unit;
    return unit;
  }
};

/// Two discs whose centres lie 1.5 radii apart; the scale of all templates here is the radius of a disc.
struct DumbbellTemplate {
  /// x, y, radius in units of the scale
  static constexpr std::array<ClumpMember, 2> members{{{-0.75, 0.0, 1.0}, {0.75, 0.0, 1.0}}};
};

/// Three discs on the corners of a triangle of side 1.5.
struct TrefoilTemplate {
  static constexpr double height = 0.75 * std::numbers::sqrt3;  ///< of the triangle, in units of the scale
  /// x, y, radius in units of the scale
  static constexpr std::array<ClumpMember, 3> members{
      {{-0.75, -height / 3.0, 1.0}, {0.75, -height / 3.0, 1.0}, {0.0, 2.0 * height / 3.0, 1.0}}};
};

/// Four discs on the corners of a square of side 1.4: small enough to leave no hole.
struct QuatrefoilTemplate {
  /// x, y, radius in units of the scale
  static constexpr std::array<ClumpMember, 4> members{
      {{-0.7, -0.7, 1.0}, {0.7, -0.7, 1.0}, {0.7, 0.7, 1.0}, {-0.7, 0.7, 1.0}}};
};

using Dumbbell = Clump<DumbbellTemplate>;      ///< Grain of two overlapping discs.
using Trefoil = Clump<TrefoilTemplate>;        ///< Grain of three overlapping discs.
using Quatrefoil = Clump<QuatrefoilTemplate>;  ///< Grain of four overlapping discs.

static_assert(ParticleShape<Dumbbell>);
static_assert(ParticleShape<Trefoil>);
static_assert(ParticleShape<Quatrefoil>);

}  // namespace scarp
