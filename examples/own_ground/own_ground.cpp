// SPDX-License-Identifier: BSL-1.0
// Where does a reverse fault come out in ground of one's own: a mesh from Gmsh, quadratic elements, an own soil law?
#include <filesystem>

#include "../shared/print.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/mesh_file_ground.hpp"
#include "scarp/fault/rupture_survey.hpp"
#include "scarp/solver/thread_executor.hpp"

/// Soil whose stiffness grows with the mean pressure, E = E_r (p/p_r)^n (Janbu 1963), elastic within each load step.
struct PressureStiffened {
  static constexpr int dim = 2;
  using Elastic = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  using State = Elastic::State;

  double young = 30e6, pressure = 100e3, exponent = 0.5, poisson = 0.3;  // E_r [Pa], p_r [Pa], n
  scarp::GeostaticStress<2> initial{.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.5};

  Elastic elastic(State const& state) const {
    double const now = std::max(-(state.stress(0) + state.stress(1)) / 2.0, 1e3);
    return Elastic::from_young_poisson(young * std::pow(now / pressure, exponent), poisson, initial);
  }
  State initial_state(scarp::Site<2> const& site) const { return {initial.at(site.depth)}; }
  scarp::VoigtStress<2> stress(State const& state) const { return state.stress; }
  scarp::VoigtTangent<2> tangent(State const& state) const { return elastic(state).tangent(state); }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    return elastic(committed).respond(committed, increment, trial);
  }
};

using Newton = scarp::QuasiNewton<>;
using Ground = scarp::MeshFileGround<scarp::Quad8>;

int main(int count, char** arguments) try {
  auto const file = count > 1 ? std::filesystem::path(arguments[1])
                              : std::filesystem::path(__FILE__).replace_filename("own_ground.msh");
  scarp::FreeFieldFault<PressureStiffened, Newton, Ground, scarp::ReverseFault> scene;
  std::vector<std::string> notes;
  scene.ground = scarp::ground_from_file<scarp::Quad8>(file, &notes);
  examples::print_notes(notes);
  scene.fault.dip = 0.8;  // [rad]
  scene.throw_to = 0.5;   // [m]
  scene.solver.tolerance = 1e-8;

  scarp::ThreadExecutor executor;
  scarp::NoObserver no_observer;
  auto problem = scene.problem(executor);
  auto report = scene.settle(problem, no_observer);
  auto const rest = ground_at_rest(problem);
  if (report.verdict.acceptable()) report = scene.rupture(problem, no_observer);

  auto const& grid = problem.discretisation();
  auto const survey =
      rupture_survey(grid.mesh(), rest.positions, grid.positions(), offset_at(scene.fault, report.load));
  auto const& surface = survey.surface;
  examples::print(stdout, "{}: throw {:.3f} m up, half of it at x = {:.2f} m, 5 and 95 % at {:.2f} and {:.2f} m\n",
                  name(report.verdict.status), report.load, surface.surface_x50, surface.surface_x05,
                  surface.surface_x95);
  // Elastic ground spreads the step widely around the tip's own place; a rupture would follow the fault to the left.
  return report.verdict.acceptable() && surface.surface_x05 < surface.surface_x50 &&
                 surface.surface_x50 < surface.surface_x95
             ? 0
             : 1;
} catch (std::exception const& problem) {
  examples::print(stderr, "own_ground: {}\n", problem.what());
  return 2;
}
