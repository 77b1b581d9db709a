// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "../shared/elastic_solve.hpp"
#include "scarp/bvp/default_integration.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/mesh/box_mesh.hpp"

namespace surface_orders {

/// How the bottom takes the step of the fault at its tip.
enum class Step {
  moments,    ///< as the scene does
  linear,     ///< half of it at the tip, linear along the two facets beside it
  one_facet,  ///< none of it at the tip, all of it at the next node
};

/// Elastic ground of 75 m x 25 m over a fault at a third from its right end, in cells of 25 m / rows; in space a slab
/// one cell thick.
struct ElasticGround {
  int rows = 4;
  double poisson = 0.3;
  Step step = Step::moments;
};

inline constexpr double depth = 25.0;                ///< [m]
inline constexpr std::array<int, 2> coarsest{6, 2};  ///< cells of the mesh whose nodes are compared

/// Displacement of the surface at the corners of the coarsest mesh, along x and up, in throws; shape (2, places).
template <class Element, class Scheme = scarp::DefaultIntegration<Element>>
Eigen::MatrixXd surface(ElasticGround const& ground) {
  constexpr int dim = Element::dim;
  scarp::BoxMesh<Element> box;
  box.lengths.setConstant(depth);
  box.lengths(0) = 3.0 * depth;
  box.cells.fill(ground.rows);
  box.cells[0] = 3 * ground.rows;
  if constexpr (dim == 3) {
    box.lengths(1) = depth / ground.rows;
    box.cells[1] = 1;
  }
  scarp::NormalFault const fault{.tip = 2.0 * depth};
  scarp::Discretisation<Element, scarp::SmallStrain, Scheme> const grid(box.generate());
  auto const& mesh = grid.mesh();
  auto const constraints = scarp::bedrock_constraints(mesh, fault);
  Eigen::VectorXd prescribed = constraints.displacement(1.0);
  if (ground.step != Step::moments) {
    for (int const node : boundary_nodes(mesh, "bottom")) {
      double const cells_beyond = (mesh.nodes[scarp::detail::index(node)](0) - fault.tip) * ground.rows / depth;
      double const share = ground.step == Step::linear ? std::clamp((cells_beyond + 1.0) / 2.0, 0.0, 1.0)
                                                       : (cells_beyond > 1e-9 ? 1.0 : 0.0);
      prescribed(dim * node) = share * fault.right().x();
      prescribed(dim * node + dim - 1) = share * fault.right().y();
    }
  }
  auto const solid = scarp::LinearElastic<dim>::from_young_poisson(20e6, ground.poisson);
  Eigen::VectorXd const moved =
      examples::elastic_solve(grid, solid, constraints, prescribed, Eigen::VectorXd::Zero(grid.dof_count()));
  Eigen::MatrixXd found(2, coarsest[0] - 1);
  double const apart = 3.0 * depth / coarsest[0];
  for (int const node : boundary_nodes(mesh, "top")) {
    auto const& place = mesh.nodes[scarp::detail::index(node)];
    double const number = place(0) / apart;
    if (std::abs(number - std::round(number)) > 1e-9 || (dim == 3 && place(1) > 1e-9)) continue;
    int const k = static_cast<int>(std::lround(number)) - 1;
    if (k < 0 || k >= found.cols()) continue;
    found.col(k) = Eigen::Vector2d(moved(dim * node), moved(dim * node + dim - 1));
  }
  return found;
}

/// Root mean square distance of two surfaces, in throws.
inline double distance(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.cols()));
}

}  // namespace surface_orders
