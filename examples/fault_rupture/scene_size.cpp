// SPDX-License-Identifier: BSL-1.0
#include "scene_size.hpp"

#include <algorithm>

#include "../shared/study/soils.hpp"

namespace fault_rupture {

namespace {

/// Pairs of points within a length, from the neighbours of some of them; 0 where it reaches none.
double pairs_within(double length, std::vector<scarp::Site<2>> const& sites) {
  constexpr std::size_t looked_at = 200;
  double around = 0.0;
  double wanted = 0.0;
  for (std::size_t i = 0; i < sites.size(); i += sites.size() / looked_at + 1) {
    wanted += 1.0;
    around += static_cast<double>(std::ranges::count_if(
        sites, [&](auto const& site) { return (site.position - sites[i].position).squaredNorm() < length * length; }));
  }
  return around > wanted ? around / wanted * static_cast<double>(sites.size()) : 0.0;
}

}  // namespace

SceneSize size_of_soil(Choice const& choice, std::vector<scarp::Site<2>> const& sites) {
  SceneSize size{.points = static_cast<double>(sites.size())};
  if (choice.length > 0.0) size.pairs = pairs_within(choice.length, sites);
  if (choice.soil != Soil::dem) return size;
  for (auto const& column : drawn_depths(choice, sites)) {
    size.prepared += static_cast<double>(column.size());
    if (!column.empty()) size.columns += 1.0;
  }
  if (choice.mirrored_packings) size.prepared *= 2.0;
  return size;
}

/// Measured with meshes of 220 to 30 000 triangles and packings of 100 to 1600 grains: the program, mesh, matrices and,
/// for packings, two states of each point; what is prepared, and the weights of means over a length, are with every
/// process.
double memory_of(Choice const& choice, SceneSize const& size, int processes) {
  constexpr double program = 9e6;
  double const means = 24.0 * size.pairs;  // half as much again as weights take, while their list grows
  double const points = size.points / processes;
  if (choice.soil != Soil::dem) return program + 4.4e3 * points + means;
  return program + (7.6e3 + 270.0 * choice.grains) * points + 135.0 * choice.grains * size.prepared + means;
}

}  // namespace fault_rupture
