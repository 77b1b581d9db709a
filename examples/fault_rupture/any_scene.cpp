// SPDX-License-Identifier: BSL-1.0
#include "any_scene.hpp"
#include "../shared/print.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "device/chosen_device.hpp"
#include "scarp/run/resources.hpp"

namespace fault_rupture {

namespace {

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

template <class SceneType>
SceneType make_any(Choice const& choice, int processes, bool speaks) {
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
  scene.tolerance = soil.tolerance;
  scene.pressure_floor = soil.pressure_floor;
  scene.write_packing = std::move(soil.write_packing);
  scene.stepping.max_displacement_gradient = soil.max_displacement_gradient;
  if constexpr (requires { scene.structure.shear_modulus; }) scene.structure.shear_modulus = soil.shear_modulus;
  return scene;
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
  if (choice.scene != Case::free && choice.base != Base::tied) return make(std::type_identity<Scene<SlidingFooting>>());
  if (choice.scene == Case::free) return make(std::type_identity<Scene<FreeField>>());
  return make(std::type_identity<Scene<TiedFooting>>());
}

}  // namespace

SceneSize size_of_scene(Choice const& choice) {
  return with_scene(choice, [&](auto scene) { return size_of_any<typename decltype(scene)::type>(choice); });
}

AnyScene make_scene(Choice const& choice, int processes, bool speaks) {
  return with_scene(choice, [&](auto scene) {
    return AnyScene(make_any<typename decltype(scene)::type>(choice, processes, speaks));
  });
}

}  // namespace fault_rupture
