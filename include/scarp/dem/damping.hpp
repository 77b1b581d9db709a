// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <concepts>

#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/dem/critical_step.hpp"
#include "scarp/dem/grain_rows.hpp"
#include "scarp/simd/pack.hpp"

SCARP_NAMED_MEMBER(before_move)

namespace scarp {

/// next_velocity(velocity, force, mobility): velocity of a grain after a step with a net force, or its spin after one
/// with a net torque, one component; mobility = time step / inertia. Evaluated for packs of as many grains as a
/// register holds.
template <class Damping>
concept DampsMotion = requires(Damping const& damping, double const& one, lanes::Pack<double> const& several) {
  { damping.next_velocity(one, one, one) } -> std::same_as<double>;
  { damping.next_velocity(several, several, several) } -> std::same_as<lanes::Pack<double>>;
};

/// Net force [N] and torque [N m] on every grain.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct NetForces {
  using Scalar = typename PackingType::Scalar;  ///< of the packing's coordinates
  /// Places of force and torque in a row.
  using Layout = RowLayout<typename PackingType::Shape, typename PackingType::Law>;

  Scalar const* rows;  ///< first of the rows, one per grain

  /// Component [N] along an axis of space.
  Scalar force(std::size_t grain, int axis) const { return rows[grain * Layout::force_size + detail::index(axis)]; }
  /// Component [N m]; in the plane k is 0.
  Scalar torque(std::size_t grain, int k) const { return force(grain, k + static_cast<int>(Layout::torque)); }
};

/// before_move(packing, forces, time_step [s]): optional, once a step, before `next_velocity` of all grains. A damping
/// learns here the time step, a relaxation what it needs of the whole packing; its state belongs to the stepper, not to
/// the packing.
template <class Damping, class PackingType>
concept SeesAllGrains = requires(Damping& damping, PackingType const& packing, NetForces<PackingType> const& forces) {
  damping.before_move(packing, forces, double{});
};

/// Cundall's local damping: the net force loses the share `factor` where it does work and gains it where it resists.
/// Grains that touch nothing have no net force and would never come to rest, so all fluctuation velocities also decay,
/// \f$ \dot v = -c\,v,\; c = -\ln(1 - drag) / (0.78\,\Delta t_{crit}) \f$: a rate [1/s] of packing and law, whatever
/// the time step.
struct LocalDamping {
  double factor = 0.2;       ///< share of the net force, 0 to 1
  double drag = 1e-3;        ///< share that velocities lose in `default_time_step_share` of the critical step
  double kept = 1.0 - drag;  ///< share that stays in the present time step: set by before_move, not by users

  /// \throws InputError for shares outside of 0 to 1
  void validate() const {
    require_between("factor of the local damping", factor, 0.0, 1.0);
    require_between("drag of the local damping", drag, 0.0, 1.0);
  }

  template <class PackingType, class Forces>
  constexpr void before_move(PackingType const& packing, Forces const&, double time_step) {
    kept = std::pow(1.0 - drag, time_step / (default_time_step_share * packing.pairs.critical_step));
  }

  /// Velocity after a step with a net force, or spin after one with a net torque; mobility = time step / inertia.
  template <class T>
  constexpr T next_velocity(T const& velocity, T const& force, T const& mobility) const {
    using std::abs;
    using std::copysign;
    T const damped = force - broadcast<T>(factor) * copysign(abs(force), velocity);
    return broadcast<T>(kept) * velocity + damped * mobility;
  }
};

static_assert(DampsMotion<LocalDamping>);

template <>
inline constexpr bool is_precompiled<LocalDamping> = detail::has_library;

}  // namespace scarp
