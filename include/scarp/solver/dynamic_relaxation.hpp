// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>

#include "scarp/core/described.hpp"
#include "scarp/solver/detail/linearised_step.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/sparse_lu.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// Explicit motion of the nodes to equilibrium. Lumped masses are scaled so that a time step of 1 is stable (half the row sums of
/// |K| over 2, after Gershgorin); velocities fall to zero at every peak of the kinetic energy (kinetic damping; Cundall 1976,
/// Barnes 1999). A load step begins at the linear prediction; every motion then asks all points for the whole increment from
/// their committed states. Iterations of the report are motions: load stepping that counts them wants `few` and `many` in the
/// hundreds.
template <LinearSolver Linear = SparseLu>
struct DynamicRelaxation {
  double tolerance = 5e-3;  ///< force residual, see EquilibriumProblem::residuals
  int most_iterations = 1000;
  double hopeless = 10.0;  ///< residual beyond which a step is given up
  double mass = 1.5;       ///< relative to the least one that is stable for the tangents at the start of the step

  /// \throws InputError for a setting outside of its range
  void validate() const {
    require_positive("tolerance of the force residual", tolerance);
    require_at_least("most motions of a load step", most_iterations, 1);
    require_at_least("residual beyond which a step is given up", hopeless, tolerance);
    require_positive("mass relative to the least stable one", mass);
  }

  /// The motion on one problem.
  template <class Problem>
  class Session {
   public:
    static constexpr int dim = Problem::dim;
    static_assert(Problem::is_bare, "what is attached to the ground has no mass: take QuasiNewton");

    Session(DynamicRelaxation const& settings, Problem& problem)
        : settings_(detail::validated(settings)), problem_(problem), start_(problem, settings.tolerance) {}

    /// Readies a step from the committed state at a load factor: masses, and the matrix of the prediction.
    Verdict begin(double load) {
      problem_.aim(load);
      auto const tangents = problem_.committed_tangents();
      Verdict const verdict = start_.linearise(tangents);
      Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem_.dof_count());
      Eigen::SparseMatrix<double> stiffness;
      problem_.ground_stiffness(still, tangents, stiffness);
      mass_ = settings_.mass / 4.0 *
              start_.linearised().system().gather(stiffness.cwiseAbs() * (still.array() + 1.0).matrix());
      return verdict;
    }

    void describe(StepReport& report) const { start_.describe(report); }
    Eigen::VectorXd predict(double from, double to) { return start_.predict(from, to); }

    /// Moves from a prediction, which ends as the increment in equilibrium; the points' trial states then belong to it.
    void correct(Eigen::VectorXd& increment, StepReport& report, StopQuestion const& stop = {}) {
      report.verdict = problem_.plan(increment, &report.worst_point);
      if (!report.verdict.acceptable()) return;
      report.largest_gradient = problem_.largest_gradient();
      Eigen::VectorXd velocity = Eigen::VectorXd::Zero(mass_.size());
      double energy = 0.0;
      Evaluation evaluation = recorded(report, increment);
      for (;;) {
        if (report.verdict.status == Status::failed) return;
        if (evaluation.residual <= settings_.tolerance && report.verdict.acceptable()) return;
        if (report.iterations() >= settings_.most_iterations || evaluation.residual > settings_.hopeless) {
          if (report.verdict.acceptable()) report.verdict = {Status::not_converged, Reason::iterations_spent};
          return;
        }
        if (report.stopped(stop)) return;
        Eigen::VectorXd const push = -start_.linearised().system().gather(evaluation.unbalanced).cwiseQuotient(mass_);
        velocity += push;
        double const now = velocity.cwiseAbs2().dot(mass_);
        bool const past_peak = now < energy;
        if (past_peak) velocity = push / 2.0;
        energy = past_peak ? 0.0 : now;
        start_.linearised().system().scatter(start_.linearised().system().gather(increment) + velocity, increment);
        evaluation = recorded(report, increment);
      }
    }

    void accept(Eigen::VectorXd const& increment) { problem_.commit(increment); }

    /// Nothing: every step begins at rest, with masses of its own.
    SCARP_MEMBERS_EXCEPT((settings_, problem_, start_, mass_))

   private:
    Evaluation recorded(StepReport& report, Eigen::VectorXd const& increment) {
      auto const started = std::chrono::steady_clock::now();
      Evaluation evaluation = problem_.evaluate(increment);
      double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
      report.history.push_back({evaluation.residual, 0.0, evaluation.inner_steps, seconds});
      report.verdict = evaluation.verdict;
      report.worst_point = evaluation.worst_point;
      report.parts = evaluation.parts;
      return evaluation;
    }

    DynamicRelaxation settings_;
    Problem& problem_;
    StepStart<Problem, Linear> start_;
    Eigen::VectorXd mass_;  ///< of the free degrees of freedom [kg], for a time step of 1 s
  };
};

}  // namespace scarp
