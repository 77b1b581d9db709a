// SPDX-License-Identifier: BSL-1.0
#include "any_scene.hpp"

#include <utility>

#include "../shared/study/soils.hpp"
#include "scarp/measure/memory.hpp"

namespace fault_rupture {

namespace {

/// Of a scene with so many points, measured with meshes of 1000 to 30 000 triangles and packings of 100 and 400 grains: mesh,
/// matrices and, for packings, two states.
double memory_of(Choice const& choice, std::vector<scarp::Site<2>> const& sites) {
  auto const points = static_cast<double>(sites.size());
  if (choice.soil != Soil::dem) return 4.4e3 * points;
  double prepared = 0.0;
  for (auto const& column : drawn_depths(choice, sites)) prepared += static_cast<double>(column.size());
  if (choice.mirrored_packings) prepared *= 2.0;
  return (7.6e3 + 270.0 * choice.grains) * points + 135.0 * choice.grains * prepared;
}

/// \throws scarp::InputError for a probe that was asked for outside of the ground
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
  auto const check = [&](char name, double x, double y, double usual_x, double usual_y) {
    bool const inside = x >= left && x <= right && y >= 0.0 && y <= depth;
    if (inside || (x == usual_x && y == usual_y)) return;
    scarp::refuse(
        "probe {} at x = {} m, {} m above bedrock, lies outside of the ground (x from {} to {} m, up to {} m): "
        "put it inside",
        name, x, y, left, right, depth);
  };
  Choice const usual;
  check('A', choice.probe_a_x, choice.probe_a_y, usual.probe_a_x, usual.probe_a_y);
  check('B', choice.probe_b_x, choice.probe_b_y, usual.probe_b_x, usual.probe_b_y);
}

template <class SceneType>
SceneType make_any(Choice const& choice, int processes, bool speaks) {
  auto scene = without_soil<SceneType>(choice);
  require_probes_inside(choice, scene);
  auto const sites = scene.soil_sites();
  auto const what = choice.soil == Soil::dem
                        ? fmt::format("ground of {} points with packings of {} grains", sites.size(), choice.grains)
                        : fmt::format("ground of {} points", sites.size());
  double const bytes = memory_of(choice, sites) / processes;
  scarp::require_memory(what, bytes,
                        choice.soil == Soil::dem ? "choose a larger --size, fewer --triangles or fewer --grains"
                                                 : "choose a larger --size or fewer --triangles");
  if (speaks) {
    fmt::print(stderr, "preparing {}, about {} of memory\n", what, scarp::memory_text(bytes));
    constexpr int few = 50;
    if (choice.soil == Soil::dem && choice.grains < few) {
      fmt::print(
          stderr,
          "warning: a packing of {} grains is an accident and no sample of the sand: compare --seed, or take 100 "
          "grains and more\n",
          choice.grains);
    }
    std::fflush(stderr);
  }
  auto soil = any_soil(choice, sites);
  scene.soil.provider = std::move(soil.provider);
  scene.soil.length = choice.length;
  scene.solver = std::move(soil.solver);
  scene.tolerance = soil.tolerance;
  scene.loose_pressure = soil.loose_pressure;
  scene.write_packing = std::move(soil.write_packing);
  scene.stepping.largest_gradient = soil.largest_gradient;
  return scene;
}

}  // namespace

AnyScene make_scene(Choice const& choice, int processes, bool speaks) {
  if (choice.scene == Case::free) return make_any<Scene<scarp::BareGround>>(choice, processes, speaks);
  if (choice.base == Base::sticking) return make_any<Scene<scarp::StickingFooting>>(choice, processes, speaks);
  return make_any<Scene<RigidFooting>>(choice, processes, speaks);
}

}  // namespace fault_rupture
