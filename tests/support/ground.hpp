// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/shape/ellipse.hpp"

/// The free-field scene at a size that runs in a blink.
namespace samples {

using ElasticSoil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Sand = scarp::DemRve<Grains, scarp::PackingsByDepth<Grains>>;

inline constexpr double k0 = 0.4;

inline scarp::FreeFieldFault<ElasticSoil> elastic_ground() {
  scarp::FreeFieldFault<ElasticSoil> scene;
  scene.soil = ElasticSoil::from_young_poisson(20e6, 0.3, {scene.surcharge, scene.unit_weight, k0});
  scene.ground.layer.size = 5.0;
  return scene;
}

/// Packings of 36 ellipses in elements of up to 24 m, a throw of a five-hundredth of the depth; prepared once per
/// program.
inline scarp::FreeFieldFault<Sand> const& sandy_ground() {
  static scarp::FreeFieldFault<Sand> const made = [] {
    scarp::FreeFieldFault<Sand> scene;
    scene.ground.layer.size = 12.0;
    scene.throw_to = 0.002 * scene.ground.layer.depth;
    scarp::Discretisation<scarp::Tri3> const grid(scene.ground.layer.generate());
    std::vector<double> depths;
    for (int point = 0; point < grid.point_count(); ++point)
      depths.push_back(grid.site(point, scene.ground.layer.depth).depth);
    scarp::LevelGround<scarp::EllipseGrading> ground;
    ground.cloud = {.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                    .grains = 36,
                    .density = 2650.0,
                    .thickness = 0.2,
                    .seed = 1};
    scene.soil.law = {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
    scene.soil.source = ground.make<Grains>(scene.soil.law, depths);
    scene.soil.pressure_floor = scene.surcharge / 4.0;
    scene.solver.tolerance = 2e-3;  // so that most steps iterate
    return scene;
  }();
  return made;
}

}  // namespace samples
