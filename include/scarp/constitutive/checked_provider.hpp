// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"

namespace scarp {

namespace detail {

/// What of a provider is missing, in words.
template <class Model, bool grounded = HasState<Model>&& HasDimension<Model>>
struct MissingOfProvider {
  static_assert(HasDimension<Model>, "scarp: a provider needs `static constexpr int dim`, 2 or 3");
  static_assert(HasState<Model>, "scarp: a provider needs a type `State` that can be copied");
  static constexpr bool nothing = false;
};
template <class Model>
struct MissingOfProvider<Model, true> {
  static_assert(MakesInitialState<Model>, "scarp: a provider needs `State initial_state(Site<dim> const&) const`");
  static_assert(Responds<Model>,
                "scarp: a provider needs `Response<dim> respond(State const& committed, Gradient<dim> const& "
                "increment, State& trial) const`");
  static_assert(TellsStress<Model>, "scarp: a provider needs `VoigtStress<dim> stress(State const&) const` [Pa]");
  static_assert(GivesTangent<Model>, "scarp: a provider needs `VoigtTangent<dim> tangent(State const&) const` [Pa]");
  static constexpr bool nothing = false;
};

}  // namespace detail

/// A `ConstitutiveProvider`; of one that is none the compiler says in words what is missing.
template <class Model>
concept CheckedProvider = ConstitutiveProvider<Model> || detail::MissingOfProvider<Model>::nothing;

}  // namespace scarp
