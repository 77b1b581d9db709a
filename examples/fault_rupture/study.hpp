// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <vector>

#include "../study_sand.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/scene/free_field_fault.hpp"
#include "scarp/scene/level_ground.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace fault_rupture {

using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>;

/// The study's free-field case: sand of ellipse packings over a normal fault.
struct FreeField : scarp::FreeFieldFault<Sand> {};

/// What a user may choose; defaults are the study's scene on a mesh for a ten-minute run.
struct Choice {
  double size = 2.5;  ///< [m], cell width in the band
  int triangles = 0;  ///< wanted number instead of `size`; 0 for none
  int grains = 400;
  std::uint64_t seed = 1;
  double preparation_friction = 0.09;
  double throw_over_depth = 0.085;
  double dip = 60.0;  ///< [degrees]
  double tip = 0.0;   ///< [m]
  double tolerance = 5e-3;
  double largest_gradient = 0.01;
  int most_iterations = 30;
  double strain_per_step = 1e-5;
  int least_dem_steps = 20;
  double unbalanced_tolerance = 0.05;
  int threads = 0;  ///< 0 for all the machine has
  int frames = 40;
  double probe_a_x = -3.5;  ///< [m], in the band
  double probe_a_y = 6.0;
  double probe_b_x = -20.0;  ///< beside it
  double probe_b_y = 12.0;
  double time_limit = 0.0;  ///< [s], 0 for none
  std::string output = "output/fault_rupture";
};

/// Depths of all material points [m].
inline std::vector<double> depths(scarp::FaultMesh const& layer) {
  scarp::Discretisation<scarp::Tri3> const grid(layer.generate());
  std::vector<double> found;
  for (int point = 0; point < grid.point_count(); ++point) found.push_back(grid.site(point, layer.depth).depth);
  return found;
}

/// \throws scarp::InputError for choices that do not make a scene, scarp::PreparationError
inline FreeField make_scene(Choice const& choice) {
  scarp::FaultMesh layer{.tip = choice.tip, .size = choice.size};
  if (choice.triangles > 0) layer = layer.with_about(choice.triangles);
  FreeField scene;
  auto const law = examples::study_law();
  scarp::LevelGround<scarp::EllipseGrading> ground;
  ground.cloud = examples::study_cloud(choice.grains, choice.seed);
  ground.unit_weight = scene.unit_weight;
  ground.surcharge = scene.surcharge;
  ground.preparation.preparation_friction = choice.preparation_friction;
  auto const packings = ground.make<Grains>(law, depths(layer));

  scene.layer = layer;
  scene.fault = {.dip = choice.dip * std::numbers::pi / 180.0, .tip = choice.tip};
  scene.throw_to = choice.throw_over_depth * layer.depth;
  scene.soil.law = law;
  scene.soil.source = packings;
  scene.soil.strain_per_step = choice.strain_per_step;
  scene.soil.least_steps = choice.least_dem_steps;
  scene.soil.unbalanced_tolerance = choice.unbalanced_tolerance;
  scene.soil.loose_pressure = scene.surcharge / 2.0;
  scene.solver.tolerance = choice.tolerance;
  scene.solver.most_iterations = choice.most_iterations;
  scene.stepping.largest_gradient = choice.largest_gradient;
  return scene;
}

}  // namespace fault_rupture
