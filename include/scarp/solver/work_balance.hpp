// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Observer that adds up the work of a run by the trapezoidal rule over its accepted steps: external, of loads and of
/// reactions at prescribed displacements, and internal, of the points' stresses on their strains, which they store or
/// dissipate. They differ by what the residual lets through and by the rule, at second order in the step.
/// \tparam Problem a `Problem` without attachment
template <class Problem>
class WorkBalance {
 public:
  static constexpr int dim = Problem::dim;  ///< of the problem

  /// From the first accepted step on.
  WorkBalance() = default;
  /// From the problem's committed state, which belongs to the load factor.
  WorkBalance(Problem const& problem, double load) : now_(problem, load) {}

  double external() const { return external_; }  ///< [J]
  double internal() const { return internal_; }  ///< [J]
  /// |external - internal| over the larger of |internal| and the sum of the absolute parts of the external work.
  double gap() const {
    double const scale = std::max(turned_over_, std::abs(internal_));
    return scale > 0.0 ? std::abs(external_ - internal_) / scale : 0.0;
  }

  /// Adds the work of an accepted step; a rejected attempt does none.
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    Snapshot next(problem, report.load);
    if (!now_.positions.empty()) add(problem, next);
    now_ = std::move(next);
  }
  static bool wants_stop() { return false; }  ///< Never stops a run.

  SCARP_MEMBERS(now_, external_, internal_, turned_over_)

 private:
  struct Snapshot {
    std::vector<Vector<dim>> positions;
    std::vector<VoigtStress<dim>> stresses;
    std::vector<double> volumes;
    std::vector<Vector<dim>>
        forces;  ///< external: loads at free degrees of freedom, with the reactions at prescribed ones

    SCARP_MEMBERS(positions, stresses, volumes, forces)

    Snapshot() = default;
    Snapshot(Problem const& problem, double load)
        : positions(problem.grid().positions()), stresses(problem.balanced_stresses()) {
      if (problem.has_attachment() || problem.has_field())
        reject(
            "the work of a problem with an attachment is requested (that of what is attached is not counted): leave it "
            "out");
      Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem.dof_count());
      volumes = problem.grid().volumes(still);
      Eigen::VectorXd all = problem.loads().at(load);
      Eigen::VectorXd internal;
      problem.grid().internal_force(still, stresses, internal);
      for (int const dof : problem.constraints().prescribed_dofs()) all(dof) = internal(dof);
      for (Eigen::Index row = 0; row < all.size(); row += dim) forces.push_back(all.template segment<dim>(row));
    }
  };

  void add(Problem const& problem, Snapshot const& next) {
    double work = 0.0;
    for (std::size_t node = 0; node < next.positions.size(); ++node) {
      Vector<dim> const moved = next.positions[node] - now_.positions[node];
      work += moved.dot(now_.forces[node] + next.forces[node]) / 2.0;
    }
    external_ += work;
    turned_over_ += std::abs(work);
    for (std::size_t k = 0; k < next.stresses.size(); ++k) {
      VoigtStress<dim> const stress = (now_.volumes[k] * now_.stresses[k] + next.volumes[k] * next.stresses[k]) / 2.0;
      internal_ += stress.dot(
          to_engineering_strain<dim, double>(from_middle(problem.own_gradients()[k], problem.turns_stresses())));
    }
  }

  /// An increment's gradient with respect to the middle of its motion: the strain that a mean stress works on.
  static Gradient<dim> from_middle(Gradient<dim> const& gradient, bool moves) {
    return moves ? Gradient<dim>(gradient * (Gradient<dim>::Identity() + gradient / 2.0).inverse()) : gradient;
  }

  Snapshot now_;
  double external_ = 0.0;
  double internal_ = 0.0;
  double turned_over_ = 0.0;
};

}  // namespace scarp
