// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/status.hpp"
#include "scarp/points/point_survey.hpp"

namespace scarp {

/// Imbalance of a part of a problem, relative to what carries or loads it: see Problem::residuals.
struct PartResidual {
  std::string name;    ///< "all", a region of the mesh, "attached" or the name of a field
  double value = 0.0;  ///< ratio of forces, without unit
};

/// Forces and residuals of an increment of displacement, with the points' report.
struct [[nodiscard]] Evaluation : ResponseReport {
  Eigen::VectorXd unbalanced{};       ///< internal minus external force of all degrees of freedom [N]
  double residual = 0.0;              ///< see Problem::residual
  std::vector<PartResidual> parts{};  ///< see Problem::residuals; empty where the whole is the only one
};

/// One iteration of a load step.
struct IterationRecord {
  double residual = 0.0;          ///< see Problem::residual
  double linear_residual = 0.0;   ///< |K x - b| / |b| of the linear system that led here
  long inner_steps = 0;           ///< DEM steps of all points
  double material_seconds = 0.0;  ///< wall time in the material points' responses and tangents, sum of forces included
  double seconds = 0.0;           ///< the same and of the linear system that led here
  Verdict verdict{};              ///< of the worst point
  int worst_point = -1;           ///< that is not acceptable, -1 for none
  PointSurvey points{};           ///< how many points have which status, and the slowest
};

/// Called between two responses of all points, since an attempt of large packings may last minutes. Empty: never.
using StopCondition = std::function<bool()>;

/// How one attempt at a load step went.
struct [[nodiscard]] StepReport {
  int step = 0;                            ///< number of the accepted step it was to become, from 1
  double load = 0.0;                       ///< load factor at its end
  double load_increment = 0.0;             ///< growth of the load factor
  Verdict verdict{};                       ///< acceptable where the step is committed
  int worst_point = -1;                    ///< material point behind a verdict that is not ok, -1 for none
  std::vector<IterationRecord> history{};  ///< one record for each iteration
  std::vector<PartResidual> parts{};       ///< of the last iteration; empty where the problem has no parts
  double max_displacement_gradient = 0.0;  ///< of the prediction, over all points
  double condition = 0.0;   ///< estimate of the stiffness at the start of the step, 1-norm; 0 where it was not made
  int weak_dof = -1;        ///< degree of freedom that a singular system does not hold, -1 for none
  double time_error = 0.0;  ///< estimated error in time over what is allowed; 0 where none is estimated
  double seconds = 0.0;     ///< wall time of the attempt

  int iterations() const { return detail::count(history); }  ///< Number of iterations, refinements not counted.
  /// Residual of the last iteration; 0 before the first.
  double residual() const { return history.empty() ? 0.0 : history.back().residual; }
  /// Whether a stop condition ended the attempt.
  bool interrupted() const { return verdict.reason == Reason::interrupted; }

  /// Ends an attempt that is not yet in equilibrium where that is requested.
  /// \return whether it has
  bool stopped(StopCondition const& stop) {
    if (!stop || !stop()) return false;
    verdict = {Status::not_converged, Reason::interrupted};
    return true;
  }
};

/// How far a run came.
struct [[nodiscard]] RunReport {
  Verdict verdict;                     ///< acceptable where the run reached its last load factor
  Reason last_failure = Reason::none;  ///< why the last rejected attempt was rejected
  int worst_point = -1;                ///< material point of that attempt, -1 for none
  int weak_dof = -1;                   ///< degree of freedom that its singular system did not hold, -1 for none
  double load = 0.0;                   ///< load factor of the committed state
  int steps = 0;                       ///< accepted
  int refused = 0;                     ///< attempts that were rolled back
  long iterations = 0;                 ///< of all attempts
  long inner_steps = 0;                ///< DEM steps of all attempts
  double largest_residual = 0.0;       ///< of the accepted steps
  double material_seconds = 0.0;       ///< wall time in responses and tangents of all attempts [s]
  double seconds = 0.0;                ///< wall time of all attempts [s]

  SCARP_MEMBERS(verdict, last_failure, worst_point, weak_dof, load, steps, refused, iterations, inner_steps,
                largest_residual, material_seconds, seconds)
};

/// Two stages of a run as one: counts and times add up, verdict and load are the later stage's, the last failure is
/// that of the last stage that had one.
inline RunReport joined(RunReport const& earlier, RunReport later) {
  if (later.refused == 0) {
    later.last_failure = earlier.last_failure;
    later.worst_point = earlier.worst_point;
    later.weak_dof = earlier.weak_dof;
  }
  later.steps += earlier.steps;
  later.refused += earlier.refused;
  later.iterations += earlier.iterations;
  later.inner_steps += earlier.inner_steps;
  later.largest_residual = std::max(later.largest_residual, earlier.largest_residual);
  later.material_seconds += earlier.material_seconds;
  later.seconds += earlier.seconds;
  return later;
}

}  // namespace scarp
