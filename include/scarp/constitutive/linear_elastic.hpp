// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/polar.hpp"

namespace scarp {

/// Isotropic linear elasticity between Cauchy stress and strain, carried along by the increment's rotation.
/// With F = I + gradient = R U the answer is
/// \f$ \sigma_1 = R\,(\sigma_0 + \lambda\,tr(E) I + 2 G E)\,R^T,\quad E = 2 (U - I)(U + I)^{-1} \f$
/// E is the strain of the stretch with respect to its half-way configuration; it differs from ln U by E^3/12, so a
/// large increment and the same one in many parts agree to second order. A rotation on top of any increment turns
/// the answer exactly. 2D means plane strain.
template <int Dim, class InitialStress = StressFree<Dim>>
  requires InitialStressField<InitialStress, Dim>
struct LinearElastic {
  static constexpr int dim = Dim;

  struct State {
    VoigtStress<Dim> stress = VoigtStress<Dim>::Zero();
  };

  double lame_lambda = 0.0;    ///< [Pa]
  double shear_modulus = 0.0;  ///< [Pa]
  InitialStress initial{};     ///< every point's start, by depth

  /// \throws InputError unless shear modulus and three-dimensional bulk modulus are finite and positive
  static LinearElastic from_lame(double lame_lambda, double shear_modulus, InitialStress initial = {}) {
    require_finite("Lame's lambda", lame_lambda);
    require_positive("shear modulus", shear_modulus);
    double const bulk_modulus = lame_lambda + 2.0 * shear_modulus / 3.0;
    if (!(bulk_modulus > 0.0)) {
      refuse(
          "the bulk modulus is {} Pa (lambda = {} Pa is too negative for the shear modulus {} Pa): choose lambda > {} "
          "Pa",
          bulk_modulus, lame_lambda, shear_modulus, -2.0 * shear_modulus / 3.0);
    }
    return {lame_lambda, shear_modulus, initial};
  }

  /// \throws InputError unless young > 0 and -1 < poisson < 0.5
  static LinearElastic from_young_poisson(double young, double poisson, InitialStress initial = {}) {
    require_positive("Young's modulus", young);
    if (!(poisson > -1.0 && poisson < 0.5)) {
      refuse("Poisson's ratio is {} (the material would not be stable): choose one above -1 and below 0.5", poisson);
    }
    return from_lame(young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)),
                     initial);
  }

  State initial_state(Site<Dim> const& site) const { return {initial.at(site.depth)}; }

  VoigtStress<Dim> stress(State const& state) const { return state.stress; }

  /// The same everywhere: \f$ C_{ijkl} = \lambda \delta_{ij}\delta_{kl} + G(\delta_{ik}\delta_{jl} + \delta_{il}\delta_{jk}) \f$
  VoigtTangent<Dim> tangent(State const&) const {
    VoigtTangent<Dim> tangent = VoigtTangent<Dim>::Zero();
    tangent.diagonal().setConstant(shear_modulus);
    tangent.template topLeftCorner<Dim, Dim>().diagonal().setConstant(2.0 * shear_modulus);
    tangent.template topLeftCorner<Dim, Dim>().array() += lame_lambda;
    return tangent;
  }

  /// Fails with `not_finite` on NaN or infinity and with `element_inverted` when det(I + increment) is not positive;
  /// `trial` is then a copy of `committed`.
  Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial) const {
    trial = committed;
    if (!increment.allFinite()) {
      return {committed.stress, {Status::failed, Reason::not_finite}};
    }
    Tensor<Dim> const identity = Tensor<Dim>::Identity();
    Tensor<Dim> const deformation = identity + increment;
    if (!(deformation.determinant() > 0.0)) {
      return {committed.stress, {Status::failed, Reason::element_inverted}};
    }
    Tensor<Dim> const turn = rotation_factor<Dim, double>(deformation);
    Tensor<Dim> const stretch = turn.transpose() * deformation;
    Tensor<Dim> const strain = 2.0 * (stretch - identity) * (stretch + identity).inverse();
    Tensor<Dim> const unturned = from_voigt_stress<Dim, double>(committed.stress) +
                                 lame_lambda * strain.trace() * identity + 2.0 * shear_modulus * strain;
    Tensor<Dim> const turned = turn * unturned * turn.transpose();
    VoigtStress<Dim> const answer = to_voigt_stress<Dim, double>(turned);
    if (!answer.allFinite()) {
      return {committed.stress, {Status::failed, Reason::not_finite}};
    }
    trial.stress = answer;
    return {answer, {}};
  }
};

static_assert(ConstitutiveProvider<LinearElastic<2>>);
static_assert(ConstitutiveProvider<LinearElastic<3>>);
static_assert(ConstitutiveProvider<LinearElastic<2, GeostaticStress<2>>>);

}  // namespace scarp
