// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

namespace scarp {

/// Imbalance of a part of a problem, relative to what carries or loads it: see EquilibriumProblem::residuals.
struct PartResidual {
  std::string name;  ///< "all", a region of the mesh, or "attached"
  double value = 0.0;
};

}  // namespace scarp
