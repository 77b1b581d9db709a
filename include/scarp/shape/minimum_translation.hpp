// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include "scarp/core/host_device.hpp"
#include "scarp/shape/support_contact.hpp"
#include "scarp/simd/vectors.hpp"

namespace scarp {

/// support(pose, normal): farthest point of a grain along a unit normal, for each grain alone.
template <class Shape>
concept HasSupportOfOne = requires(PoseOf<Shape> const& pose, Point<2, double> const& normal) {
  { Shape::support(pose, normal) } -> std::convertible_to<Support<double>>;
};
/// supports(first, second, normal): support of both grains of a pair at once.
template <class Shape>
concept HasSupportOfPair = requires(PoseOf<Shape> const& pose, Point<2, double> const& normal) {
  { Shape::supports(pose, pose, normal)[0] } -> std::convertible_to<Support<double>>;
};

/// A convex, centrally symmetric plane shape with a support function: for one grain, or for both of a pair.
template <class Shape>
concept HasSupport = Shape::dim == 2 && (HasSupportOfOne<Shape> || HasSupportOfPair<Shape>);

namespace detail {

/// \f$ f(n) = h_A(n) + h_B(n) - d \cdot n \f$ in one direction, and its bound for all others: with the support point
/// q = p_A + p_B - d there, f is nowhere less than q . n.
struct OverlapProbe {
  Point<2, double> normal;
  Support<double> first;
  Support<double> second;
  double value;
  double slope;
  Point<2, double> corner;  ///< q

  SCARP_HOST_DEVICE double size() const { return first.value + second.value; }
  SCARP_HOST_DEVICE bool is_finite() const { return (value + slope) - (value + slope) == 0.0; }
};

SCARP_HOST_DEVICE inline Point<2, double> unit(Point<2, double> const& a) {
  double const length = std::hypot(a[0], a[1]);
  return {a[0] / length, a[1] / length};
}

/// The part of the circle of directions between two probes, counterclockwise.
struct DirectionArc {
  std::size_t from;
  std::size_t to;
  double bound;            ///< f is nowhere less in between
  Point<2, double> split;  ///< where the bound is reached
};

/// At most so many entries, in order, without memory of their own.
template <class Entry, std::size_t most>
class ShortList {
 public:
  SCARP_HOST_DEVICE Entry const& operator[](std::size_t k) const { return entries_[k]; }
  SCARP_HOST_DEVICE Entry const& last() const { return entries_[count_ - 1]; }
  SCARP_HOST_DEVICE std::size_t count() const { return count_; }
  SCARP_HOST_DEVICE void clear() { count_ = 0; }
  SCARP_HOST_DEVICE void add(Entry const& entry) { entries_[count_++] = entry; }
  SCARP_HOST_DEVICE void remove(std::size_t k) {
    for (--count_; k < count_; ++k) entries_[k] = entries_[k + 1];
  }

 private:
  std::array<Entry, most> entries_;  // only what is added is ever read
  std::size_t count_ = 0;
};

/// The search of `minimum_translation`.
/// \tparam max_probes directions that are looked at before it gives up
template <HasSupport Shape, std::size_t max_probes = 500>
class MinimumTranslation {
 public:
  SCARP_HOST_DEVICE MinimumTranslation(PoseOf<Shape> const& first, PoseOf<Shape> const& second,
                                       Point<2, double> const& branch)
      : first_(first), second_(second), branch_(branch) {}

  /// From directions all round. \return whether no other direction can be better by more than 1e-10 of the grains' size
  SCARP_HOST_DEVICE bool search() {
    bool const apart = dot(branch_, branch_) > 0.0;
    return search_from(apart ? unit(branch_) : Point<2, double>{1.0, 0.0},
                       std::array{0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75});
  }

  /// Whether the overlap along a normal at which it is stationary is the least to 1e-10 of the grains' size. Next to
  /// the normal it could be less by the square of the angle to the next probe alone, times the overlap.
  SCARP_HOST_DEVICE bool is_least_along(Point<2, double> const& normal) {
    auto const there = probe(normal);
    double const beside =
        std::sqrt(1e-10 * there.size() / std::max(there.value, 1e-9 * there.size())) / std::numbers::pi;
    return search_from(normal, std::array{0.0, beside, 0.5, 1.0, 1.5, 2.0 - beside}) && best_ == 0;
  }

  /// The best direction, brought to where f' vanishes: Newton's steps within a bracket, halved where they leave it.
  SCARP_HOST_DEVICE ContactGeometry<2, double> touch() const {
    OverlapProbe const& start = probes_[best_];
    OverlapProbe at = start;
    double low = -widest(start, false);
    double high = widest(start, true);
    double turn = 0.0;
    for (int k = 0; k < 80; ++k) {
      (at.slope > 0.0 ? high : low) = turn;
      double const curvature = at.first.curvature_radius + at.second.curvature_radius - at.value;
      double next = turn - at.slope / curvature;
      if (!(curvature > 0.0 && next > low && next < high)) next = (low + high) / 2.0;
      double const step = next - turn;
      turn = next;
      at = probe(turned(start.normal, turn));
      if (std::abs(step) < 1e-15 || at.slope == 0.0) break;
    }
    return touch_at(at.value <= start.value ? at : start);
  }

 private:
  /// angles: from the first direction, in half turns, increasing
  template <std::size_t Count>
  SCARP_HOST_DEVICE bool search_from(Point<2, double> const& normal, std::array<double, Count> const& angles) {
    probes_.clear();
    arcs_.clear();
    best_ = 0;
    for (double const angle : angles) {
      probes_.add(probe(turned(normal, std::numbers::pi * angle)));
      if (!probes_.last().is_finite()) return false;
      if (probes_.last().value < probes_[best_].value - small_gain()) best_ = probes_.count() - 1;
    }
    for (std::size_t k = 0; k < Count; ++k) add_arc(k, (k + 1) % Count);
    while (probes_.count() < max_probes) {
      std::size_t lowest = 0;
      for (std::size_t k = 1; k < arcs_.count(); ++k) {
        if (arcs_[k].bound < arcs_[lowest].bound) lowest = k;
      }
      DirectionArc const arc = arcs_[lowest];
      if (!(arc.bound < probes_[best_].value - 1e-10 * probes_[best_].size())) return true;
      arcs_.remove(lowest);
      probes_.add(probe(arc.split));
      std::size_t const middle = probes_.count() - 1;
      if (!probes_[middle].is_finite()) return false;
      if (probes_[middle].value < probes_[best_].value - small_gain()) best_ = middle;
      add_arc(arc.from, middle);
      add_arc(middle, arc.to);
    }
    return false;
  }

  /// Less than this is round-off of the first probe.
  SCARP_HOST_DEVICE double small_gain() const { return 1e-14 * probes_[0].size(); }

  SCARP_HOST_DEVICE OverlapProbe probe(Point<2, double> const& n) const {
    OverlapProbe made{.normal = n, .first = {}, .second = {}, .value = 0.0, .slope = 0.0, .corner = {}};
    if constexpr (HasSupportOfPair<Shape>) {
      auto const both = Shape::supports(first_, second_, n);
      made.first = both[0];
      made.second = both[1];
    } else {
      made.first = Shape::support(first_, n);
      made.second = Shape::support(second_, n);
    }
    Point<2, double> const t{-n[1], n[0]};
    made.value = made.size() - dot(branch_, n);
    made.slope = made.first.slope + made.second.slope - dot(branch_, t);
    made.corner = {made.value * n[0] + made.slope * t[0], made.value * n[1] + made.slope * t[1]};
    return made;
  }

  /// Between two probes f is at least the larger of two sinusoids, of which each is the larger at its own end.
  SCARP_HOST_DEVICE void add_arc(std::size_t from, std::size_t to) {
    auto const& a = probes_[from];
    auto const& b = probes_[to];
    auto const inside = [](Point<2, double> const& left, Point<2, double> const& n, Point<2, double> const& right) {
      return cross(left, n) > 0.0 && cross(n, right) > 0.0;
    };
    // Along the edge's normal both are equal.
    Point<2, double> const edge{b.corner[0] - a.corner[0], b.corner[1] - a.corner[1]};
    Point<2, double> crossing{edge[1], -edge[0]};
    double const length = std::hypot(edge[0], edge[1]);
    bool const is_corner = !(length > 1e-15 * a.size());
    if (!is_corner) crossing = {crossing[0] / length, crossing[1] / length};
    Point<2, double> const middle = unit({a.normal[0] + b.normal[0], a.normal[1] + b.normal[1]});
    if (is_corner || !inside(a.normal, crossing, b.normal)) crossing = middle;
    DirectionArc arc{from, to, std::max(dot(crossing, a.corner), dot(crossing, b.corner)), crossing};
    for (auto const* end : {&a, &b}) {
      double const distance = std::hypot(end->corner[0], end->corner[1]);
      if (!(distance > 0.0)) continue;
      Point<2, double> const away{-end->corner[0] / distance, -end->corner[1] / distance};
      bool const leads = end == &a ? inside(a.normal, away, crossing) : inside(crossing, away, b.normal);
      if (leads || (is_corner && inside(a.normal, away, b.normal))) {
        arc.bound = -distance;
        arc.split = away;
      }
    }
    if (!(cross(a.normal, b.normal) > 1e-14)) arc.bound = std::min(a.value, b.value);  // as fine as directions are
    arcs_.add(arc);
  }

  /// Angle to the nearest probe on one side of the best one.
  SCARP_HOST_DEVICE double widest(OverlapProbe const& start, bool to_the_left) const {
    double angle = std::numbers::pi / 4.0;
    for (std::size_t k = 0; k < arcs_.count(); ++k) {
      auto const& arc = arcs_[k];
      if ((to_the_left ? arc.from : arc.to) != best_) continue;
      auto const& other = probes_[to_the_left ? arc.to : arc.from].normal;
      angle = std::atan2(std::abs(cross(start.normal, other)), dot(start.normal, other));
    }
    return angle;
  }

  SCARP_HOST_DEVICE static Point<2, double> turned(Point<2, double> const& n, double angle) {
    double const c = std::cos(angle);
    double const s = std::sin(angle);
    return {c * n[0] - s * n[1], s * n[0] + c * n[1]};
  }

  SCARP_HOST_DEVICE ContactGeometry<2, double> touch_at(OverlapProbe const& at) const {
    auto const& n = at.normal;
    Point<2, double> const t{-n[1], n[0]};
    double const radii = at.first.curvature_radius + at.second.curvature_radius;
    // On a flat side the support point is any of the side: where f' does not vanish it lies between its ends.
    double const turn = radii - at.value > 0.0 ? -at.slope / (radii - at.value) : 0.0;
    double const level = (at.first.value - at.second.value) / 2.0;
    double const shift =
        (at.first.slope - at.second.slope + turn * (at.first.curvature_radius - at.second.curvature_radius)) / 2.0;
    Point<2, double> const middle{branch_[0] / 2.0 + level * n[0] + shift * t[0],
                                  branch_[1] / 2.0 + level * n[1] + shift * t[1]};
    return {at.value, n, middle, {middle[0] - branch_[0], middle[1] - branch_[1]}};
  }

  PoseOf<Shape> first_;
  PoseOf<Shape> second_;
  Point<2, double> branch_;
  ShortList<OverlapProbe, max_probes> probes_;
  ShortList<DirectionArc, max_probes> arcs_;
  std::size_t best_ = 0;
};

}  // namespace detail

/// The touch of least overlap among all directions, whatever the shapes' curvature: convex polygons within and around
/// the sum of the two shapes are refined where they leave a better direction possible (the expanding polytope of van
/// den Bergen, 2001, for support functions), then Newton's method within a bracket. Slow; an infinite `normal_error`
/// where the least is not certain to 1e-10 of the grains' size (grains about one centre) or not finite.
template <HasSupport Shape>
ContactGeometry<2, double> minimum_translation(PoseOf<Shape> const& first, PoseOf<Shape> const& second,
                                               Point<2, double> const& branch) {
  detail::MinimumTranslation<Shape> search(first, second, branch);
  bool const certain = search.search();
  auto touch = search.touch();
  touch.normal_error = certain && std::isfinite(touch.overlap) ? 0.0 : std::numeric_limits<double>::infinity();
  return touch;
}

}  // namespace scarp
