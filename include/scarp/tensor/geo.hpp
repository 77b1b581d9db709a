// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>

#include "scarp/tensor/voigt.hpp"

namespace scarp::geo {

/// Views for output in the plane, compression positive (p, eps_v) or unsigned (q, eps_q).
/// \f$ p = -\sigma_{ii}/2,\; q = \sqrt{s_{ij}s_{ij}/2} \f$ (half the difference of the principal stresses).
struct PlaneStress {
  double p;  ///< [Pa]
  double q;  ///< [Pa]
};

/// Of a Cauchy stress [Pa], tension positive: p is its mean in the plane, compression positive.
inline PlaneStress plane_stress(VoigtStress<2> const& stress) {
  double const half_difference = (stress(0) - stress(1)) / 2.0;
  return {-(stress(0) + stress(1)) / 2.0, std::hypot(half_difference, stress(2))};
}

/// Of the logarithmic strain: \f$ \varepsilon_v = -\ln\det F,\; \varepsilon_q = \sqrt{2 e_{ij} e_{ij}} \f$ (difference of the
/// principal strains).
struct PlaneStrain {
  double volumetric;  ///< contraction positive
  double deviatoric;  ///< at least zero
};

/// deformation: gradient of the present with respect to the initial position
inline PlaneStrain plane_strain(Tensor<2> const& deformation) {
  Eigen::SelfAdjointEigenSolver<Tensor<2>> solver;
  solver.computeDirect(deformation.transpose() * deformation, Eigen::EigenvaluesOnly);
  double const smaller = std::log(solver.eigenvalues()(0)) / 2.0;
  double const larger = std::log(solver.eigenvalues()(1)) / 2.0;
  return {-(smaller + larger), larger - smaller};
}

/// The same in space: the deviatoric part is the difference of the outer principal strains.
inline PlaneStrain space_strain(Tensor<3> const& deformation) {
  Eigen::SelfAdjointEigenSolver<Tensor<3>> solver;
  solver.computeDirect(deformation.transpose() * deformation, Eigen::EigenvaluesOnly);
  Vector<3> const strains = solver.eigenvalues().array().log() / 2.0;
  return {-strains.sum(), strains(2) - strains(0)};
}

}  // namespace scarp::geo
