// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Prescribed displacements of nodes: displacement [m] = rate * load factor, in the unit that the load factor has.
/// Degree of freedom = dim * node + axis.
class Constraints {
 public:
  template <class Element>
  explicit Constraints(Mesh<Element> const& mesh) : dim_(Element::dim), nodes_(detail::count(mesh.nodes)) {}

  /// \throws InputError for a node or axis that does not exist, or one that is already moved
  void fix(int node, int axis) { move(node, axis, 0.0); }

  /// Fixes every axis of a node.
  void fix(int node) {
    for (int axis = 0; axis < dim_; ++axis) {
      fix(node, axis);
    }
  }

  /// \throws InputError for a node or axis that does not exist, a rate that is not finite, or a second, different rate
  void move(int node, int axis, double rate) {
    if (node < 0 || node >= nodes_ || axis < 0 || axis >= dim_) {
      refuse("node {}, axis {} is prescribed (the mesh has nodes 0 to {} and axes 0 to {}): check the numbers", node,
             axis, nodes_ - 1, dim_ - 1);
    }
    require_finite("rate of a prescribed displacement", rate);
    int const dof = dim_ * node + axis;
    auto const place = std::lower_bound(dofs_.begin(), dofs_.end(), dof);
    auto const rate_place = rates_.begin() + (place - dofs_.begin());
    if (place == dofs_.end() || *place != dof) {
      rates_.insert(rate_place, rate);
      dofs_.insert(place, dof);
    } else if (*rate_place != rate) {
      refuse("node {}, axis {} is prescribed twice (rates {} and {} differ): decide for one of them", node, axis,
             *rate_place, rate);
    }
  }

  int dof_count() const { return dim_ * nodes_; }
  int free_count() const { return dof_count() - detail::count(dofs_); }

  /// Prescribed degrees of freedom in increasing order.
  std::vector<int> const& prescribed_dofs() const { return dofs_; }

  /// Displacement per load factor of each of prescribed_dofs().
  std::vector<double> const& rates() const { return rates_; }

  bool is_prescribed(int dof) const { return std::binary_search(dofs_.begin(), dofs_.end(), dof); }

  /// Number of a degree of freedom among the free ones, -1 for a prescribed one.
  int free_index(int dof) const {
    auto const place = std::lower_bound(dofs_.begin(), dofs_.end(), dof);
    return place != dofs_.end() && *place == dof ? -1 : dof - static_cast<int>(place - dofs_.begin());
  }

  /// Free degrees of freedom in increasing order.
  std::vector<int> free_dofs() const {
    std::vector<int> free;
    auto next = dofs_.begin();
    for (int dof = 0; dof < dof_count(); ++dof) {
      if (next != dofs_.end() && *next == dof) {
        ++next;
      } else {
        free.push_back(dof);
      }
    }
    return free;
  }

  /// Displacement [m] of all degrees of freedom for a load factor or its increment; the free ones are zero.
  Eigen::VectorXd displacement(double load) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(dof_count());
    for (std::size_t k = 0; k < dofs_.size(); ++k) {
      all(dofs_[k]) = rates_[k] * load;
    }
    return all;
  }

 private:
  int dim_;
  int nodes_;
  std::vector<int> dofs_;
  std::vector<double> rates_;
};

}  // namespace scarp
