// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>

#include "scarp/tensor/voigt.hpp"

namespace scarp::geo {

/// Measures of the logarithmic strain,
/// \f$ \varepsilon_v = -\ln\det F,\; \varepsilon_q = \varepsilon_1 - \varepsilon_3 \f$: the difference of the outer
/// principal strains, in the plane \f$ \sqrt{2 e_{ij} e_{ij}} \f$.
struct Strain {
  double volumetric;  ///< contraction positive
  double deviatoric;  ///< at least zero
};

/// deformation: gradient of the present with respect to the initial position
template <int Dim>
Strain strain(Tensor<Dim> const& deformation) {
  Eigen::SelfAdjointEigenSolver<Tensor<Dim>> solver;
  solver.computeDirect(deformation.transpose() * deformation, Eigen::EigenvaluesOnly);
  Vector<Dim> principal;
  for (int k = 0; k < Dim; ++k) principal(k) = std::log(solver.eigenvalues()(k)) / 2.0;
  return {-principal.sum(), principal(Dim - 1) - principal(0)};
}

}  // namespace scarp::geo
