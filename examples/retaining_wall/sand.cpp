// SPDX-License-Identifier: BSL-1.0
#include "../shared/sand/ground.hpp"
#include "run.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "strength_test.hpp"

namespace retaining_wall {

namespace {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;

/// Ellipses under the overburden of every depth. Where they lose all contacts a small stiffness keeps the
/// nodes in place.
struct Sand : scarp::StiffnessFloor<scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>> {};

Sand sand_of(Choice const& choice, Wall const& wall) {
  Sand sand;
  with_packing(examples::Built<Grains>{}, choice.sand, [](auto, auto const&) {});  // rejects other grains
  sand.provider.law = examples::law_of<Grains::Law>(choice.sand);
  sand.provider.source = examples::level_ground<Grains>(choice.sand, sand.provider.law, choice.sand.seed,
                                                        wall.unit_weight, wall.surcharge, wall.depths());
  sand.provider.pressure_floor = wall.surcharge / 2.0;
  return sand;
}

Friction tested(Choice const& choice, Sand const& sand, Movement movement, scarp::ThreadExecutor& executor) {
  auto const& packings = sand.provider.source.packings;
  std::vector<std::vector<TestRow>> tests(packings.size());
  executor.for_each(static_cast<int>(packings.size()), [&](int k) {
    auto const i = static_cast<std::size_t>(k);
    tests[i] = biaxial_test(packings[i], sand.provider.law, sand.provider.damping, movement, choice.strain,
                            sand.provider.strain_per_step);
  });
  return friction_of(tests, movement);
}

}  // namespace

std::vector<Outcome> run_sand(Choice const& choice) {
  Wall const wall{.size = choice.size};
  scarp::ThreadExecutor executor(choice.threads);
  Sand const sand = sand_of(choice, wall);
  scarp::QuasiNewton<> const solver{.tolerance = 2e-3, .max_iterations = 40};
  scarp::LoadStepping const stepping{
      .first = 5e-4, .smallest = 1e-6, .largest = window / 4.0, .max_displacement_gradient = window};
  std::vector<Outcome> outcomes;
  for (auto const movement : {Movement::active, Movement::passive}) {
    outcomes.push_back(move_wall(wall, sand, movement, tested(choice, sand, movement, executor), solver, stepping,
                                 choice.strain, executor));
  }
  return outcomes;
}

}  // namespace retaining_wall
