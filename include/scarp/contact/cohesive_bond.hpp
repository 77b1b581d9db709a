// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <cstddef>

#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/core/index.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// A law of constant stiffness whose springs a bond can still use where the law itself would open or slide.
template <class Law>
concept HasLinearSprings = Frictional<Law> && HasStoredEnergy<Law> && requires(Law const& law) {
  { law.normal_stiffness } -> std::convertible_to<double>;
  { law.tangential_stiffness } -> std::convertible_to<double>;
  { law.friction } -> std::convertible_to<double>;
};

/// Bonds between grains: as long as a bond is intact, the springs of the law also pull and do not slide.
/// \f$ F_n = k_n u_n \ge -T,\quad |F_t| \le C + \mu F_n \f$: Coulomb's line with cohesion, which extends into tension
/// up to its cut-off (as the parallel bond of Potyondy and Cundall 2004, without moments). A bond that passes either
/// limit breaks for good and leaves the contact to the law. No contact is bonded unless `bond` was called for it.
/// tensile strength T and shear strength C [N]. What a bond stored beyond the law's share is dissipated when it breaks;
/// for tension it is taken at the end of the breaking step, first order in the step.
template <HasLinearSprings Law>
  requires(Law::inputs.scalars < max_contact_scalars)
struct CohesiveBond {
  static constexpr ContactInputs inputs = [] {
    ContactInputs all = Law::inputs;
    all.shear = true;
    all.scalars = Law::inputs.scalars + 1;
    return all;
  }();

  Law law;                        ///< of the contact without its bond; its springs also serve the bond
  double tensile_strength = 0.0;  ///< T [N], finite
  double shear_strength = 0.0;    ///< C [N], infinite for a bond that shear does not break

  /// A bond that no pull breaks would act across any gap, and no list of near pairs reaches as far; one that no shear
  /// breaks is well.
  /// \throws InputError for strengths that are negative, a tensile strength that is not finite, and what the law
  /// rejects
  void validate() const {
    detail::validated(law);
    require_not_negative("tensile strength of the bonds", tensile_strength);
    require_at_least("shear strength of the bonds", shear_strength, 0.0);
  }

  /// Bonds a contact, free of stress at zero overlap.
  template <int Dim, class T>
  static constexpr void bond(ContactMemory<Dim, T>& memory) {
    memory.scalars[state] = broadcast<T>(intact);
  }

  /// Mask of the contacts whose bond is intact, `bool` for a scalar T.
  template <int Dim, class T>
  static constexpr auto is_intact(ContactMemory<Dim, T> const& memory) {
    return memory.scalars[state] == broadcast<T>(intact);
  }

  /// Mask of the contacts whose bond has broken, `bool` for a scalar T; contacts that never had one are not among them,
  /// nor pairs that have left each other: breakage is the bonds made without those that are intact.
  template <int Dim, class T>
  static constexpr auto is_broken(ContactMemory<Dim, T> const& memory) {
    return memory.scalars[state] == broadcast<T>(broken);
  }

  template <int Dim, class T>
  constexpr ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach,
                                         ContactMemory<Dim, T>& memory) const {
    T const zero = broadcast<T>(0);
    T const normal = broadcast<T>(law.normal_stiffness) * approach.overlap;
    Tangential<Dim, T> const shear = stretched<Dim, T>(memory.shear, approach.slip_increment);
    T const strength = lanes::at_least(broadcast<T>(shear_strength) + broadcast<T>(law.friction) * normal, zero);
    auto const bonded = is_intact(memory);
    auto const holds = bonded && normal >= broadcast<T>(-tensile_strength) && dot(shear, shear) <= strength * strength;

    T const state_after =
        lanes::select(holds, broadcast<T>(intact), lanes::select(bonded, broadcast<T>(broken), memory.scalars[state]));
    T const released = lanes::select(bonded, pull_energy(approach.overlap), zero);
    ContactForce<Dim, T> force = law.respond(approach, memory);
    memory.shear = lanes::select(holds, shear, memory.shear);
    memory.scalars[state] = state_after;
    return {.normal = lanes::select(holds, normal, force.normal),
            .shear = lanes::select(holds, shear, force.shear),
            .dissipated = lanes::select(holds, zero, force.dissipated + released)};
  }

  constexpr ContactStiffness stiffness(double overlap, double reduced_radius) const {
    return law.stiffness(overlap, reduced_radius);
  }

  template <int Dim, class T>
  constexpr T stored_energy(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T> const& memory) const {
    T const pulled = lanes::select(is_intact(memory), pull_energy(approach.overlap), broadcast<T>(0));
    return law.stored_energy(approach, memory) + pulled;
  }

  constexpr double interaction_range() const { return tensile_strength / law.normal_stiffness; }
  constexpr double damping_ratio() const { return damping_ratio_of(law); }

 private:
  static constexpr std::size_t state = detail::index(Law::inputs.scalars);
  static constexpr double intact = 1.0;  // a contact that was never bonded holds zero
  static constexpr double broken = 2.0;

  template <int Dim, class T>
  constexpr Tangential<Dim, T> stretched(Tangential<Dim, T> force, Tangential<Dim, T> const& slip) const {
    T const stiffness = broadcast<T>(law.tangential_stiffness);
    if constexpr (Dim == 2) {
      force = force - stiffness * slip;
    } else {
      for (std::size_t k = 0; k < 3; ++k) force[k] = force[k] - stiffness * slip[k];
    }
    return force;
  }

  template <class T>
  constexpr T pull_energy(T const& overlap) const {
    T const pulled = lanes::at_most(overlap, broadcast<T>(0));
    return broadcast<T>(law.normal_stiffness / 2.0) * pulled * pulled;
  }
};

template <class Law>
CohesiveBond(Law, double, double) -> CohesiveBond<Law>;

static_assert(Frictional<CohesiveBond<LinearFrictional>>);
static_assert(HasStoredEnergy<CohesiveBond<LinearFrictional>>);

}  // namespace scarp
