// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/evaluation.hpp"

namespace scarp {

/// Every iteration takes the points along the straight path from their committed states to the iterate: the answer is a function of
/// the iterate alone.
struct FromCommitted {
  template <class Problem>
  static Evaluation evaluate(Problem& problem, Eigen::VectorXd const& increment, bool) {
    return problem.evaluate(increment);
  }
  template <class Problem>
  static Evaluation refine(Problem& problem, Eigen::VectorXd const& increment) {
    return problem.refine(increment);
  }
};

/// The points follow the iterates: the first takes the whole increment, each later one only the correction, and a packing that
/// is not balanced works on where it is. Less work, and a disturbance shrinks with the corrections; but the answer belongs to the
/// path that the iteration took.
struct AlongIterates {
  template <class Problem>
  static Evaluation evaluate(Problem& problem, Eigen::VectorXd const& increment, bool first) {
    return first ? problem.evaluate(increment) : problem.advance(increment);
  }
  template <class Problem>
  static Evaluation refine(Problem& problem, Eigen::VectorXd const& increment) {
    return problem.rest(increment);
  }
};

}  // namespace scarp
