// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "choice.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/mirrored.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/level_ground.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/sphere.hpp"

namespace fault_slab {

/// The reference study's free field as a slab in space, for any soil.
struct Scene : scarp::FreeFieldFault<scarp::Nonlocal<scarp::AnyProvider<3>>, scarp::QuasiNewton<>,
                                     scarp::StructuredGround<scarp::Hex8>, scarp::TaperedSlip<scarp::NormalFault>> {};

using Grains = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;

/// Sheets of points along the strike take packings by depth and their images in turn, each element one sheet of either:
/// what a packing does sideways by accident is undone by its neighbour's, and a slab of one element is mirrored into
/// one of many.
struct SheetsOfImages {
  scarp::PackingsByDepth<Grains> own{};
  scarp::PackingsByDepth<Grains> image{};
  double sheet = 1.0;  ///< half an element along the strike [m]

  Grains const& at(scarp::Site<3> const& site) const {
    bool const odd = std::lround(std::floor(site.position.y() / sheet)) % 2 != 0;
    return (odd ? image : own).at(site);
  }
};

/// Where packings lose all contacts a small stiffness keeps the nodes in place.
struct Sand : scarp::StiffnessFloor<scarp::DemRve<Grains, SheetsOfImages>> {};

/// Spheres of 4 to 6 mm radius, consolidated under the overburden of every depth.
/// \throws scarp::PreparationError
inline Sand make_sand(Choice const& choice, Scene const& scene) {
  scarp::LinearFrictional const law{.normal_stiffness = 1e6, .tangential_stiffness = 5e5, .friction = 0.5};
  scarp::LevelGround<scarp::SphereGrading> ground;
  ground.cloud = {
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = choice.grains, .density = 2650.0, .seed = choice.seed};
  ground.unit_weight = scene.unit_weight;
  ground.surcharge = scene.surcharge;
  auto const own = ground.make<Grains>(law, scene.soil_depths());
  auto image = own;
  for (auto& packing : image.packings) packing = scarp::mirrored(std::move(packing), scarp::Vector<3>::UnitY());
  Sand sand;
  sand.provider.law = law;
  sand.provider.source = {own, image, choice.strike / (2.0 * choice.across)};
  sand.provider.strain_per_step = 2e-5;
  sand.provider.unbalanced_tolerance = 0.1;
  sand.provider.pressure_floor = scene.surcharge / 2.0;
  return sand;
}

/// That of `fault_rupture --soil mohr_coulomb`, in space.
inline scarp::MohrCoulomb<3, scarp::GeostaticStress<3>, scarp::SofteningStrength> make_frictional_soil(
    Scene const& scene) {
  constexpr double degree = std::numbers::pi / 180.0;
  return {.elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
          .strength = {.peak = {.cohesion = 1e3, .friction = 30.8 * degree, .dilation = 6.6 * degree},
                       .residual = {.cohesion = 1e3, .friction = 25.5 * degree, .dilation = 0.0},
                       .softening_strain = 0.15},
          .initial = {scene.surcharge, scene.unit_weight, 0.4}};
}

/// \throws scarp::InputError for choices that do not make a scene, scarp::PreparationError
inline Scene make_scene(Choice const& choice) {
  Scene scene;
  auto& layer = scene.ground.layer;
  layer.strike = choice.strike;
  layer.strike_cells = choice.across;
  layer = layer.with_about<scarp::Hex8>(choice.elements);
  if (choice.length > layer.depth)
    scarp::reject(
        "--length is {} m (the ground is {} m deep, so that a mean over this radius is that of the whole ground): "
        "choose a shorter one, from a tenth of the depth down",
        choice.length, layer.depth);
  bool const uniform = choice.slip == Slip::uniform;
  scene.fault.full_to = uniform ? choice.strike : 0.0;
  scene.fault.ends_at = uniform ? 2.0 * choice.strike : choice.strike;
  scene.throw_to = choice.throw_over_depth * layer.depth;
  scene.stepping.max_displacement_gradient = choice.max_displacement_gradient;
  scene.solver.tolerance = choice.tolerance;
  scene.soil.length = choice.length;
  if (choice.soil == Soil::dem) {
    scene.soil.provider = make_sand(choice, scene);
  } else {
    scene.soil.provider = make_frictional_soil(scene);
  }
  return scene;
}

}  // namespace fault_slab
