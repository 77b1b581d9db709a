// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/coulomb.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Linear springs with Coulomb's limit, no tension.
/// \f$ F_n = k_n u_n,\; F_t \leftarrow F_t - k_t\,\Delta s,\; |F_t| \le \mu F_n \f$   (Cundall and Strack 1979)
/// Open contacts have F_n = 0, hence F_t = 0: clamping expresses both opening and sliding without a branch.
/// stiffnesses [N/m], friction coefficient dimensionless
struct LinearFrictional {
  static constexpr ContactInputs inputs{.shear = true};

  double normal_stiffness = 0.0;      ///< k_n [N/m]
  double tangential_stiffness = 0.0;  ///< k_t [N/m]
  double friction = 0.0;              ///< mu, coefficient of Coulomb's limit

  void validate() const {
    require_positive("normal stiffness of the contact law", normal_stiffness);
    require_not_negative("tangential stiffness of the contact law", tangential_stiffness);
    require_not_negative("friction of the contact law", friction);
  }

  template <int Dim, class T>
  constexpr ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach,
                                         ContactMemory<Dim, T>& memory) const {
    T const normal = lanes::at_least(broadcast<T>(normal_stiffness) * approach.overlap, broadcast<T>(0));
    T const lost = coulomb_slide<Dim, T>(memory.shear, approach.slip_increment, broadcast<T>(tangential_stiffness),
                                         broadcast<T>(friction) * normal);
    return {.normal = normal, .shear = memory.shear, .dissipated = lost};
  }

  constexpr ContactStiffness stiffness(double, double) const {
    return {.normal = normal_stiffness, .tangential = tangential_stiffness};
  }

  template <int Dim, class T>
  constexpr T stored_energy(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T> const& memory) const {
    T const closed = lanes::at_least(approach.overlap, broadcast<T>(0));
    T const normal = broadcast<T>(normal_stiffness / 2.0) * closed * closed;
    if (tangential_stiffness == 0.0) return normal;
    return normal + broadcast<T>(0.5 / tangential_stiffness) * dot(memory.shear, memory.shear);
  }
};

static_assert(Frictional<LinearFrictional>);
static_assert(HasStoredEnergy<LinearFrictional>);

template <>
inline constexpr bool is_precompiled<LinearFrictional> = detail::has_library;

}  // namespace scarp
