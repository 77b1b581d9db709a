// SPDX-License-Identifier: BSL-1.0
// Cost of a user-defined contact law: time per near pair and DEM step, compared with two built-in laws.
#include "scarp/contact/coulomb.hpp"
#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/run/resources.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/simd/select.hpp"

#include "lattice.hpp"

/// As scarp::LinearFrictional, to have something known to compare with.
struct OwnSprings {
  static constexpr scarp::ContactInputs inputs{.shear = true};
  double normal_stiffness = 0.0, tangential_stiffness = 0.0, friction = 0.0;

  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach,
                                      scarp::ContactMemory<Dim, T>& memory) const {
    T const normal = scarp::lanes::at_least(T(normal_stiffness) * approach.overlap, T(0));
    scarp::coulomb_slide<Dim, T>(memory.shear, approach.slip_increment, T(tangential_stiffness), T(friction) * normal);
    return {.normal = normal, .shear = memory.shear};
  }
  scarp::ContactStiffness stiffness(double, double) const {
    return {.normal = normal_stiffness, .tangential = tangential_stiffness};
  }
};

/// Stress along x [Pa] after a shear of 400 grains; prints what a step costs.
template <class Law>
double shear(char const* name, Law const& law) {
  using Grains = scarp::Packing<scarp::Disc, Law>;
  auto packing = tutorials::lattice<Grains>({5e-3}, {0.00999, 0.00999}, 20);
  scarp::TimeStepper<Grains> stepper;
  scarp::Tensor<2> const strain{{0.0, 1e-7}, {1e-7, 0.0}};
  constexpr int steps = 2000;
  scarp::CpuTime const clock;
  for (int step = 0; step < steps; ++step) {
    if (!stepper.step(packing, law, strain).acceptable()) return std::nan("");
  }
  double const pairs = static_cast<double>(packing.pairs.count());
  fmt::print("{:<18} {:6.2f} ns per near pair and step, {} near pairs\n", name, 1e9 * clock.seconds() / steps / pairs,
             pairs);
  scarp::StepObservation<2> seen;
  return stepper.observe(packing, law, seen).acceptable() ? seen.stress(0, 0) : std::nan("");
}

int main() {
  double const k = 6e6, friction = 0.5;
  shear("Frictionless", scarp::Frictionless{.normal_stiffness = k});
  double const built_in =
      shear("LinearFrictional",
            scarp::LinearFrictional{.normal_stiffness = k, .tangential_stiffness = k, .friction = friction});
  double const own =
      shear("own springs", OwnSprings{.normal_stiffness = k, .tangential_stiffness = k, .friction = friction});
  // The same formulas: another compilation may fuse sums otherwise, which costs digits in 2000 steps.
  return tutorials::agree("stress by one's own law [Pa]", own, built_in, 1e-9) ? 0 : 1;
}
