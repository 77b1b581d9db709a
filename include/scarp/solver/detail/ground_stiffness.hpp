// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <utility>
#include <vector>

#include "scarp/bvp/grid.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/linear_map.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp::detail {

/// See Problem::ground_stiffness; nodes: the mesh's part of the increment [m]
template <int Dim>
void ground_stiffness(Grid<Dim> const& grid, MaterialPoints<Dim> const& points, Executor const& executor,
                      Eigen::VectorXd const& nodes, std::vector<VoigtTangent<Dim>> const& tangents,
                      GroundStiffness& stiffness) {
  stiffness.around = nullptr;
  auto const* means = points.means();
  if (!means) return grid.stiffness(nodes, points.stresses(), tangents, stiffness.own);
  auto parts = means->split(tangents);
  grid.stiffness(nodes, points.stresses(), parts.by_own, stiffness.own);
  auto const volumes = grid.volumes(nodes);
  for (std::size_t k = 0; k < volumes.size(); ++k) parts.by_mean[k] *= volumes[k];
  auto const strains = std::make_shared<SparseMatrix const>(grid.strain_operator(nodes));
  stiffness.around = std::make_shared<LinearMap const>(means->forces_around(
      [strains](Eigen::VectorXd const& displacement) -> Eigen::VectorXd {
        return *strains * displacement.head(strains->cols());
      },
      [strains](Eigen::VectorXd const& values) -> Eigen::VectorXd { return strains->transpose() * values; },
      std::move(parts.by_mean), executor));
  stiffness.iterate = means->iterate();
}

}  // namespace scarp::detail
