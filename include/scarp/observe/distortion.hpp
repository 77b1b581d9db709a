// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/element/map.hpp"
#include "scarp/element/mid_sides.hpp"
#include "scarp/observe/deformation.hpp"
#include "scarp/observe/observers.hpp"

namespace scarp {

/// An element's shape and what has become of it.
template <int Dim>
struct Distortion {
  double mean_ratio = 1.0;                  ///< of its shape now
  double shear = 0.0;                       ///< simple shear with the same change of lengths, since the start
  int element = -1;                         ///< number; -1 without elements
  Vector<Dim> place = Vector<Dim>::Zero();  ///< of its middle now [m]
};

/// d det(A)^(2/d) / |A|^2 of the map A from a regular cell: 1 for a regular one, 0 without volume or inside out (Liu and
/// Joe 1994; Knupp 2001).
template <class Cell>
double mean_ratio(Corners<Cell, Cell::dim> const& corners, Vector<Cell::dim> const& xi) {
  constexpr int dim = Cell::dim;
  constexpr bool is_simplex = LinearOf<Cell>::nodes == dim + 1;
  Tensor<dim> const map = jacobian<Cell, dim>(corners, xi);
  // Scalar products of the edges of a regular cell: of unit length, in simplices at 60 degrees.
  Tensor<dim> edges = Tensor<dim>::Identity();
  if (is_simplex) edges = (edges + Tensor<dim>::Ones()) / 2.0;
  double const volume = map.determinant() / std::sqrt(edges.determinant());
  return volume > 0.0 ? dim * std::pow(volume, 2.0 / dim) / (map * edges.inverse() * map.transpose()).trace() : 0.0;
}

/// The committed element with the least mean ratio at any of its points.
template <class DiscretisationType>
Distortion<DiscretisationType::dim> largest_distortion(DiscretisationType const& grid) {
  using Element = typename std::remove_cvref_t<decltype(grid.mesh())>::ElementType;
  constexpr int dim = DiscretisationType::dim;
  Distortion<dim> worst;
  for (int point = 0; point < grid.point_count(); ++point) {
    int const element = point / DiscretisationType::points_per_element;
    auto const nodes = corners<Element, dim>(grid.mesh().elements[static_cast<std::size_t>(element)], grid.positions());
    double const ratio = mean_ratio<Element>(nodes, DiscretisationType::local_point(point).xi);
    if (worst.element >= 0 && ratio >= worst.mean_ratio) continue;
    Tensor<dim> const moved = grid.deformation(point);
    double const volume = moved.determinant();
    double const lengths = volume > 0.0 ? moved.squaredNorm() / std::pow(volume, 2.0 / dim) - dim : 0.0;
    worst = {ratio, std::sqrt(std::max(lengths, 0.0)), element, nodes.colwise().mean().transpose()};
  }
  return worst;
}

/// Reports when an accepted step has brought the least mean ratio below `limit`, and again each time it has halved.
template <int Dim>
class DistortionWarning : public NeverStops {
 public:
  using Report = std::function<void(Distortion<Dim> const&)>;  ///< receives the element with the least mean ratio

  /// limit: mean ratio below which the first report is made
  /// \throws InputError unless it is positive
  explicit DistortionWarning(Report report, double limit = 0.2)
      : report_(std::move(report)), limit_(require_positive("mean ratio that is warned of", limit)) {}

  /// Reports an accepted state whose least mean ratio has fallen below the limit.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    auto const worst = largest_distortion(problem.discretisation());
    if (worst.mean_ratio >= limit_) return;
    limit_ = worst.mean_ratio / 2.0;
    report_(worst);
  }

  SCARP_MEMBERS_EXCEPT((report_), limit_)

 private:
  Report report_;
  double limit_;
};

}  // namespace scarp
