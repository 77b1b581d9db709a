// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/described.hpp"

namespace scarp {

/// Any provider whose points keep a small elastic stiffness while they are fluid: a packing that has lost its contacts
/// has no stiffness, and a node with such points all around it would be held by nothing. Strain of the fluid state
/// meets an isotropic stiffness; its stress is added to the response and is dropped when contacts carry again.
/// `floor_share` is the share of all stress that is not the material's. A point that is not fluid responds as the
/// provider does, bit for bit.
template <CheckedProvider Provider>
struct StiffnessFloor {
  static constexpr int dim = Provider::dim;
  static constexpr bool exact_tangent = has_exact_tangent<Provider>();  ///< as the provider inside
  using Plan = PlanOf<Provider>;                                        ///< of the inner provider

  /// State of the inner provider and stress of the elastic floor.
  struct State {
    typename Provider::State own;                              ///< of the inner provider
    IsotropicElasticity elasticity{};                          ///< of the floor [Pa]
    VoigtStress<dim> floor_stress = VoigtStress<dim>::Zero();  ///< [Pa]
    bool fluid = false;  ///< whether the inner response is fluid, so that the floor acts

    /// For saving, see `Described`.
    template <class Self, class Visit>
    static void members(Self& self, Visit&& visit) requires Described<typename Provider::State> {
      SCARP_ALL_MEMBERS(own, elasticity, floor_stress, fluid);
      visit("own", self.own);
      visit("elasticity", self.elasticity);
      visit("floor_stress", self.floor_stress);
      visit("fluid", self.fluid);
    }
  };

  Provider provider{};         ///< of the points while they carry
  double share = 1e-4;         ///< of the isotropic part of the initial tangent
  double shear_modulus = 0.0;  ///< [Pa] instead, with Poisson's ratio zero, when positive

  /// \throws InputError for a share that is not positive, and for a modulus that is negative or not finite
  void validate() const {
    require_positive("share of a fluid point's stiffness", share);
    require_not_negative("shear modulus of a fluid point", shear_modulus);
  }

  /// The provider's state, with the floor's elasticity from its tangent or from `shear_modulus`. A point without stress
  /// and stiffness is fluid from the start, and has the floor at once.
  /// \throws InputError also for a share of nothing where a point is fluid from the start
  State initial_state(Site<dim> const& site) const {
    validate();
    auto own = provider.initial_state(site);
    IsotropicElasticity elasticity{0.0, shear_modulus};
    if (!(shear_modulus > 0.0)) {
      auto const whole = isotropic_part(provider.tangent(own));
      if (!(whole.shear_modulus > 0.0)) {
        reject("point {} has no initial stiffness (it may be fluid): give the floor's shear modulus", site.index);
      }
      elasticity = {share * whole.lame_lambda, share * whole.shear_modulus};
    }
    bool const fluid = provider.stress(own).isZero(0.0) && provider.tangent(own).isZero(0.0);
    return {.own = std::move(own), .elasticity = elasticity, .fluid = fluid};
  }

  State empty_state(Site<dim> const& site) const { return {.own = scarp::empty_state(provider, site)}; }

  VoigtStress<dim> stress(State const& state) const {
    return state.fluid ? VoigtStress<dim>(provider.stress(state.own) + state.floor_stress) : provider.stress(state.own);
  }

  VoigtTangent<dim> tangent(State const& state) const {
    VoigtTangent<dim> const own = provider.tangent(state.own);
    return state.fluid ? VoigtTangent<dim>(own + state.elasticity.template stiffness<dim>()) : own;
  }

  Plan plan(State const& committed, Gradient<dim> const& increment) const requires HasPlan<Provider> {
    return provider.plan(committed.own, increment);
  }
  Plan refined(Plan const& plan) const requires HasPlan<Provider> { return provider.refined(plan); }

  /// \param plan the provider's, or none
  template <class... PlanType>
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        PlanType const&... plan) const {
    trial.elasticity = committed.elasticity;
    trial.floor_stress.setZero();
    Response<dim> response = provider.respond(committed.own, increment, trial.own, plan...);
    trial.fluid = response.verdict.status == Status::fluid;
    if (!trial.fluid) return response;
    LinearElastic<dim> const floor{committed.elasticity};
    typename LinearElastic<dim>::State held{committed.floor_stress};
    Response<dim> const more = floor.respond({committed.floor_stress}, increment, held);
    trial.floor_stress = more.stress;
    response.stress += more.stress;
    if (!more.verdict.acceptable()) response.verdict = more.verdict;
    return response;
  }

 private:
  /// The isotropic stiffness nearest to a tangent in the norm of fourth-order tensors.
  static IsotropicElasticity isotropic_part(VoigtTangent<dim> const& tangent) {
    auto const normal = tangent.template topLeftCorner<dim, dim>();
    constexpr int shears = voigt_size<dim> - dim;
    double const sum = normal.sum();
    double const shear = (normal.trace() - sum / dim + 2.0 * tangent.diagonal().template tail<shears>().sum()) /
                         (2.0 * (dim - 1 + shears));
    return {sum / (dim * dim) - 2.0 * shear / dim, shear};
  }
};

template <class Provider, class... Numbers>
StiffnessFloor(Provider, Numbers...) -> StiffnessFloor<Provider>;

static_assert(ConstitutiveProvider<StiffnessFloor<LinearElastic<2>>>);

}  // namespace scarp
