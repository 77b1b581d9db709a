// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"

namespace scarp {

/// Wanted distance of grid lines along an axis: linear between knots, so that neighbouring cells differ little.
/// The number of cells between two places is \f$ \int dx / s(x) \f$; lines are at equal steps of it.
class Spacing {
 public:
  /// Cell size at a position; linear between knots.
  struct Knot {
    double position = 0.0;  ///< [m]
    double size = 1.0;      ///< [m], above zero
  };

  /// \throws InputError unless there are two knots and more, increasing in position, with sizes above zero
  explicit Spacing(std::vector<Knot> knots) : knots_(std::move(knots)), cells_before_(knots_.size(), 0.0) {
    if (knots_.size() < 2)
      reject("a spacing has {} knots (sizes are linear between two): give two or more", knots_.size());
    for (std::size_t k = 0; k < knots_.size(); ++k) {
      require_positive("size at a knot of a spacing", knots_[k].size);
      require_finite("position of a knot of a spacing", knots_[k].position);
      if (k > 0 && !(knots_[k].position > knots_[k - 1].position))
        reject("knots of a spacing lie at {} m and {} m (positions must increase): sort them", knots_[k - 1].position,
               knots_[k].position);
    }
    for (std::size_t k = 1; k < knots_.size(); ++k) {
      cells_before_[k] = cells_before_[k - 1] + cells_in(k - 1, knots_[k].position);
    }
  }

  /// Cells from the first knot to a position, not rounded.
  double cells_to(double position) const {
    std::size_t k = 0;
    while (k + 2 < knots_.size() && position > knots_[k + 1].position) {
      ++k;
    }
    return cells_before_[k] + cells_in(k, position);
  }

  /// The position that so many cells from the first knot reach.
  double position_after(double cells) const {
    std::size_t k = 0;
    while (k + 2 < knots_.size() && cells > cells_before_[k + 1]) {
      ++k;
    }
    double const slope = slope_of(k);
    double const left = cells - cells_before_[k];
    double const walked = slope == 0.0 ? left : std::expm1(slope * left) / slope;
    return knots_[k].position + knots_[k].size * walked;
  }

 private:
  double slope_of(std::size_t k) const {
    return (knots_[k + 1].size - knots_[k].size) / (knots_[k + 1].position - knots_[k].position);
  }

  double cells_in(std::size_t k, double position) const {
    double const slope = slope_of(k);
    double const walked = (position - knots_[k].position) / knots_[k].size;
    return slope == 0.0 ? walked : std::log1p(slope * walked) / slope;
  }

  std::vector<Knot> knots_;
  std::vector<double> cells_before_;
};

/// Number of cells between two neighbouring fixed lines: at least `least`, else the nearest to the wanted spacing.
/// \throws InputError for more than ten million
inline int cells_between(Spacing const& spacing, double from, double to, int least = 1) {
  double const cells = spacing.cells_to(to) - spacing.cells_to(from);
  constexpr double most = 1e7;
  if (cells > most)
    reject("{:.3g} cells would be between {} and {} m (at most {:.0g} are made): check the unit of the spacing", cells,
           from, to, most);
  return std::max(least, static_cast<int>(std::lround(cells)));
}

/// Grid lines [m] that pass exactly through every fixed position.
/// fixed: increasing positions, the first and the last are the ends
/// \throws InputError for positions that do not increase, or where the spacing falls to zero outside of its knots
inline std::vector<double> graded_lines(Spacing const& spacing, std::vector<double> const& fixed, int least = 1) {
  if (fixed.empty()) reject("grid lines are to pass through 0 positions: give the two ends");
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    if (!std::isfinite(spacing.cells_to(fixed[k])) || (k > 0 && !(fixed[k] > fixed[k - 1])))
      reject(
          "a grid line is to pass through {} m (positions must increase, within the knots of the spacing): correct it",
          fixed[k]);
  }
  std::vector<double> lines{fixed.front()};
  for (std::size_t k = 1; k < fixed.size(); ++k) {
    int const cells = cells_between(spacing, fixed[k - 1], fixed[k], least);
    double const first = spacing.cells_to(fixed[k - 1]);
    double const step = (spacing.cells_to(fixed[k]) - first) / cells;
    for (int i = 1; i < cells; ++i) {
      lines.push_back(spacing.position_after(first + i * step));
    }
    lines.push_back(fixed[k]);
  }
  return lines;
}

}  // namespace scarp
