// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>

#include "scarp/tensor/voigt.hpp"

namespace scarp::geo {

/// Views for output in the plane, compression positive (p, eps_v) or unsigned (q, eps_q).
/// \f$ p = -\sigma_{ii}/2,\; q = \sqrt{2 s_{ij}s_{ij}} \f$: the difference of the principal stresses.
struct PlaneStress {
  double p;  ///< [Pa]
  double q;  ///< [Pa]
};

/// Views of a Cauchy stress [Pa], tension positive: p is its mean in the plane, compression positive.
inline PlaneStress plane_stress(VoigtStress<2> const& stress) {
  return {-(stress(0) + stress(1)) / 2.0, std::hypot(stress(0) - stress(1), 2.0 * stress(2))};
}

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
