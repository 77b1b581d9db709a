// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

namespace nonlocal_band {

/// Fault rupture through level ground of Mohr-Coulomb soil that softens.
struct FaultChoice {
  std::vector<double> sizes{5.0, 3.5, 2.5};  ///< of a mesh cell in the band [m]
  std::vector<double> lengths{0.0, 8.0};     ///< intrinsic [m]
  double stiffness = 1.0;
  double fading = 1e-3;
  double throw_over_depth = 0.085;
  double tolerance = 1e-6;
};

/// Prints a row for each length and mesh.
void print_fault(FaultChoice const& choice);

}  // namespace nonlocal_band
