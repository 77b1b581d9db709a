// SPDX-License-Identifier: BSL-1.0
// User-defined damping: viscous drag on all grains, in a packing that responds as a material.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/disc.hpp"

#include "lattice.hpp"

/// \f$ \dot v = f/m - c\,v \f$ by the trapezoidal rule; `rate` c [1/s].
struct ViscousDrag {
  double rate = 300.0;
  double half = 0.0;  ///< c times half the time step

  /// Once a step; time step [s].
  template <class PackingType, class Forces>
  void before_move(PackingType const&, Forces const&, double time_step) {
    half = rate * time_step / 2.0;
  }

  /// One component of a velocity [m/s] or spin [1/s]; mobility = time step / inertia. T: a pack of several grains.
  template <class T>
  T next_velocity(T const& velocity, T const& force, T const& mobility) const {
    return (T(1.0 - half) * velocity + force * mobility) * T(1.0 / (1.0 + half));
  }
};
static_assert(scarp::DampsMotion<ViscousDrag>);

int main() {
  using Grains = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
  using Source = scarp::SamePacking<Grains>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.5};
  ViscousDrag const drag{};
  double const radius = 5e-3;

  // Grains that do not touch only feel the drag.
  auto loose = tutorials::lattice<Grains>({radius}, {0.011, 0.011});
  loose.velocity(5, 0) = 1e-3;
  scarp::TimeStepper<Grains, ViscousDrag> stepper;
  stepper.damping = drag;
  bool good = true;
  for (int step = 0; step < 20; ++step) good &= stepper.step(loose, law, scarp::Tensor<2>::Zero()).acceptable();
  double const time = 20.0 * loose.last_move.duration;
  good &= tutorials::agree("velocity of a free grain [m/s]", loose.velocity(5, 0), 1e-3 * std::exp(-drag.rate * time),
                           1e-3);

  // As a material: C11 = k_n of the square lattice, per thickness of 1 m, whatever the damping is.
  double const spacing = 2.0 * radius - 1e-6;
  scarp::DemRve<Grains, Source, scarp::AffineTangent, ViscousDrag> const soil{
      .law = law, .source = {tutorials::lattice<Grains>({radius}, {spacing, spacing})}, .damping = drag};
  good &= tutorials::agree("modulus of a lattice [Pa]", tutorials::modulus(soil), law.normal_stiffness, 1e-3);
  return good ? 0 : 1;
}
