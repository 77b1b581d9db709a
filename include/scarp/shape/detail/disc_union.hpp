// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "scarp/core/tensor.hpp"

namespace scarp {

/// A disc of a clump: centre and radius in the clump's own frame.
struct ClumpMember {
  double x;
  double y;
  double radius;

  Vector<2> centre() const { return {x, y}; }
};

/// Area, centroid and polar second moment about the centroid of a union of discs.
struct DiscUnion {
  double area;
  Vector<2> centroid;
  double polar_moment;
};

namespace detail {

/// Angles at which the boundary of a disc enters or leaves other discs, with both ends of the full turn, sorted.
inline std::vector<double> crossing_angles(std::span<ClumpMember const> discs, std::size_t i) {
  std::vector<double> angles{-std::numbers::pi, std::numbers::pi};
  for (auto const& other : discs) {
    Vector<2> const branch = other.centre() - discs[i].centre();
    double const distance = branch.norm();
    double const own = discs[i].radius;
    if (distance >= own + other.radius || distance <= std::abs(own - other.radius)) continue;
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

/// Does another disc hide that point of the boundary of disc i? Of equal discs the first is seen.
inline bool is_covered(std::span<ClumpMember const> discs, std::size_t i, Vector<2> const& point) {
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    double const distance = (discs[j].centre() - discs[i].centre()).norm();
    bool const same = distance == 0.0 && discs[j].radius == discs[i].radius;
    bool const holds_all = distance + discs[i].radius <= discs[j].radius;
    if (same ? j < i : holds_all || (point - discs[j].centre()).norm() < discs[j].radius) return true;
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

}  // namespace scarp
