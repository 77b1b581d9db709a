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

/// Forces [N] of the mesh's degrees of freedom by the means of strains: strains from displacements, and stresses times
/// volume [N m] from means, which outlive the map.
template <int Dim>
LinearMap forces_around(Eigen::SparseMatrix<double> strains, std::vector<VoigtTangent<Dim>> tangents,
                        PointMeans<Dim> const& means, Executor const& executor) {
  return [strains = std::move(strains), tangents = std::move(tangents), &means,
          &executor](Eigen::VectorXd const& displacement) {
    Eigen::VectorXd values = strains * displacement.head(strains.cols());
    auto const of_point = [&](std::size_t k) {
      constexpr int size = voigt_size<Dim>;
      return values.segment<size>(static_cast<Eigen::Index>(size * k));
    };
    std::vector<EngineeringStrain<Dim>> of_strains(tangents.size());
    for (std::size_t k = 0; k < tangents.size(); ++k) of_strains[k] = of_point(k);
    of_strains = means.means(of_strains, executor);
    for (std::size_t k = 0; k < tangents.size(); ++k) of_point(k) = tangents[k] * of_strains[k];
    return Eigen::VectorXd(strains.transpose() * values);
  };
}

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
  stiffness.around = std::make_shared<LinearMap const>(
      forces_around(grid.strain_operator(nodes), std::move(parts.by_mean), *means, executor));
  stiffness.iterate = means->iterate();
}

}  // namespace scarp::detail
