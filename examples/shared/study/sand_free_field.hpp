// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"
#include "soils.hpp"

/// The reference study's free field with the type of its sand, for programs that exchange its parts.
namespace fault_rupture {

struct SandFreeField
    : scarp::FaultScene<Sand, scarp::NoStructure, scarp::QuasiNewton<>, ChosenGround<Element>, ChosenFault> {};

/// \throws scarp::InputError for choices that do not make a scene, scarp::PreparationError
inline SandFreeField make_sand_free_field(Choice const& choice) {
  auto scene = without_soil<SandFreeField>(choice);
  scene.solver.tolerance = choice.tolerance.value_or(Sand::tolerance(choice));
  scene.solver.max_iterations = choice.max_iterations;
  scene.stepping.max_displacement_gradient =
      choice.max_displacement_gradient.value_or(Sand::max_displacement_gradient(choice.quick));
  scene.soil = make_sand(choice, scene.soil_sites());
  return scene;
}

}  // namespace fault_rupture
