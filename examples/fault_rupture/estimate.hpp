// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>

#include "../shared/study/choice.hpp"
#include "scene_size.hpp"

namespace fault_rupture {

/// What a run takes as a function of its choices, with numbers that benchmarks/scaling_laws has measured on one
/// machine; docs/scaling.md has the equations. Times are CPU times [s].
struct CostModel {
  std::string date, commit, machine;
  double kernel = 0.0;  ///< kernel_seconds() there
  /// [m] The throw of a load step at a displacement gradient of one: the root of (per_node h)^2 + (per_length l)^2,
  /// with the mean distance h of the nodes and the length l.
  double width_per_node = 0.0, width_per_length = 0.0;
  /// Iterations of a step: value + by_decade log10(gradient/tolerance), at least one; without a length and with one.
  double iterations = 0.0, iterations_by_decade = 0.0;
  double iterations_with_length = 0.0, iterations_with_length_by_decade = 0.0;
  /// Strain of a mean point over throw/depth: at_metre width^by_width (1 + by_throw throw/depth), with the width in 25
  /// m of ground.
  double strain_at_metre = 0.0, strain_by_width = 0.0, strain_by_throw = 0.0;
  double dem_step = 0.0, dem_step_by_grains = 0.0;  ///< value grains^power, as the next ones
  double tangent = 0.0;                             ///< of a point, in DEM steps
  double column = 0.0, column_by_grains = 0.0;      ///< of a column of packings that is prepared
  double outside = 0.0, outside_by_points = 0.0;    ///< of an iteration, beside the points
  double pair = 0.0;                                ///< what a pair of points within a length adds to that
  /// Iterations on Mohr-Coulomb soil, and with a length the factor of `outside` there: value (throw/width)^by_throw.
  double plain_iterations = 0.0, plain_iterations_with_length = 0.0, plain_iterations_by_throw = 0.0;
  double plain_outside_with_length = 0.0, plain_outside_by_throw = 0.0;
  double plain_answer = 0.0;  ///< of a point without packings
  double thread_efficiency = 0.0;
  double largest_error = 0.0;  ///< factor between prediction and measurement, largest over runs that were not fitted

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("date", self.date);
    visit("commit", self.commit);
    visit("machine", self.machine);
    visit("kernel", self.kernel);
    visit("width_per_node", self.width_per_node);
    visit("width_per_length", self.width_per_length);
    visit("iterations", self.iterations);
    visit("iterations_by_decade", self.iterations_by_decade);
    visit("iterations_with_length", self.iterations_with_length);
    visit("iterations_with_length_by_decade", self.iterations_with_length_by_decade);
    visit("strain_at_metre", self.strain_at_metre);
    visit("strain_by_width", self.strain_by_width);
    visit("strain_by_throw", self.strain_by_throw);
    visit("dem_step", self.dem_step);
    visit("dem_step_by_grains", self.dem_step_by_grains);
    visit("tangent", self.tangent);
    visit("column", self.column);
    visit("column_by_grains", self.column_by_grains);
    visit("outside", self.outside);
    visit("outside_by_points", self.outside_by_points);
    visit("pair", self.pair);
    visit("plain_iterations", self.plain_iterations);
    visit("plain_iterations_with_length", self.plain_iterations_with_length);
    visit("plain_iterations_by_throw", self.plain_iterations_by_throw);
    visit("plain_outside_with_length", self.plain_outside_with_length);
    visit("plain_outside_by_throw", self.plain_outside_by_throw);
    visit("plain_answer", self.plain_answer);
    visit("thread_efficiency", self.thread_efficiency);
    visit("largest_error", self.largest_error);
  }
};

/// \throws scarp::InputError for a file that does not hold all these
CostModel read_cost_model(std::filesystem::path const& file);
/// The file that comes with the program.
std::filesystem::path default_cost_model();

/// How load steps are made and judged.
struct Control {
  double tolerance = 0.0;                  ///< of the force residual
  double max_displacement_gradient = 0.0;  ///< of a load step
};
Control control_of(Choice const& choice);

/// What a run will take.
struct Cost {
  double steps = 0.0;
  double iterations = 0.0;
  double dem_steps = 0.0;
  double preparation = 0.0;  ///< CPU time [s]
  double points = 0.0;       ///< CPU time [s]
  double outside = 0.0;      ///< CPU time [s] of everything else, on every rank
};

/// speed: time that this machine takes over that of the model's
Cost cost_of(Choice const& choice, SceneSize const& size, Control const& control, CostModel const& model, double speed);

/// CPU time [s] of a DEM step of a small packing, the least of many in 0.15 s.
double kernel_seconds();

/// What a scene will take on this machine, in lines.
std::string estimate(Choice const& choice, SceneSize const& size, int ranks, int threads);

}  // namespace fault_rupture
