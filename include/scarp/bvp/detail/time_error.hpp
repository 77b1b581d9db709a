// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scarp/bvp/detail/corner_field.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"

namespace scarp::detail {

/// Estimate of the error that one step of backward Euler makes, \f$ \frac{\Delta t^2}{2} \ddot u \f$, by the rates of
/// this step and of the last one in which time passed (Sloan and Abbo 1999, Int. J. Numer. Anal. Meth. Geomech. 23,
/// 467; they control displacements). Before the first one the rates are 0, those of a state at rest: a ground that was
/// loaded at once, or whose loads turn, has the error of first order \f$ \frac{\Delta t}{2} |\Delta \dot u| \f$, and
/// begins in small steps. The rate of a step of less than half the length of the one before, such as one that a knot
/// has cut short, is that of both: alone it is what the solver's tolerance leaves, over next to no time.
class TimeError {
 public:
  using Values = Eigen::VectorXd;

  /// Largest estimate of all values, by their change in a step of a duration [s]; 0 where no time passes.
  double of(Values const& change, double duration) const {
    if (!(duration > 0.0)) return 0.0;
    if (!rate_.empty() && viewed(rate_).size() != change.size())
      reject(
          "pore water was saved with {} unknown pressures (this one has {}): load it into one of the same boundaries",
          rate_.size(), change.size());
    Values const bend = rate_.empty() ? change : change - duration * viewed(rate_);
    return bend.lpNorm<Eigen::Infinity>() / 2.0;
  }

  void commit(Values const& change, double duration) {
    if (!(duration > 0.0)) return;
    bool const is_cut = 2.0 * duration < time_;
    Values const rate =
        is_cut ? Values((change + time_ * viewed(rate_)) / (duration + time_)) : Values(change / duration);
    time_ = duration;
    rate_.assign(rate.begin(), rate.end());
  }

  SCARP_MEMBERS(rate_, time_)

 private:
  std::vector<double> rate_{};  ///< of the last step with time [1/s]; empty before
  double time_ = 0.0;           ///< of that step [s]
};

}  // namespace scarp::detail
