// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scarp/core/status.hpp"
#include "scarp/solver/part_residual.hpp"
#include "scarp/solver/point_survey.hpp"

namespace scarp {

/// Forces that an increment of displacement meets.
struct Evaluation {
  Eigen::VectorXd unbalanced;  ///< internal minus external force of all degrees of freedom [N]
  double residual = 0.0;       ///< see EquilibriumProblem::residual
  Verdict verdict;             ///< of the worst point
  int worst_point = -1;        ///< that is not acceptable, -1 for none
  long inner_steps = 0;        ///< DEM steps of all points
  PointSurvey points;
  std::vector<PartResidual> parts;  ///< see EquilibriumProblem::residuals; empty where the whole is the only one
};

}  // namespace scarp
