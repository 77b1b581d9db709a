// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/coulomb.hpp"
#include "scarp/contact/linear_frictional.hpp"

namespace scarp {

/// Any law with a moment that resists rolling: a spring with a slider.
/// \f$ M \leftarrow M - k_r\,\Delta\theta,\; |M| \le \mu_r R^* |F_n| \f$   (Iwashita and Oda 1998; model C of Ai et al.
/// 2011, Powder Technology 206, without its dashpot). Under a pull, as in a bond, |F_n| still counts.
/// rolling stiffness [N m/rad]; rolling friction dimensionless
template <ContactLaw Law>
  requires(!Law::inputs.moment && Law::inputs.species == 0)
struct RollingResistance {
  static constexpr ContactInputs inputs = [] {
    ContactInputs all = Law::inputs;
    all.moment = true;
    all.radius = true;
    return all;
  }();

  Law law;                         ///< of the forces
  double rolling_stiffness = 0.0;  ///< k_r [N m/rad]
  double rolling_friction = 0.0;   ///< mu_r, limit of the moment over R* and |F_n|

  void validate() const {
    detail::validated(law);
    require_not_negative("rolling stiffness of the contact law", rolling_stiffness);
    require_not_negative("rolling friction of the contact law", rolling_friction);
  }

  /// Bonds a contact under the law of the forces.
  template <int Dim, class T>
  static constexpr void bond(ContactMemory<Dim, T>& memory) requires Bonds<Law> {
    Law::bond(memory);
  }

  template <int Dim, class T>
  constexpr ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach,
                                         ContactMemory<Dim, T>& memory) const {
    using std::abs;
    ContactForce<Dim, T> force = law.respond(approach, memory);
    T const limit = broadcast<T>(rolling_friction) * approach.reduced_radius * abs(force.normal);
    T const lost =
        coulomb_slide<Dim, T>(memory.moment, approach.rotation_increment, broadcast<T>(rolling_stiffness), limit);
    force.moment = memory.moment;
    force.dissipated = force.dissipated + lost;
    return force;
  }

  constexpr ContactStiffness stiffness(double overlap, double reduced_radius) const {
    ContactStiffness all = law.stiffness(overlap, reduced_radius);
    all.rolling = rolling_stiffness;
    return all;
  }

  template <int Dim, class T>
    requires HasStoredEnergy<Law>
  constexpr T stored_energy(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T> const& memory) const {
    T const base = law.stored_energy(approach, memory);
    if (rolling_stiffness == 0.0) return base;
    return base + broadcast<T>(0.5 / rolling_stiffness) * dot(memory.moment, memory.moment);
  }

  constexpr double interaction_range() const { return interaction_range_of(law); }
  constexpr double damping_ratio() const { return damping_ratio_of(law); }
};

template <class Law>
RollingResistance(Law, double, double) -> RollingResistance<Law>;

static_assert(Frictional<RollingResistance<LinearFrictional>>);
static_assert(HasStoredEnergy<RollingResistance<LinearFrictional>>);

}  // namespace scarp
