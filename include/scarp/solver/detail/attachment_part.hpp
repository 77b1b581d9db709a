// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "scarp/bvp/attachment.hpp"
#include "scarp/solver/incremental_problem.hpp"

namespace scarp::detail {

/// What is attached to the mesh of a problem, as its solver needs it.
template <class Problem, int Dim, class Attached>
class AttachmentPart : public AttachedProblem<Dim> {
 public:
  explicit AttachmentPart(Attached attached) : attached_(std::move(attached)) {}

  Attached const& attached() const { return attached_; }

  /// The first degree of freedom of its own, behind those of the mesh.
  int first_beside() const override { return static_cast<Problem const&>(*this).discretisation().dof_count(); }

  /// Size [m] of what is attached where it has one, else of the mesh.
  double length() const override {
    if constexpr (requires { attached_.length(); }) {
      return attached_.length();
    } else {
      auto const& nodes = static_cast<Problem const&>(*this).discretisation().mesh().nodes;
      Vector<Dim> low = nodes.front();
      Vector<Dim> high = low;
      for (auto const& node : nodes) {
        low = low.cwiseMin(node);
        high = high.cwiseMax(node);
      }
      return (high - low).maxCoeff();
    }
  }

  /// Forces [N] of what is attached alone, at an increment; its trial state then belongs to that increment. Whether it could
  /// result is that of the next evaluation.
  Eigen::VectorXd attached_forces(Eigen::VectorXd const& increment) override {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(this->dof_count());
    auto const& places = static_cast<Problem const&>(*this).discretisation().positions();
    static_cast<void>(attached_.add_forces(places, increment, forces));
    return forces;
  }

  /// Their derivative [N/m] where they were requested last.
  Eigen::SparseMatrix<double> attached_stiffness() const override {
    return assembled([&](auto& entries) { attached_.add_stiffness(entries); });
  }

  /// Stiffness as if nothing slid.
  Eigen::SparseMatrix<double> stick_stiffness() const override {
    if constexpr (requires(std::vector<Eigen::Triplet<double>> & entries) { attached_.add_stick_stiffness(entries); }) {
      return assembled([&](auto& entries) { attached_.add_stick_stiffness(entries); });
    } else {
      return attached_stiffness();
    }
  }

 protected:
  Attached attached_;

 private:
  template <class Add>
  Eigen::SparseMatrix<double> assembled(Add const& add) const {
    std::vector<Eigen::Triplet<double>> entries;
    add(entries);
    Eigen::SparseMatrix<double> matrix(this->dof_count(), this->dof_count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
};

template <class Problem, int Dim>
class AttachmentPart<Problem, Dim, NoAttachment> : public IncrementalProblem<Dim> {
 public:
  explicit AttachmentPart(NoAttachment) {}

  NoAttachment attached() const { return {}; }
};

}  // namespace scarp::detail
