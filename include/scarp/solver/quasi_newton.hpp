// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/detail/quasi_newton_session.hpp"
#include "scarp/solver/sparse_lu.hpp"
#include "scarp/solver/tangent_rules.hpp"

namespace scarp {

/// Newton-type iteration for one load step: the tangent rule says what the points' tangents become on the way. Every iteration
/// takes the points along the straight path from their committed states to the iterate.
template <TangentRule<2> Rule = PointSecant, LinearSolver Linear = SparseLu>
struct QuasiNewton {
  double tolerance = 5e-3;  ///< force residual, see EquilibriumProblem::residuals
  int most_iterations = 30;
  double hopeless = 10.0;    ///< residual beyond which a step is given up
  int most_refinements = 4;  ///< of points that have not converged, in each iteration
  /// A step's first guess is the motion of the step before, scaled by the load; after a refused one it is linear.
  bool repeats_motion = true;
  Rule rule{};

  /// \throws InputError for a setting outside of its range
  void validate() const {
    require_positive("tolerance of the force residual", tolerance);
    require_at_least("most iterations of a load step", most_iterations, 1);
    require_at_least("residual beyond which a step is given up", hopeless, tolerance);
    require_at_least("most refinements of an iteration", most_refinements, 0);
    detail::validated(rule);
  }

  using RuleType = Rule;
  using LinearType = Linear;

  /// The iteration on one problem, seen as an `IncrementalProblem`.
  template <class Problem>
  using Session = QuasiNewtonSession<QuasiNewton, typename Problem::Interface>;
};

#ifdef SCARP_PRECOMPILED
extern template class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<2>>;
extern template class QuasiNewtonSession<QuasiNewton<>, AttachedProblem<2>>;
extern template class QuasiNewtonSession<QuasiNewton<>, IncrementalProblem<3>>;
extern template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, IncrementalProblem<2>>;
extern template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, AttachedProblem<2>>;
extern template class QuasiNewtonSession<QuasiNewton<ConsistentTangent>, IncrementalProblem<3>>;
#endif

}  // namespace scarp
