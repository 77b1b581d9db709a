// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <variant>

#include "chosen_ground.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/sticking_footing.hpp"
#include "soils.hpp"

namespace fault_rupture {

template <class SoilType, class Structure>
using Scene = scarp::FaultScene<SoilType, Structure, typename SoilType::Solver, ChosenGround<Element>, ChosenFault>;
using RigidFooting = scarp::FrictionalFooting<scarp::LinearFrictional>;

struct SandFreeField : Scene<Sand, scarp::BareGround> {};
struct SandStickingFooting : Scene<Sand, scarp::StickingFooting> {};
struct SandFrictionalFooting : Scene<Sand, RigidFooting> {};
struct MohrCoulombFreeField : Scene<FrictionalSoil, scarp::BareGround> {};
struct MohrCoulombStickingFooting : Scene<FrictionalSoil, scarp::StickingFooting> {};
struct MohrCoulombFrictionalFooting : Scene<FrictionalSoil, RigidFooting> {};
struct ElasticFreeField : Scene<ElasticSoil, scarp::BareGround> {};
struct ElasticStickingFooting : Scene<ElasticSoil, scarp::StickingFooting> {};
struct ElasticFrictionalFooting : Scene<ElasticSoil, RigidFooting> {};

using AnyScene = std::variant<SandFreeField, SandStickingFooting, SandFrictionalFooting, MohrCoulombFreeField,
                              MohrCoulombStickingFooting, MohrCoulombFrictionalFooting, ElasticFreeField,
                              ElasticStickingFooting, ElasticFrictionalFooting>;

inline scarp::StripFooting footing_of(Choice const& choice) {
  double const own = choice.scene == Case::heavy ? 91e3 : 37e3;
  return {.centre = choice.footing_centre,
          .width = choice.footing_width,
          .bearing = choice.bearing_pressure > 0.0 ? choice.bearing_pressure : own};
}

/// What the choice says of a structure.
inline void set(scarp::BareGround&, Choice const&) {}
inline void set(scarp::StickingFooting& structure, Choice const& choice) { structure.footing = footing_of(choice); }
inline void set(RigidFooting& structure, Choice const& choice) {
  structure.footing = footing_of(choice);
  // Overlap of a millimetre under the heavy footing: small against any settlement, and soft enough for the solver.
  structure.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = choice.base_friction};
}

/// \throws scarp::InputError for choices that do not make a scene, scarp::PreparationError
template <class SceneType>
SceneType make(Choice const& choice) {
  using SoilType = decltype(SceneType::soil);
  SceneType scene;
  scene.ground = ground_of<Element>(choice);
  scene.fault = {{.dip = choice.dip * std::numbers::pi / 180.0, .tip = choice.tip}, choice.reverse};
  scene.unit_weight = unit_weight;
  scene.surcharge = surcharge;
  scene.throw_to = choice.throw_over_depth * scene.ground.depth();
  scene.solver.tolerance = choice.tolerance.value_or(SoilType::tolerance(choice));
  scene.solver.most_iterations = choice.most_iterations;
  scene.stepping.largest_gradient = choice.largest_gradient.value_or(SoilType::largest_gradient(choice.quick));
  set(scene.structure, choice);
  if constexpr (std::is_same_v<SoilType, Sand>) {
    scene.soil = make_sand(choice, scene.soil_depths());
  } else if constexpr (std::is_same_v<SoilType, FrictionalSoil>) {
    scene.soil = make_frictional_soil();
    scene.solver.rule.floor = 1e-4;
  } else {
    scene.soil = make_elastic_soil();
  }
  return scene;
}

template <class FreeField, class Sticking, class Frictional>
AnyScene make_with(Choice const& choice) {
  if (choice.scene == Case::free) return make<FreeField>(choice);
  if (choice.base == Base::sticking) return make<Sticking>(choice);
  return make<Frictional>(choice);
}

inline AnyScene make_scene(Choice const& choice) {
  switch (choice.soil) {
    case Soil::dem: return make_with<SandFreeField, SandStickingFooting, SandFrictionalFooting>(choice);
    case Soil::mohr_coulomb:
      return make_with<MohrCoulombFreeField, MohrCoulombStickingFooting, MohrCoulombFrictionalFooting>(choice);
    case Soil::elastic: break;
  }
  return make_with<ElasticFreeField, ElasticStickingFooting, ElasticFrictionalFooting>(choice);
}

}  // namespace fault_rupture
