// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/voigt.hpp"

namespace scarp {

/// Lame's constants of an isotropic material. [Pa]
struct IsotropicElasticity {
  double lame_lambda = 0.0;
  double shear_modulus = 0.0;

  /// \throws InputError unless shear modulus and three-dimensional bulk modulus are finite and positive
  static IsotropicElasticity from_lame(double lame_lambda, double shear_modulus) {
    require_finite("Lame's lambda", lame_lambda);
    require_positive("shear modulus", shear_modulus);
    double const bulk_modulus = lame_lambda + 2.0 * shear_modulus / 3.0;
    if (!(bulk_modulus > 0.0)) {
      refuse(
          "the bulk modulus is {} Pa (lambda = {} Pa is too negative for the shear modulus {} Pa): choose lambda > {} "
          "Pa",
          bulk_modulus, lame_lambda, shear_modulus, -2.0 * shear_modulus / 3.0);
    }
    return {lame_lambda, shear_modulus};
  }

  SCARP_MEMBERS(lame_lambda, shear_modulus)

  /// \throws InputError unless young > 0 and -1 < poisson < 0.5
  static IsotropicElasticity from_young_poisson(double young, double poisson) {
    require_positive("Young's modulus", young);
    if (!(poisson > -1.0 && poisson < 0.5)) {
      refuse("Poisson's ratio is {} (the material would not be stable): choose one above -1 and below 0.5", poisson);
    }
    return from_lame(young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)));
  }

  /// \f$ C_{ijkl} = \lambda \delta_{ij}\delta_{kl} + G(\delta_{ik}\delta_{jl} + \delta_{il}\delta_{jk}) \f$; 2D means plane strain.
  template <int Dim>
  VoigtTangent<Dim> stiffness() const {
    VoigtTangent<Dim> stiffness = VoigtTangent<Dim>::Zero();
    stiffness.diagonal().setConstant(shear_modulus);
    stiffness.template topLeftCorner<Dim, Dim>().diagonal().setConstant(2.0 * shear_modulus);
    stiffness.template topLeftCorner<Dim, Dim>().array() += lame_lambda;
    return stiffness;
  }

  /// Stress [Pa] of a strain tensor.
  template <int Dim>
  Tensor<Dim> stress(Tensor<Dim> const& strain) const {
    return lame_lambda * strain.trace() * Tensor<Dim>::Identity() + 2.0 * shear_modulus * strain;
  }
};

}  // namespace scarp
