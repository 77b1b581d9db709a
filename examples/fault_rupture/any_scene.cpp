// SPDX-License-Identifier: BSL-1.0
#include "any_scene.hpp"
#include "../shared/print.hpp"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "device/chosen_device.hpp"
#include "scarp/run/resources.hpp"

namespace fault_rupture {

namespace {

#ifdef FAULT_RUPTURE_WATER
template <class Structure>
using OnGround = scarp::Saturated<Structure>;
#else
template <class Structure>
using OnGround = Structure;
#endif

/// Compiled once for all soils.
template <class Structure>
using SceneOn = scarp::FaultScene<scarp::Nonlocal<scarp::AnyProvider<2>>, OnGround<Structure>, scarp::QuasiNewton<>,
                                  ChosenGround<Element>, ChosenFault>;

/// \throws scarp::InputError for a probe that was requested outside of the ground
template <class SceneType>
void require_probes_inside(Choice const& choice, SceneType const& scene) {
  auto const mesh = scene.ground.mesh({});
  double left = mesh.nodes.front().x();
  double right = left;
  for (auto const& node : mesh.nodes) {
    left = std::min(left, node.x());
    right = std::max(right, node.x());
  }
  double const depth = scene.ground.depth();
  auto const check = [&](char name, double x, double y) {
    if (x >= left && x <= right && y >= 0.0 && y <= depth) return;
    scarp::reject(
        "probe {} at x = {} m, {} m above bedrock, lies outside of the ground (x from {} to {} m, up to {} m): "
        "put it inside",
        name, x, y, left, right, depth);
  };
  check('A', choice.probe_a_x, choice.probe_a_y);
  check('B', choice.probe_b_x, choice.probe_b_y);
}

/// scene: its soil may be missing
template <class SceneType>
SceneSize size_of(Choice const& choice, SceneType const& scene, std::vector<scarp::Site<2>> const& sites) {
  auto const mesh = scene.mesh();
  auto const [left, right] = std::ranges::minmax_element(mesh.nodes, {}, [](auto const& node) { return node.x(); });
  auto size = size_of_soil(choice, sites);
  size.elements = static_cast<double>(mesh.elements.size());
  size.nodes = static_cast<double>(mesh.nodes.size());
  size.width = right->x() - left->x();
  size.depth = scene.ground.depth();
  double const fine = scene.ground.strip ? scene.ground.strip->fine : choice.mesh_size;
  size.min_area = fine * fine / (is_triangle ? 4 : 1);
  return size;
}

/// What runs use of a scene.
template <class SceneType>
Scene used_of(SceneType scene, AnySoil const& soil) {
  auto const whole = std::make_shared<SceneType const>(std::move(scene));
  Scene used{.ground = whole->ground,
             .fault = whole->fault,
             .stages = whole->stages(),
             .tolerance = soil.tolerance,
             .pressure_floor = soil.pressure_floor,
             .write_packing = soil.write_packing,
             .problem = [whole](scarp::Executor& executor) { return whole->problem(executor); },
             .overburden = [whole](double depth) { return whole->overburden(depth); }};
  if constexpr (requires { whole->structure.times; }) used.rupture_time = whole->structure.times.rupture;
  if constexpr (requires { whole->structure.footing; }) {
    used.footing = Footing{whole->structure.footing, [whole](Problem const& problem, double load) {
                             return whole->structure.motion(problem, load);
                           }};
  }
  return used;
}

template <class SceneType>
Scene make_any(Choice const& choice, int processes, bool speaks) {
  auto scene = without_soil<SceneType>(choice);
  require_probes_inside(choice, scene);
  auto const sites = scene.soil_sites();
  auto const to_device = choice.device == Device::none ? ToDevice{} : chosen_device(choice, sites.size());
  auto const what = choice.soil == Soil::dem
                        ? fmt::format("ground of {} points with packings of {} grains", sites.size(), choice.grains)
                        : fmt::format("ground of {} points", sites.size());
  double const bytes = memory_of(choice, size_of_soil(choice, sites), processes);
  scarp::require_memory(what, bytes,
                        choice.soil == Soil::dem ? "choose a larger --size, fewer --elements or fewer --grains"
                                                 : "choose a larger --size or fewer --elements");
  if (speaks) {
    examples::print(stderr, "preparing {}, about {} of memory\n", what, scarp::memory_text(bytes));
    constexpr int few = 50;
    if (choice.soil == Soil::dem && choice.grains < few) {
      examples::print(
          stderr,
          "warning: a packing of {} grains is an accident and no sample of the sand: compare --seed, or take 100 "
          "grains and more\n",
          choice.grains);
    }
    std::fflush(stderr);
  }
  auto soil = any_soil(choice, sites, to_device);
  scene.soil.provider = std::move(soil.provider);
  scene.soil.length = choice.length;
  scene.solver = std::move(soil.solver);
  scene.stepping.max_displacement_gradient = soil.max_displacement_gradient;
  if constexpr (requires { scene.structure.shear_modulus; }) scene.structure.shear_modulus = soil.shear_modulus;
  return used_of(std::move(scene), soil);
}

template <class SceneType>
SceneSize size_of_any(Choice const& choice) {
  auto const scene = without_soil<SceneType>(choice);
  require_probes_inside(choice, scene);
  return size_of(choice, scene, scene.soil_sites());
}

/// make: takes the type of the chosen scene
template <class Make>
auto with_scene(Choice const& choice, Make const& make) {
#ifndef FAULT_RUPTURE_WATER
  if (choice.water_table)
    scarp::reject(
        "--water-table is given to a program without water: start it by ./examples/run, which builds one with water");
#else
  if (!choice.water_table)
    scarp::reject("--water-table is not given to a program with water: give it, or start fault_rupture");
#endif
  if (choice.scene != Case::free && choice.base != Base::tied)
    return make(std::type_identity<SceneOn<FrictionalFooting>>());
  if (choice.scene == Case::free) return make(std::type_identity<SceneOn<scarp::NoStructure>>());
  return make(std::type_identity<SceneOn<scarp::TiedFooting>>());
}

}  // namespace

SceneSize size_of_scene(Choice const& choice) {
  return with_scene(choice, [&](auto scene) { return size_of_any<typename decltype(scene)::type>(choice); });
}

Scene make_scene(Choice const& choice, int processes, bool speaks) {
  return with_scene(choice,
                    [&](auto scene) { return make_any<typename decltype(scene)::type>(choice, processes, speaks); });
}

}  // namespace fault_rupture
