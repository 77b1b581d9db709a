// SPDX-License-Identifier: BSL-1.0
#include "pilot.hpp"

#include <algorithm>
#include <vector>

#include "../shared/print.hpp"
#include "any_scene.hpp"
#include "scarp/observe/observers.hpp"
#include "team.hpp"

namespace fault_rupture {

namespace {

/// What the coarse mesh resolves [m], in the reference study's ground.
constexpr double pilot_length = 5.0;

struct NoObserver : scarp::NeverStops {
  void attempted(Problem const&, scarp::StepReport const&) {}
};

/// Runs a scene without writing anything.
/// \return places that it strains most \throws scarp::InputError for a run that ends before the fault moves
std::vector<scarp::Vector<2>> strained_by(Choice const& choice, Scene const& scene) {
  constexpr double share = 0.7;  // of the strain
  scarp::ThreadExecutor threads(threads_of_a_process(choice.threads));
  decltype(auto) executor = make_team(threads);
  auto problem = scene.problem(executor);
  NoObserver no_observer;
  auto report = scene.stages.settle(problem, no_observer);
  if (report.verdict.acceptable()) report = scene.stages.place(problem, no_observer);
  if (report.verdict.acceptable()) report = scene.stages.rupture(problem, no_observer);
  if (!report.verdict.acceptable() && !(report.load > 0.0))
    scarp::reject("the pilot run ended before the fault moved ({}): choose --strip-width 0",
                  name(report.verdict.reason));
  if (!report.verdict.acceptable() && is_root_rank(executor))
    examples::print(stderr, "warning: the pilot run ended at a throw of {:.3g} m ({}): the strip may be too short\n",
                    report.load, name(report.verdict.reason));
  return strained_places(problem, share);
}

}  // namespace

void run_pilot(Choice& choice) {
  Choice pilot = choice;
  pilot.soil = Soil::mohr_coulomb;
  pilot.size = Choice{}.size * choice.scale();
  pilot.strip_width = 0.0;
  pilot.pattern.reset();  // one strip for meshes of all directions
  pilot.aspect = Choice{}.aspect;
  pilot.length = std::max(pilot_length * choice.scale(), 2.0 * choice.mesh_size);
  pilot.tolerance = 1e-3;
  pilot.max_displacement_gradient.reset();
  pilot.largest_time_error.reset();
  // Its rupture comes out where that of the reference study's sand does with a length of 2 m, within 1 m.
  pilot.peak_friction_angle = 35.0;
  pilot.peak_dilation_angle = 9.0;
  pilot.residual_friction_angle.reset();
  pilot.softening_strain = 0.5;
  pilot.young_modulus = Choice{}.young_modulus;
  pilot.k0 = Choice{}.k0;
  pilot.throw_over_depth = std::max(choice.throw_over_depth, Choice{}.throw_over_depth);  // before it, no band
  choice.strained = strained_by(pilot, make_scene(pilot, ranks()));
  if (rank() == 0) examples::print(stderr, "pilot run: refines around {} strained elements\n", choice.strained.size());
}

}  // namespace fault_rupture
