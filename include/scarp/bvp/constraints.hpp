// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scarp/bvp/grid.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Prescribed displacements of nodes: displacement [m] = rate * load factor, in the unit that the load factor has, or
/// rate * (amplitude(load factor) - amplitude(0)). Degree of freedom = dim * node + axis; those of attached bodies
/// follow.
class Constraints {
 public:
  /// extra_dofs: degrees of freedom that follow those of the nodes
  template <class Element>
  explicit Constraints(Mesh<Element> const& mesh, int extra_dofs = 0)
      : dim_(Element::dim), nodes_(detail::count(mesh.nodes)), motions_(detail::index(dim_ * nodes_ + extra_dofs)) {}

  /// extra_dofs: degrees of freedom that follow those of the nodes
  template <int Dim>
  explicit Constraints(Grid<Dim> const& grid, int extra_dofs = 0)
      : dim_(Dim), nodes_(grid.node_count()), motions_(detail::index(grid.dof_count() + extra_dofs)) {}

  /// Holds a node along an axis of space at its place.
  /// \throws InputError for a node or axis that does not exist, or one that is already moved
  void fix(int node, int axis) { move(node, axis, 0.0); }

  /// Fixes every axis of a node, or none.
  void fix(int node) {
    for (int axis = 0; axis < dim_; ++axis) require_one_motion(dof_of(node, axis), words(node, axis), 0.0, {});
    for (int axis = 0; axis < dim_; ++axis) fix(node, axis);
  }

  /// Moves a node along an axis of space by rate [m] times the growth of `amplitude` since the load factor 0.
  /// \throws InputError for a node or axis that does not exist, a rate that is not finite, or a second, different
  /// motion
  void move(int node, int axis, double rate, TimeFunction amplitude = {}) {
    prescribe(dof_of(node, axis), words(node, axis), rate, std::move(amplitude));
  }

  /// Moves a degree of freedom of an attached body, counted from 0, by rate [m] times the growth of `amplitude` since
  /// the load factor 0.
  /// \throws InputError for one that does not exist, a rate that is not finite, or a second, different motion
  void move_extra(int number, double rate, TimeFunction amplitude = {}) {
    int const extra_dofs = dof_count() - dim_ * nodes_;
    if (number < 0 || number >= extra_dofs) {
      reject("extra degree of freedom {} is prescribed (there are {}): check the number", number, extra_dofs);
    }
    prescribe(dim_ * nodes_ + number, fmt::format("extra degree of freedom {}", number), rate, std::move(amplitude));
  }

  /// Adds degrees of freedom of what is attached.
  void add_dofs(int extra_dofs) { motions_.resize(motions_.size() + detail::index(extra_dofs)); }

  /// Degrees of freedom of the nodes and of attached bodies.
  int dof_count() const { return detail::count(motions_); }
  /// Degrees of freedom that are not prescribed.
  int free_count() const { return detail::count(free_dofs()); }

  /// Whether a degree of freedom's motion is prescribed, also by zero.
  bool is_prescribed(int dof) const { return motions_[detail::index(dof)].has_value(); }

  /// Displacement of a degree of freedom per unit of its amplitude; 0 for a free one.
  double rate(int dof) const { return is_prescribed(dof) ? motions_[detail::index(dof)]->rate : 0.0; }

  /// Prescribed degrees of freedom in increasing order.
  std::vector<int> prescribed_dofs() const { return dofs(true); }

  /// Free degrees of freedom in increasing order.
  std::vector<int> free_dofs() const { return dofs(false); }

  /// Displacement [m] of all degrees of freedom between two load factors; the free ones are zero.
  Eigen::VectorXd displacement(double from, double to) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(dof_count());
    for (int const dof : prescribed_dofs()) {
      auto const& amplitude = motions_[detail::index(dof)]->amplitude;
      all(dof) = rate(dof) * (amplitude(to) - amplitude(from));
    }
    return all;
  }

  /// From the load factor 0.
  Eigen::VectorXd displacement(double load) const { return displacement(0.0, load); }

  /// Load factor of the first knot of any motion's amplitude beyond one; infinite beyond the last.
  double next_knot(double load) const {
    double next = std::numeric_limits<double>::infinity();
    for (auto const& motion : motions_)
      if (motion) next = std::min(next, motion->amplitude.next_knot(load));
    return next;
  }

 private:
  struct Motion {
    double rate = 0.0;
    TimeFunction amplitude{};
  };

  static std::string words(int node, int axis) { return fmt::format("node {}, axis {}", node, axis); }
  int dof_of(int node, int axis) const {
    if (node < 0 || node >= nodes_ || axis < 0 || axis >= dim_) {
      reject("{} is prescribed (the mesh has nodes 0 to {} and axes 0 to {}): check the numbers", words(node, axis),
             nodes_ - 1, dim_ - 1);
    }
    return dim_ * node + axis;
  }
  void require_one_motion(int dof, std::string const& what, double rate, TimeFunction const& amplitude) const {
    auto const& known = motions_[detail::index(dof)];
    if (!known) return;
    if (known->rate != rate) {
      reject("{} is prescribed twice (rates {} and {} differ): decide for one of them", what, known->rate, rate);
    }
    if (rate != 0.0 && !(known->amplitude == amplitude)) {
      reject("{} is prescribed twice (by different amplitudes of the rate {}): decide for one of them", what, rate);
    }
  }
  void prescribe(int dof, std::string const& what, double rate, TimeFunction amplitude) {
    require_finite("rate of a prescribed displacement", rate);
    require_one_motion(dof, what, rate, amplitude);
    auto& known = motions_[detail::index(dof)];
    if (!known) known = {rate, std::move(amplitude)};
  }

  std::vector<int> dofs(bool prescribed) const {
    std::vector<int> found;
    for (int dof = 0; dof < dof_count(); ++dof)
      if (is_prescribed(dof) == prescribed) found.push_back(dof);
    return found;
  }

  int dim_;
  int nodes_;
  std::vector<std::optional<Motion>> motions_;  ///< by degree of freedom; none of free ones
};

}  // namespace scarp
