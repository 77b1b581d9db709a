// SPDX-License-Identifier: BSL-1.0
#include "fault.hpp"

#include <numbers>

#include "../convergence_table.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/softening_strength.hpp"
#include "scarp/scene/free_field_fault.hpp"
#include "scarp/scene/nonlocal_scene.hpp"
#include "scarp/scene/outcrop.hpp"
#include "scarp/solver/consistent_tangent.hpp"

namespace nonlocal_band {

namespace {

using Local = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>, scarp::SofteningStrength>;
using Newton = scarp::QuasiNewton<scarp::ConsistentTangent>;

/// A length of zero makes it local, bit for bit.
struct Soil : scarp::Nonlocal<Local> {};
struct Scene : scarp::FreeFieldFault<Soil, Newton> {};

constexpr double degree = std::numbers::pi / 180.0;

/// The soil of the example fault_rupture: the study's angles at the peak, 15 % of plastic shear to the residual
/// strength.
Local softening_sand() {
  scarp::Strength const peak{.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree};
  scarp::Strength const residual{.cohesion = 1e3, .friction = (30.8 - 0.8 * 6.6) * degree, .dilation = 0.0};
  return {scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
          {peak, residual, 0.15},
          {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4}};
}

/// Work [N] that the moving bedrock does on the ground per metre of throw; at rest the weight of the ground above it.
template <class Problem>
double reaction(Problem& problem) {
  auto const unbalanced = problem.evaluate_committed().unbalanced;
  auto const& moved = problem.constraints();
  double work = 0.0;
  for (std::size_t k = 0; k < moved.rates().size(); ++k)
    work += moved.rates()[k] * unbalanced(moved.prescribed_dofs()[k]);
  return work;
}

}  // namespace

void print_fault(FaultChoice const& choice) {
  fmt::print("{:>6} {:>9} {:>6} {:>8} {:>10} {:>9} {:>12} {:>6} {:>8} {:>6} {:>7}\n", "size", "triangles", "l", "throw",
             "outcrop", "width", "reaction", "steps", "refused", "iter", "s");
  scarp::SerialExecutor executor;
  for (double const length : choice.lengths) {
    for (double const size : choice.sizes) {
      examples::Stopwatch const watch;
      Scene scene;
      scene.soil.provider = softening_sand();
      scene.soil.length = length;
      scene.soil.stiffness = choice.stiffness;
      scene.soil.fading = choice.fading;
      scene.layer.size = size;
      scene.throw_to = choice.throw_over_depth * scene.layer.depth;
      scene.solver.tolerance = choice.tolerance;
      scene.solver.rule.floor = 1e-4;
      scene.stepping.largest_gradient = 0.02;
      auto problem = scene.problem(executor);
      scarp::NoObserver nobody;
      scene.settle(problem, nobody);
      double const at_rest = reaction(problem);
      auto const run = scene.rupture(problem, nobody);
      auto const& grid = problem.discretisation();
      auto const found = scarp::outcrop(
          scarp::surface_profile(grid.mesh(), grid.positions(), scarp::boundary_nodes(grid.mesh(), "surface")),
          run.load);
      fmt::print("{:6} {:9} {:6} {:8.4f} {:10.2f} {:9.2f} {:12.5g} {:6} {:8} {:6} {:7.1f}  {}\n", size,
                 grid.mesh().elements.size(), length, run.load, found.outcrop_x, found.width,
                 reaction(problem) - at_rest, run.steps, run.refused, run.iterations, watch.seconds(),
                 run.verdict.acceptable() ? "" : name(run.last_failure));
      std::fflush(stdout);
    }
  }
}

}  // namespace nonlocal_band
