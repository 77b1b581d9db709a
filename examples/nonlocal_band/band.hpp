// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <vector>

#include "specimen.hpp"

namespace nonlocal_band {

/// Force [N] on the top, positive in compression, and the share of stress against fluctuation strain in all stress.
inline std::array<double, 2> top_force(Problem const& problem) {
  auto const& grid = problem.discretisation();
  auto const still = Eigen::VectorXd::Zero(grid.dof_count()).eval();
  auto const volumes = grid.volumes(still);
  auto const stresses = problem.committed_stresses();
  auto const balanced = problem.balanced_stresses();
  double fluctuation = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    fluctuation += volumes[k] * (balanced[k] - stresses[k]).norm();
    all += volumes[k] * stresses[k].norm();
  }
  Eigen::VectorXd forces;
  grid.internal_force(still, balanced, forces);
  double force = 0.0;
  for (int const node : scarp::boundary_nodes(grid.mesh(), "top")) force -= forces(2 * node + 1);
  return {force, fluctuation / all};
}

/// Where a specimen shears while its top moves on.
struct Band {
  double width = 0.0;   ///< [m] of a layer of the band's length that shears as much and as unevenly
  double spread = 0.0;  ///< [m] standard deviation across the band, times the root of 12 (the width of an even layer)
  double angle = 0.0;   ///< to the horizontal [degrees]
};

/// Shear strain of every point, the difference of the principal strains, between two states of the nodes.
inline std::vector<double> shear_strains(Problem const& problem, std::vector<scarp::Vector<2>> const& from,
                                         std::vector<scarp::Vector<2>> const& to) {
  auto const& grid = problem.discretisation();
  Eigen::VectorXd moved(grid.dof_count());
  for (std::size_t n = 0; n < from.size(); ++n) moved.segment<2>(static_cast<Eigen::Index>(2 * n)) = to[n] - from[n];
  std::vector<scarp::Gradient<2>> gradients(static_cast<std::size_t>(grid.point_count()));
  grid.gradients(moved, gradients);
  std::vector<double> shears;
  for (auto const& g : gradients) shears.push_back(std::hypot(g(0, 0) - g(1, 1), g(0, 1) + g(1, 0)));
  return shears;
}

/// Width: \f$ (\int\gamma\,dA)^2 / \int\gamma^2 dA \f$, the area that shears evenly, over the length at which a band of
/// that direction crosses the specimen. Needs no threshold, fit of a profile, or grid.
inline Band measure(Problem const& problem, std::vector<double> const& shears) {
  auto const& grid = problem.discretisation();
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  double first = 0.0;
  double second = 0.0;
  scarp::Vector<2> centre = scarp::Vector<2>::Zero();
  for (std::size_t k = 0; k < shears.size(); ++k) {
    double const weight = volumes[k] * shears[k] * shears[k];
    first += volumes[k] * shears[k];
    second += weight;
    centre += weight * grid.site(static_cast<int>(k), height).position;
  }
  centre /= second;
  scarp::Tensor<2> moments = scarp::Tensor<2>::Zero();
  for (std::size_t k = 0; k < shears.size(); ++k) {
    scarp::Vector<2> const arm = grid.site(static_cast<int>(k), height).position - centre;
    moments += volumes[k] * shears[k] * shears[k] / second * arm * arm.transpose();
  }
  double const mean = moments.trace() / 2.0;
  double const half = std::hypot((moments(0, 0) - moments(1, 1)) / 2.0, moments(0, 1));
  double const angle = std::atan2(2.0 * moments(0, 1), moments(0, 0) - moments(1, 1)) / 2.0;
  return {first * first / second * std::cos(angle) / nonlocal_band::width, std::sqrt(12.0 * (mean - half)),
          angle * 180.0 / std::numbers::pi};
}

}  // namespace nonlocal_band
