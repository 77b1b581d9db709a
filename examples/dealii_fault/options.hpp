// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string>

#include "../shared/study/choice.hpp"

namespace dealii_fault {

/// The study's free field, and what is this program's own.
struct Options : fault_rupture::Choice {
  int degree = 1;           ///< of the elements: 1 with the mean dilatation, 2 with reduced integration
  bool block = false;       ///< elastic ground settles under its weight instead of the fault
  bool newton = false;      ///< the points' tangents instead of initial stiffness with Anderson's acceleration
  double residual = 1e-4;   ///< of a balanced step
  int levels = 0;           ///< of refinement
  double refine_at = 0.02;  ///< shear strain since the last refinement that refines a cell; a tenth of it coarsens none
  int refine_every = 5;     ///< load steps
  double stop_at = 0.0;     ///< throw [m] at which the run is saved and ends; 0 for none
  std::string output{};     ///< folder of the fields; empty for none
  std::optional<double> own_x50{}, own_mean{};  ///< [m], of scarp's own elements
};

/// Runs on all processes of MPI, which it begins; trouble on one of them ends all.
/// \return exit code
int run_with_mpi(Options const& options, int argc, char** argv);

}  // namespace dealii_fault
