// SPDX-License-Identifier: BSL-1.0
// User-defined relaxation, which evaluates all grains before they move: projected velocities.
// It prepares a packing and moves one that responds as a material.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/disc.hpp"

#include "lattice.hpp"

using Grains = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;

/// Projected velocities (quick-min; Sheppard et al., 2008): while the net forces do work, only the part of all
/// velocities along the accelerations stays, else none. \f$ v = \frac{P}{\sum F^2/m} \frac{F}{m}, P = \sum F \cdot v >
/// 0 \f$, rotations alike; then leap-frog.
struct ProjectedVelocities {
  double push = 1.0;  ///< velocity after the step over force times mobility, the same for all grains

  /// Once a step: velocities [m/s], forces [N], spins [1/s], torques [N m]; time step [s].
  template <class PackingType, class Forces>
  void before_move(PackingType const& packing, Forces const& forces, double time_step) {
    auto const& grains = *packing.population;
    double power = 0.0, pull = 0.0;
    auto const add = [&](double velocity, double force, double inverse_inertia) {
      power += force * velocity;
      pull += force * force * inverse_inertia;
    };
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      for (int a = 0; a < PackingType::dim; ++a)
        add(packing.velocity(i, a), forces.force(i, a), grains.inverse_mass()[i]);
      for (int k = 0; k < scarp::spin_size<PackingType::dim>; ++k)
        add(packing.spin(i, k), forces.torque(i, k), grains.inverse_inertia()[i]);
    }
    push = power > 0.0 ? 1.0 + power / (pull * time_step) : 1.0;
  }

  /// Then for every component of velocity or spin; mobility = time step / inertia. T: a pack of several grains.
  template <class T>
  T next_velocity(T const&, T const& force, T const& mobility) const {
    return T(push) * force * mobility;
  }
};
static_assert(scarp::DampsMotion<ProjectedVelocities> && scarp::SeesAllGrains<ProjectedVelocities, Grains>);

int main() {
  using Source = scarp::SamePacking<Grains>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.5};

  // A cloud that is compressed comes to rest under the pressure that is requested, to the servo's tolerance.
  scarp::Cloud<scarp::DiscGrading> const cloud{
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 100, .density = 2650.0, .thickness = 1.0};
  scarp::IsotropicPreparation const preparation{.pressure = 1e5};
  auto const made = preparation.prepare(cloud.make<Grains>(), law, ProjectedVelocities{});
  auto const balance = scarp::balance(made.packing, law);
  fmt::print("void ratio {:.4f}, unbalanced ratio {:.1e}\n", made.packing.void_ratio(), balance.unbalanced_ratio);
  bool good = made.verdict.acceptable();
  good &= tutorials::agree("mean stress of a packing [Pa]", balance.stress.trace() / 2.0, -preparation.pressure, 2e-4);

  // As a material: C11 = k_n of the square lattice, per thickness of 1 m, whatever moves the grains.
  double const radius = 5e-3, spacing = 2.0 * radius - 1e-6;
  scarp::DemRve<Grains, Source, scarp::AffineTangent, ProjectedVelocities> const soil{
      .law = law, .source = {tutorials::lattice<Grains>({radius}, {spacing, spacing})}};
  good &= tutorials::agree("modulus of a lattice [Pa]", tutorials::modulus(soil), law.normal_stiffness, 1e-3);
  return good ? 0 : 1;
}
