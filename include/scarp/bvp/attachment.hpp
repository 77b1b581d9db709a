// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <concepts>
#include <vector>

#include "scarp/core/status.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// What acts on the nodes of a mesh in addition to its elements: contact with another body, springs, the other body itself with
/// degrees of freedom of its own, which follow those of the mesh. Committed and trial states as for materials:
/// add_forces(nodes, increment, forces): adds the internal forces [N] at an increment from the committed state, given the
/// committed positions of the nodes [m]; add_stiffness(entries): their derivative at the last requested increment;
/// commit(nodes, increment): makes that state the committed one, before the nodes move; thickness(), where it has one, is
/// compared with the mesh's; length() [m], where it has one, is the size of a body with degrees of freedom of its own, which its
/// motions are measured by. What can slide also has
/// add_stick_stiffness(entries): the stiffness as if nothing slid, positive where bodies touch.
template <class Part, int Dim>
concept Attachment = requires(Part& part, Part const& constant, std::vector<Vector<Dim>> const& nodes,
                              Eigen::VectorXd const& increment, Eigen::VectorXd& forces,
                              std::vector<Eigen::Triplet<double>>& entries) {
  { constant.extra_dofs() } -> std::same_as<int>;
  { part.add_forces(nodes, increment, forces) } -> std::same_as<Verdict>;
  {constant.add_stiffness(entries)};
  {part.commit(nodes, increment)};
};

/// Nothing: the elements alone.
struct NoAttachment {
  static constexpr int extra_dofs() { return 0; }  ///< It has no degrees of freedom of its own.
  /// Adds nothing.
  template <class Nodes>
  static Verdict add_forces(Nodes const&, Eigen::VectorXd const&, Eigen::VectorXd&) {
    return {};
  }
  static void add_stiffness(std::vector<Eigen::Triplet<double>>&) {}  ///< Adds nothing.
  /// Keeps nothing.
  template <class Nodes>
  static void commit(Nodes const&, Eigen::VectorXd const&) {}
};

}  // namespace scarp
