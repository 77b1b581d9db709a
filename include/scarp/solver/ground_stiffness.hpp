// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <utility>

#include "scarp/core/linear_map.hpp"

namespace scarp {

/// Stiffness [N/m] of a ground. Where the stress of a point changes with its own strain and with the mean strain around it,
/// \f$ K = K(\sigma, C^{own}) + \sum_i v_i B_i^T (C_i + C^{mean}_i) \sum_j w_{ij} B_j \f$: the second part couples all points within
/// the length and is not symmetric; it is applied, never assembled.
struct GroundStiffness {
  Eigen::SparseMatrix<double> own;  ///< what the elements hold without their neighbours
  /// Forces of the second part, of the mesh's degrees of freedom; shared by copies, none for local ground.
  std::shared_ptr<LinearMap const> around{};
  LinearIteration iterate = nullptr;  ///< solves with the second part

  /// The same for more degrees of freedom, behind those of the mesh, which nothing here holds.
  void conservativeResize(Eigen::Index rows, Eigen::Index columns) { own.conservativeResize(rows, columns); }

  /// more: [N/m], shape (degrees of freedom, twice)
  friend GroundStiffness operator+(GroundStiffness stiffness, Eigen::SparseMatrix<double> const& more) {
    stiffness.own += more;
    return stiffness;
  }

  /// Forces [N] against a small further displacement [m]; shape (degrees of freedom)
  Eigen::VectorXd operator*(Eigen::VectorXd const& displacement) const {
    Eigen::VectorXd forces = own * displacement;
    if (!around) return forces;
    Eigen::VectorXd const more = (*around)(displacement);
    forces.head(more.size()) += more;
    return forces;
  }
};

}  // namespace scarp
