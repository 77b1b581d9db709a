// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/dem/damping.hpp"

namespace scarp {

/// Fast inertial relaxation engine [E. Bitzek et al., Phys. Rev. Lett. 97 (2006) 170201]: while the net forces do work,
/// velocities turn towards the accelerations; once they do not, all grains stop.
/// \f$ P = \sum F \cdot v + T \cdot \omega > 0: v \leftarrow (1-a)\,v + a \frac{|v|}{|F|} \frac{F}{m} \f$, else v = 0;
/// then leap-frog Norms are weighted, \f$ |v|^2 = \sum m v^2 + I \omega^2,\; |F|^2 = \sum F^2/m + T^2/I \f$, so that
/// translation and rotation have one unit and mixing adds no kinetic energy. The time step is constant, since the
/// contacts' springs make it critical.
struct Fire {
  double mixing = 0.1;  ///< a after a stop
  double decay = 0.99;  ///< of a, in every step
  int patience = 5;     ///< steps after a stop in which a does not decay
  // Memory since the last stop. Grains at rest have no power, so that a stepper begins anew with a packing at rest.
  int steps = 0;         ///< since the last stop
  double decayed = 1.0;  ///< a over mixing
  double kept = 1.0;     ///< share of the velocities
  double pushed = 1.0;   ///< effect of the forces over that of leap-frog

  void validate() const {
    require_between("mixing of the relaxation", mixing, 0.0, 1.0);
    require_between("decay of the mixing", decay, 0.0, 1.0);
    require_at_least("patience of the relaxation", patience, 0);
  }

  template <class PackingType, class Forces>
  void before_move(PackingType const& packing, Forces const& forces, double time_step) {
    double power = 0.0, motion = 0.0, pull = smallest_normal<double>();  // P, |v|^2, |F|^2
    auto const add = [&](double velocity, double force, double inverse_inertia) {
      power += force * velocity;
      motion += velocity * velocity / inverse_inertia;
      pull += force * force * inverse_inertia;
    };
    auto const& grains = *packing.population;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      for (int k = 0; k < packing.dim; ++k) add(packing.velocity(i, k), forces.force(i, k), grains.inverse_mass()[i]);
      for (int k = 0; k < spin_size<PackingType::dim>; ++k)
        add(packing.spin(i, k), forces.torque(i, k), grains.inverse_inertia()[i]);
    }
    double const a = mixing * decayed;
    kept = power > 0.0 ? 1.0 - a : 0.0;
    pushed = power > 0.0 ? 1.0 + a * std::sqrt(motion / pull) / time_step : 1.0;
    steps = power > 0.0 ? steps + 1 : 0;
    decayed = steps > patience ? decayed * decay : 1.0;
  }

  /// Velocity or spin after a step: a share of the former one plus the force's effect; mobility = time step / inertia.
  template <class T>
  constexpr T next_velocity(T const& velocity, T const& force, T const& mobility) const {
    return broadcast<T>(kept) * velocity + broadcast<T>(pushed) * force * mobility;
  }
};
static_assert(DampsMotion<Fire>);

}  // namespace scarp
