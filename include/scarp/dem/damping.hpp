// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

#include "scarp/core/pack.hpp"

namespace scarp {

/// next_velocity(velocity, force, mobility): velocity of a grain after a step with a net force, or its spin after one with
/// a net torque, one component; mobility = time step / inertia. Asked for packs of as many grains as a register holds.
template <class Damping>
concept DampsMotion = requires(Damping const& damping, double const& one, lanes::Pack<double> const& several) {
  { damping.next_velocity(one, one, one) } -> std::same_as<double>;
  { damping.next_velocity(several, several, several) } -> std::same_as<lanes::Pack<double>>;
};

namespace detail {
/// What is missing, in words.
template <class Damping>
struct MissingOfDamping {
  static_assert(
      requires(Damping const& damping, double const& one) {
        { damping.next_velocity(one, one, one) } -> std::same_as<double>;
      },
      "scarp: a damping needs `template <class T> T next_velocity(T const& velocity, T const& force, T const& "
      "mobility) const`");
  static_assert(
      !requires(Damping const& damping, double const& one) { damping.next_velocity(one, one, one); } ||
          DampsMotion<Damping>,
      "scarp: a damping is asked for several grains at once: make next_velocity a template over the scalar T");
  static constexpr bool nothing = false;
};
}  // namespace detail

/// The same; of a type that is none the compiler says in words what is missing.
template <class Damping>
concept CheckedDamping = DampsMotion<Damping> || detail::MissingOfDamping<Damping>::nothing;
}  // namespace scarp
