// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Linear repulsion without tangential force: \f$ F_n = k_n u_n \f$ for u_n > 0. `normal_stiffness` [N/m].
struct Frictionless {
  static constexpr ContactInputs inputs{};

  double normal_stiffness = 0.0;  ///< k_n [N/m]

  /// \throws InputError, as all laws' own checks
  void validate() const { require_positive("normal stiffness of the contact law", normal_stiffness); }

  template <int Dim, class T>
  constexpr ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T>&) const {
    return {.normal = lanes::at_least(broadcast<T>(normal_stiffness) * approach.overlap, broadcast<T>(0))};
  }

  constexpr ContactStiffness stiffness(double, double) const { return {.normal = normal_stiffness}; }

  template <int Dim, class T>
  constexpr T stored_energy(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T> const&) const {
    T const closed = lanes::at_least(approach.overlap, broadcast<T>(0));
    return broadcast<T>(normal_stiffness / 2.0) * closed * closed;
  }
};

static_assert(ContactLaw<Frictionless>);
static_assert(HasStoredEnergy<Frictionless>);

template <>
inline constexpr bool is_precompiled<Frictionless> = detail::has_library;

}  // namespace scarp
