// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"

namespace scarp {

/// Course of a load or a prescribed motion over the load factor, which plays the part of time: linear between its
/// knots, constant beyond the outer ones. Without knots it is the load factor itself.
class TimeFunction {
 public:
  TimeFunction() = default;

  /// knots: (load factor, value), increasing in the load factor
  /// \throws InputError for knots that are not finite or not increasing
  explicit TimeFunction(std::vector<std::pair<double, double>> knots) : knots_(std::move(knots)) {
    if (knots_.empty()) reject("a time function has no knots (it needs at least one): give (load factor, value) pairs");
    for (std::size_t k = 0; k < knots_.size(); ++k) {
      require_finite("load factor of a knot", knots_[k].first);
      require_finite("value of a knot", knots_[k].second);
      if (k > 0 && !(knots_[k].first > knots_[k - 1].first)) {
        reject("knot {} is at the load factor {}, the one before at {} (they must increase): order the knots", k,
               knots_[k].first, knots_[k - 1].first);
      }
    }
  }

  /// One value at every load factor.
  static TimeFunction constant(double value) { return TimeFunction({{0.0, value}}); }

  /// From 0 to 1 between two load factors.
  static TimeFunction ramp(double from, double to) { return TimeFunction({{from, 0.0}, {to, 1.0}}); }

  /// Zero up to a load factor, then the load factor beyond it.
  static TimeFunction after(double start) {
    TimeFunction amplitude({{start, 0.0}});
    amplitude.slope_at_end_ = 1.0;
    return amplitude;
  }

  friend bool operator==(TimeFunction const&, TimeFunction const&) = default;

  /// Value at a load factor: linear between knots, constant beyond them.
  double operator()(double load) const {
    if (knots_.empty()) return load;
    auto const next = std::upper_bound(knots_.begin(), knots_.end(), load,
                                       [](double value, auto const& knot) { return value < knot.first; });
    if (next == knots_.begin()) return knots_.front().second;
    if (next == knots_.end()) return knots_.back().second + slope_at_end_ * (load - knots_.back().first);
    auto const& [left, low] = *(next - 1);
    auto const& [right, high] = *next;
    return low + (load - left) / (right - left) * (high - low);
  }

  /// Load factor of the first knot beyond one, where the course may turn; infinite beyond the last.
  double next_knot(double load) const {
    for (auto const& knot : knots_)
      if (knot.first > load) return knot.first;
    return std::numeric_limits<double>::infinity();
  }

 private:
  std::vector<std::pair<double, double>> knots_;
  double slope_at_end_ = 0.0;
};

/// Nodal forces [N] of a problem over its load factor: a sum of fixed patterns, each with its amplitude. Without a
/// pattern it has no size of its own, and a problem treats it as no load.
class LoadHistory {
 public:
  LoadHistory() = default;

  /// Constant loads. forces: shape (degrees of freedom)
  template <class Derived>
  LoadHistory(Eigen::MatrixBase<Derived> const& dead_load) {
    add(dead_load, TimeFunction::constant(1.0));
  }

  /// Adds nodal forces [N], shape (degrees of freedom), times `amplitude` at the load factor.
  /// \throws InputError for a pattern of another size or one that is not finite
  void add(Eigen::VectorXd forces, TimeFunction amplitude) {
    if (!parts_.empty() && forces.size() != size()) {
      reject("a load has {} entries (the others have {}): size it by the degrees of freedom", forces.size(), size());
    }
    if (!forces.allFinite()) reject("a load is not finite (it holds NaN or infinity): check its values");
    parts_.emplace_back(std::move(forces), std::move(amplitude));
  }

  /// Adds degrees of freedom without load.
  void add_dofs(int extra_dofs) {
    for (auto& [forces, amplitude] : parts_)
      forces.conservativeResizeLike(Eigen::VectorXd::Zero(forces.size() + extra_dofs));
  }

  /// Degrees of freedom of the patterns; zero where there is none.
  Eigen::Index size() const { return parts_.empty() ? 0 : parts_.front().first.size(); }

  /// Nodal forces [N] at a load factor, shape (size()); empty without a pattern.
  Eigen::VectorXd at(double load) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
    for (auto const& [forces, amplitude] : parts_) sum += amplitude(load) * forces;
    return sum;
  }

  /// Whether a pattern has a force from a degree of freedom on.
  bool act_from(Eigen::Index first) const {
    return std::ranges::any_of(parts_, [&](auto const& part) { return !part.first.tail(size() - first).isZero(0.0); });
  }

  /// Load factor of the first knot of any amplitude beyond one; infinite beyond the last.
  double next_knot(double load) const {
    double next = std::numeric_limits<double>::infinity();
    for (auto const& [forces, amplitude] : parts_) next = std::min(next, amplitude.next_knot(load));
    return next;
  }

 private:
  std::vector<std::pair<Eigen::VectorXd, TimeFunction>> parts_;
};

}  // namespace scarp
