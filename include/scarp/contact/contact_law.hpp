// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

namespace scarp {

/// Tangential quantities at a contact: one number along the tangent in 2D, a vector in the tangent plane in 3D.
template <int Dim, class T>
using Tangential = std::conditional_t<Dim == 2, T, std::array<T, 3>>;

/// What a law may look at. `overlap` [m] positive in compression; `slip` [m] is the increment of the second grain's
/// tangential motion relative to the first during the step.
template <int Dim, class T>
struct Approach {
  T overlap;
  Tangential<Dim, T> slip;
};

/// Stiffness [N/m] of a closed contact against a small motion, sliding not regarded.
struct ContactStiffness {
  double normal = 0.0;
  double tangential = 0.0;
};

/// respond(approach, shear): returns the normal force [N] (positive pushes the grains apart, zero when open) and updates
/// `shear`, the tangential force [N] on the second grain.
template <class Law>
concept RespondsToApproach = requires(Law const& law, Approach<2, double> const& approach, double& shear) {
  { law.respond(approach, shear) } -> std::same_as<double>;
};

template <class Law>
concept TellsContactStiffness = requires(Law const& law) {
  { law.stiffness(0.0) } -> std::same_as<ContactStiffness>;  // at an overlap [m]
};

/// `remembers_shear` is false for a law without tangential force: nothing is then stored for it.
template <class Law>
concept ContactLaw = std::is_aggregate_v<Law> && RespondsToApproach<Law> && TellsContactStiffness<Law> && requires {
  { Law::remembers_shear } -> std::convertible_to<bool>;
};

/// A law whose friction coefficient can be exchanged, as the preparation of a packing needs.
template <class Law>
concept Frictional = ContactLaw<Law> && requires(Law law) {
  law.friction = 0.0;
};

}  // namespace scarp
