// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// A state that a saved one can be read into, with all that is not saved because it follows from the provider and the site. Providers
/// whose states keep such things tell by `State blank_state(Site<dim> const&) const`, and so do adaptors, for what they hold.
/// \throws InputError for states that cannot be made so
template <ConstitutiveProvider Provider>
typename Provider::State blank_state(Provider const& provider, Site<Provider::dim> const& site) {
  if constexpr (requires { provider.blank_state(site); }) {
    return provider.blank_state(site);
  } else if constexpr (std::default_initializable<typename Provider::State>) {
    static_cast<void>(provider), static_cast<void>(site);
    return {};
  } else {
    static_cast<void>(provider), static_cast<void>(site);
    refuse(
        "a state cannot be sent to another process (it has no default constructor, and its provider makes no blank "
        "one): give it one");
  }
}

}  // namespace scarp
