// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/dem/packing.hpp"

namespace rve_lab {

/// Displacement of each grain beyond the affine one, \f$ x_{end} - F x_{start} \f$ [m], up to lattice vectors: taken to
/// be less than half a cell. Its mean, a rigid shift that means nothing in a periodic cell, is taken off.
/// `deformation` F is the cell's deformation gradient between the two states of one population.
/// \throws InputError for packings of different size
template <class PackingType>
std::vector<scarp::Vector<PackingType::dim>> non_affine_motion(PackingType const& start, PackingType const& end,
                                                               scarp::Tensor<PackingType::dim> const& deformation) {
  constexpr int dim = PackingType::dim;
  if (start.grain_count() != end.grain_count()) {
    scarp::reject(
        "motion between packings of {} and {} grains was requested (they are not states of one): give two states",
        start.grain_count(), end.grain_count());
  }
  scarp::Tensor<dim> const inverse = end.cell.inverse();
  std::vector<scarp::Vector<dim>> motion(end.grain_count());
  scarp::Vector<dim> mean = scarp::Vector<dim>::Zero();
  for (std::size_t i = 0; i < motion.size(); ++i) {
    scarp::Vector<dim> before;
    scarp::Vector<dim> after;
    for (int a = 0; a < dim; ++a) {
      before(a) = static_cast<double>(start.position(i, a));
      after(a) = static_cast<double>(end.position(i, a));
    }
    scarp::Vector<dim> const gap = after - deformation * before;
    motion[i] = gap - end.cell * (inverse * gap).array().round().matrix();
    mean += motion[i] / static_cast<double>(motion.size());
  }
  for (auto& step : motion) step -= mean;
  return motion;
}

/// Root mean square of such motions [m].
template <int Dim>
double root_mean_square(std::vector<scarp::Vector<Dim>> const& motion) {
  double sum = 0.0;
  for (auto const& step : motion) sum += step.squaredNorm();
  return motion.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(motion.size()));
}

}  // namespace rve_lab
