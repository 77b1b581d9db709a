// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "chosen_ground.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/fault/frictional_footing.hpp"
#include "scarp/fault/tied_footing.hpp"
#ifdef FAULT_RUPTURE_WATER
#include "scarp/fault/saturated.hpp"
#endif

namespace fault_rupture {

using FrictionalFooting = scarp::FrictionalFooting<scarp::LinearFrictional>;

inline scarp::StripFooting footing_of(Choice const& choice) {
  double const own = choice.scene == Case::heavy ? 91e3 : 37e3;
  return {.centre = choice.footing_centre,
          .width = choice.footing_width,
          .bearing = choice.bearing_pressure > 0.0 ? choice.bearing_pressure : own};
}

/// Applies the choice's options to a structure.
inline void set(scarp::NoStructure&, Choice const&) {}
inline void set(scarp::TiedFooting& structure, Choice const& choice) { structure.footing = footing_of(choice); }
inline void set(FrictionalFooting& structure, Choice const& choice) {
  structure.footing = footing_of(choice);
  // Overlap of a millimetre under the heavy footing: small against any settlement, and soft enough for the solver.
  structure.interface = {.normal_stiffness = 1e8, .tangential_stiffness = 1e8, .friction = choice.base_friction};
}

#ifdef FAULT_RUPTURE_WATER
/// Its times follow when ground and fault are known.
template <class Structure>
void set(scarp::Saturated<Structure>& structure, Choice const& choice) {
  set(static_cast<Structure&>(structure), choice);
  structure.void_ratio = choice.void_ratio;
  structure.water_table = *choice.water_table;
  structure.largest_time_error = choice.largest_time_error;
  structure.flow = scarp::KozenyCarman::of_conductivity(choice.conductivity, choice.void_ratio);
}
#endif

/// Ground, fault, loads and structure; soil and solver are left.
/// \throws scarp::InputError for choices that do not make a scene
template <class SceneType>
SceneType without_soil(Choice const& choice) {
  SceneType scene;
  scene.ground = ground_of<Element>(choice);
  scene.fault = fault_of(choice);
  scene.unit_weight = choice.unit_weight;
  scene.surcharge = choice.surcharge;
  scene.throw_to = choice.throw_over_depth * scene.ground.depth();
  set(scene.structure, choice);
  if constexpr (requires { scene.structure.times; }) {
    scene.structure.times = {.rupture = scene.throw_to / std::sin(scene.fault.dip) / choice.slip_rate,
                             .drainage = choice.drain};
  }
  return scene;
}

}  // namespace fault_rupture
