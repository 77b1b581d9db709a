// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "run.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace retaining_wall {

/// The reference study's angles, 30.8 and 6.6 degrees, without cohesion. Every mesh can hold Rankine's state exactly;
/// what is allowed is a hundred times the solver's tolerance.
std::vector<Outcome> run_mohr_coulomb(Choice const& choice) {
  constexpr double degree = std::numbers::pi / 180.0;
  constexpr double tolerance = 1e-8;
  Wall const wall{.size = choice.size};
  Friction const friction{.angle = 30.8 * degree, .allowance = 100.0 * tolerance, .source = "given"};
  scarp::MohrCoulomb<2, scarp::GeostaticStress<2>> const soil{
      .elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
      .strength = {{.friction = friction.angle, .dilation = 6.6 * degree}},
      .initial = {wall.surcharge, wall.unit_weight, 1.0 - std::sin(friction.angle)}};
  scarp::QuasiNewton<> const newton{.tolerance = tolerance, .rule = {.exact = {.floor = 1e-6}}};
  scarp::LoadStepping const stepping{.first = 2e-4, .largest = 1e-3};
  scarp::SerialExecutor executor;
  std::vector<Outcome> outcomes;
  for (auto const movement : {Movement::active, Movement::passive})
    outcomes.push_back(move_wall(wall, soil, movement, friction, newton, stepping, choice.strain, executor));
  return outcomes;
}

}  // namespace retaining_wall
