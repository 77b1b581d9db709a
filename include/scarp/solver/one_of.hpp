// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <variant>

#include "scarp/solver/step_report.hpp"

namespace scarp {

/// A solver chosen while a program runs, among several types.
/// \code
/// scarp::OneOf<scarp::QuasiNewton<>, scarp::QuasiNewton<scarp::ConsistentTangent>> solver;
/// solver.chosen = scarp::QuasiNewton<scarp::ConsistentTangent>{.tolerance = 1e-10};
/// \endcode
template <class... Solvers>
struct OneOf {
  std::variant<Solvers...> chosen{};  ///< solver that a session is made of; later changes do not reach the session

  /// Session of the solver that was chosen.
  template <class Problem>
  class Session {
   public:
    /// The problem must outlive the session.
    Session(OneOf const& solver, Problem& problem)
        : chosen_(std::visit([&](auto const& one) { return session(one, problem); }, solver.chosen)) {}

    /// Readies a step from the committed state at a load factor.
    Verdict begin(double load) {
      return with_session([&](auto& session) { return session.begin(load); });
    }
    /// Adds what the chosen solver found out about its system.
    void describe(StepReport& report) const {
      with_session([&](auto& session) { session.describe(report); });
    }
    /// First guess of the displacement increment [m] between two load factors.
    Eigen::VectorXd predict(double from, double to) {
      return with_session([&](auto& session) { return session.predict(from, to); });
    }
    /// Iterates from a prediction [m], which ends as the increment in equilibrium; `report` receives each iteration.
    void correct(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop = {}) {
      with_session([&](auto& session) { session.correct(increment, report, stop); });
    }
    /// Commits an increment [m] in equilibrium.
    void accept(Eigen::VectorXd const& increment) {
      with_session([&](auto& session) { session.accept(increment); });
    }

    /// State of the chosen solver's session.
    template <class Self, class Visit>
    static void members(Self& self, Visit&& visit) {
      self.with_session([&](auto& session) { visit("session", session); });
    }

   private:
    template <class Solver>
    using SessionOf = typename Solver::template Session<Problem>;
    using Chosen = std::variant<std::unique_ptr<SessionOf<Solvers>>...>;

    template <class Solver>
    static Chosen session(Solver const& solver, Problem& problem) {
      return std::make_unique<SessionOf<Solver>>(solver, problem);
    }

    template <class Function>
    decltype(auto) with_session(Function const& function) const {
      return std::visit([&](auto const& session) -> decltype(auto) { return function(*session); }, chosen_);
    }

    Chosen chosen_;
  };
};

}  // namespace scarp
