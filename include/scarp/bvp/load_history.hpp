// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include "scarp/bvp/time_function.hpp"

namespace scarp {

/// Nodal forces [N] of a problem over its load factor: a sum of fixed patterns, each with its course. Without a pattern
/// it has no size of its own, and a problem takes it for no load at all.
class LoadHistory {
 public:
  LoadHistory() = default;

  /// The same at every load factor. forces: shape (degrees of freedom)
  template <class Derived>
  LoadHistory(Eigen::MatrixBase<Derived> const& dead_load) {
    add(dead_load, TimeFunction::constant(1.0));
  }

  /// \throws InputError for a pattern of another size or one that is not finite
  void add(Eigen::VectorXd forces, TimeFunction course) {
    if (!parts_.empty() && forces.size() != size()) {
      refuse("a load has {} entries (the others have {}): size it by the degrees of freedom", forces.size(), size());
    }
    if (!forces.allFinite()) refuse("a load is not finite (it holds NaN or infinity): check its values");
    parts_.emplace_back(std::move(forces), std::move(course));
  }

  /// Degrees of freedom of the patterns; zero where there is none.
  Eigen::Index size() const { return parts_.empty() ? 0 : parts_.front().first.size(); }

  Eigen::VectorXd at(double load) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
    for (auto const& [forces, course] : parts_) sum += course(load) * forces;
    return sum;
  }

 private:
  std::vector<std::pair<Eigen::VectorXd, TimeFunction>> parts_;
};

}  // namespace scarp
