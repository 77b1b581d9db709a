// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "scarp/fault/rupture_measures.hpp"
#include "scene.hpp"

namespace fault_slab {

/// The surface along one line of nodes across the fault.
struct Section {
  double y = 0.0;      ///< along the strike [m]
  double share = 0.0;  ///< of the throw that the bedrock has below
  std::vector<scarp::SurfacePoint> profile{};
  scarp::RuptureMeasures measures{};  ///< of the throw here; NaN where there is none
};

/// All of them from the near to the far side.
/// rest, positions [m]: of the mesh's nodes when the fault began to move and now; fault_throw [m]: on the near side
inline std::vector<Section> sections(Scene const& scene, scarp::Mesh<scarp::Hex8> const& mesh,
                                     std::vector<scarp::Vector<3>> const& rest,
                                     std::vector<scarp::Vector<3>> const& positions, double fault_throw) {
  std::map<double, std::vector<scarp::SurfacePoint>> lines;
  for (int const node : boundary_nodes(mesh, "surface")) {
    auto const n = static_cast<std::size_t>(node);
    lines[mesh.nodes[n].y()].push_back({rest[n].x(), positions[n].x(), rest[n].z() - positions[n].z()});
  }
  std::vector<Section> found;
  for (auto& [y, profile] : lines) {
    std::ranges::sort(profile, {}, &scarp::SurfacePoint::x_initial);
    double const share = scene.fault.share_along(y);
    auto const measures =
        rupture_measures(profile, offset_at(scene.fault, share * fault_throw), scene.ground.layer.depth);
    found.push_back({y, share, std::move(profile), measures});
  }
  return found;
}

}  // namespace fault_slab
