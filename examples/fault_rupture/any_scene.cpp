// SPDX-License-Identifier: BSL-1.0
#include "any_scene.hpp"

#include <utility>

namespace fault_rupture {

namespace {

template <class SceneType>
SceneType make_any(Choice const& choice) {
  auto scene = without_soil<SceneType>(choice);
  auto soil = any_soil(choice, scene.soil_depths());
  scene.soil = std::move(soil.provider);
  scene.solver = std::move(soil.solver);
  scene.tolerance = soil.tolerance;
  scene.loose_pressure = soil.loose_pressure;
  scene.write_packing = std::move(soil.write_packing);
  scene.stepping.largest_gradient = soil.largest_gradient;
  return scene;
}

}  // namespace

AnyScene make_scene(Choice const& choice) {
  if (choice.scene == Case::free) return make_any<Scene<scarp::BareGround>>(choice);
  if (choice.base == Base::sticking) return make_any<Scene<scarp::StickingFooting>>(choice);
  return make_any<Scene<RigidFooting>>(choice);
}

}  // namespace fault_rupture
