// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/checked_provider.hpp"

namespace scarp {

/// Any provider whose points see means of the increments around them, so that a material that softens has a length of
/// its own. Named in a scene, `FaultScene<Nonlocal<Soil>, ...>`, it makes the scene's materials `NonlocalMaterials`
/// (include scene/nonlocal_scene.hpp); its points are those of the provider itself.
template <CheckedProvider ProviderType>
struct Nonlocal {
  using LocalProvider = ProviderType;
  using State = typename LocalProvider::State;
  using Plan = PlanOf<LocalProvider>;
  static constexpr int dim = LocalProvider::dim;

  LocalProvider provider{};
  double length = 0.0;     ///< radius [m] of the neighbourhood; 0: the provider as it is
  double stiffness = 1.0;  ///< against strain that the mean does not see, as a share of the initial tangent
  double fading = 1e-3;    ///< strain after which the stress of that stiffness has faded

  State initial_state(Site<dim> const& site) const { return provider.initial_state(site); }
  VoigtStress<dim> stress(State const& state) const { return provider.stress(state); }
  VoigtTangent<dim> tangent(State const& state) const { return provider.tangent(state); }
  Plan plan(State const& committed, Gradient<dim> const& increment) const requires PlansWork<LocalProvider> {
    return provider.plan(committed, increment);
  }
  Plan refined(Plan const& plan) const requires PlansWork<LocalProvider> { return provider.refined(plan); }
  template <class... PlanType>
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        PlanType const&... plan) const {
    return provider.respond(committed, increment, trial, plan...);
  }
};

/// A provider that asks its field for means over neighbours.
template <class Provider>
concept AsksForMeans = ConstitutiveProvider<Provider> && requires(Provider const& provider) {
  requires ConstitutiveProvider<typename Provider::LocalProvider>;
  { provider.provider } -> std::convertible_to<typename Provider::LocalProvider const&>;
  { provider.length } -> std::convertible_to<double>;
  { provider.stiffness } -> std::convertible_to<double>;
  { provider.fading } -> std::convertible_to<double>;
};

}  // namespace scarp
