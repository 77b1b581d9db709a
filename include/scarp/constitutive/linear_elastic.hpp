// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Lame's constants of an isotropic material. [Pa]
struct IsotropicElasticity {
  double lame_lambda = 0.0;    ///< lambda [Pa]
  double shear_modulus = 0.0;  ///< G [Pa]

  /// \throws InputError unless shear modulus and three-dimensional bulk modulus are finite and positive
  void validate() const {
    require_finite("Lame's lambda", lame_lambda);
    require_positive("shear modulus", shear_modulus);
    double const bulk_modulus = lame_lambda + 2.0 * shear_modulus / 3.0;
    if (!(bulk_modulus > 0.0)) {
      reject(
          "the bulk modulus is {} Pa (lambda = {} Pa is too negative for the shear modulus {} Pa): choose lambda > {} "
          "Pa",
          bulk_modulus, lame_lambda, shear_modulus, -2.0 * shear_modulus / 3.0);
    }
  }

  /// From Lame's constants [Pa].
  /// \throws InputError as validate() does
  static IsotropicElasticity from_lame(double lame_lambda, double shear_modulus) {
    return detail::validated(IsotropicElasticity{lame_lambda, shear_modulus});
  }

  SCARP_MEMBERS(lame_lambda, shear_modulus)

  /// From Young's modulus [Pa] and Poisson's ratio.
  /// \throws InputError unless young > 0 and -1 < poisson < 0.5
  static IsotropicElasticity from_young_poisson(double young, double poisson) {
    require_positive("Young's modulus", young);
    if (!(poisson > -1.0 && poisson < 0.5)) {
      reject("Poisson's ratio is {} (the material would not be stable): choose one above -1 and below 0.5", poisson);
    }
    return from_lame(young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson)));
  }

  /// \f$ C_{ijkl} = \lambda \delta_{ij}\delta_{kl} + G(\delta_{ik}\delta_{jl} + \delta_{il}\delta_{jk}) \f$; 2D means
  /// plane strain.
  template <int Dim>
  VoigtTangent<Dim> stiffness() const {
    VoigtTangent<Dim> stiffness = VoigtTangent<Dim>::Zero();
    for (int k = 0; k < voigt_size<Dim>; ++k) {
      stiffness(k, k) = k < Dim ? 2.0 * shear_modulus : shear_modulus;
      if (k < Dim) {
        for (int l = 0; l < Dim; ++l) stiffness(k, l) += lame_lambda;
      }
    }
    return stiffness;
  }

  /// Stress [Pa] of a strain tensor.
  template <int Dim>
  Tensor<Dim> stress(Tensor<Dim> const& strain) const {
    return lame_lambda * strain.trace() * Tensor<Dim>::Identity() + 2.0 * shear_modulus * strain;
  }
};

/// Isotropic linear elasticity between Cauchy stress and strain, carried along by the increment's rotation.
/// \f$ \sigma_1 = R\,(\sigma_0 + \lambda\,tr(E) I + 2 G E)\,R^T \f$ with rotation R and strain E of the increment. A
/// rotation on top of any increment turns the stress exactly. 2D means plane strain.
/// \tparam Dim 2 or 3
/// \tparam InitialStress an `InitialStressField`
template <int Dim, class InitialStress = StressFree<Dim>>
  requires InitialStressField<InitialStress, Dim>
struct LinearElastic {
  static constexpr int dim = Dim;
  static constexpr bool exact_tangent = true;  ///< but for the rotation of an increment

  /// Stress [Pa], tension positive.
  struct State {
    VoigtStress<Dim> stress = VoigtStress<Dim>::Zero();  ///< Cauchy [Pa], tension positive

    SCARP_MEMBERS(stress)
  };

  IsotropicElasticity elasticity{};  ///< of all points
  InitialStress initial{};           ///< every point's start, by depth

  /// From Lame's constants [Pa].
  /// \throws InputError unless shear modulus and three-dimensional bulk modulus are finite and positive
  static LinearElastic from_lame(double lame_lambda, double shear_modulus, InitialStress initial = {}) {
    return {IsotropicElasticity::from_lame(lame_lambda, shear_modulus), initial};
  }

  /// From Young's modulus [Pa] and Poisson's ratio.
  /// \throws InputError unless young > 0 and -1 < poisson < 0.5
  static LinearElastic from_young_poisson(double young, double poisson, InitialStress initial = {}) {
    return {IsotropicElasticity::from_young_poisson(young, poisson), initial};
  }

  /// The initial stress at the depth of a site.
  /// \throws InputError for an elasticity or an initial stress that cannot be
  State initial_state(Site<Dim> const& site) const {
    elasticity.validate();
    return {initial_stress<Dim>(initial, site)};
  }

  VoigtStress<Dim> stress(State const& state) const { return state.stress; }

  /// Elastic stiffness [Pa], equal at all points.
  VoigtTangent<Dim> tangent(State const&) const { return elasticity.template stiffness<Dim>(); }

  /// Fails with `not_finite` on NaN or infinity and with `element_inverted` when det(I + increment) is not positive;
  /// `trial` is then a copy of `committed`.
  Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial) const {
    trial = committed;
    RotatedIncrement<Dim> const moved(increment);
    if (!moved.verdict.acceptable()) return {committed.stress, moved.verdict};
    Tensor<Dim> const unturned =
        from_voigt_stress<Dim, double>(committed.stress) + elasticity.stress<Dim>(moved.strain);
    VoigtStress<Dim> const result = to_voigt_stress<Dim, double>(turned<Dim>(moved.turn, unturned));
    if (!result.allFinite()) {
      return {committed.stress, {Status::failed, Reason::not_finite}};
    }
    trial.stress = result;
    return {result, {}};
  }
};

static_assert(ConstitutiveProvider<LinearElastic<2>>);
static_assert(ConstitutiveProvider<LinearElastic<3>>);
static_assert(ConstitutiveProvider<LinearElastic<2, GeostaticStress<2>>>);

}  // namespace scarp
