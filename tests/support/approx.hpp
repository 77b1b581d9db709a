// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>

/// Tolerances relative to what is compared and to nothing else. doctest::Approx(x).epsilon(e) allows e (1 + |x|): for
/// numbers far below one, such as overlaps in metres, that is no test at all.
namespace samples {

inline double relative_error(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

class Approx {
 public:
  explicit Approx(double expected) : expected_(expected) {}

  Approx& epsilon(double tolerance) {
    tolerance_ = tolerance;
    return *this;
  }

  friend bool operator==(double value, Approx const& other) {
    double const scale = std::max(std::abs(value), std::abs(other.expected_));
    if (!std::isfinite(scale)) return value == other.expected_;  // infinity is within a share of itself
    return std::abs(value - other.expected_) <= other.tolerance_ * scale;
  }
  friend std::ostream& operator<<(std::ostream& out, Approx const& other) {
    return out << other.expected_ << " within " << other.tolerance_;
  }

 private:
  double expected_;
  double tolerance_ = 1e-12;
};

}  // namespace samples
