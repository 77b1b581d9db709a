// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"
#include "soils.hpp"

/// The reference study's scenes whose soil has its type, for programs that exchange its parts.
namespace fault_rupture {

template <class SoilType, class Structure>
using TypedScene =
    scarp::FaultScene<SoilType, Structure, typename SoilType::Solver, ChosenGround<Element>, ChosenFault>;

struct SandFreeField : TypedScene<Sand, scarp::NoStructure> {};
struct MohrCoulombFreeField : TypedScene<FrictionalSoil, scarp::NoStructure> {};
struct MohrCoulombFrictionalFooting : TypedScene<FrictionalSoil, RigidFooting> {};
struct ElasticFreeField : TypedScene<ElasticSoil, scarp::NoStructure> {};

/// \throws scarp::InputError for choices that do not make a scene, scarp::PreparationError
template <class SceneType>
SceneType make(Choice const& choice) {
  using SoilType = decltype(SceneType::soil);
  auto scene = without_soil<SceneType>(choice);
  scene.solver.tolerance = choice.tolerance.value_or(SoilType::tolerance(choice));
  scene.solver.max_iterations = choice.max_iterations;
  scene.stepping.max_displacement_gradient =
      choice.max_displacement_gradient.value_or(SoilType::max_displacement_gradient(choice.quick));
  if constexpr (std::is_same_v<SoilType, Sand>) {
    scene.soil = make_sand(choice, scene.soil_sites());
  } else if constexpr (std::is_same_v<SoilType, FrictionalSoil>) {
    scene.soil = make_frictional_soil(choice);
    scene.solver.rule.floor = FrictionalSoil::tangent_floor;
  } else {
    scene.soil = make_elastic_soil(choice);
  }
  return scene;
}

}  // namespace fault_rupture
