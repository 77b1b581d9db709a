// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/solver/detail/quasi_newton_session.hpp"
#include "scarp/solver/plain_step.hpp"
#include "scarp/solver/point_secant.hpp"
#include "scarp/solver/sparse_lu.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/solver/consistent_tangent.hpp"
#endif

namespace scarp {

/// Newton-type iteration for one load step. The path says from which states the points answer an iterate (their committed
/// ones), the tangent rule what their tangents become on the way, the mixing what the correction becomes.
template <CheckedTangentRule<2> Rule = PointSecant, CheckedMixing Mixing = PlainStep,
          CheckedLinearSolver Linear = SparseLu, CheckedResponsePath Path = FromCommitted>
struct QuasiNewton {
  double tolerance = 5e-3;  ///< force residual relative to the reactions
  int most_iterations = 30;
  double hopeless = 10.0;    ///< residual beyond which a step is given up
  int most_refinements = 4;  ///< of points that have not converged, in each iteration
  /// A step's first guess is the motion of the step before, scaled by the load; after a refused one it is linear.
  bool repeats_motion = true;
  Rule rule{};
  Mixing mixing{};

  using RuleType = Rule;
  using MixingType = Mixing;
  using LinearType = Linear;
  using PathType = Path;

  /// The iteration on one problem. Its type matters only to a path along which points go on from their trial states.
  template <class Problem>
  using Seen = std::conditional_t<advances_trials<Path>, Problem, typename Problem::Interface>;
  template <class Problem>
  using Session = QuasiNewtonSession<QuasiNewton, Seen<Problem>>;
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
