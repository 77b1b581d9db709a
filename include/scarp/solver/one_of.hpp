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
  std::variant<Solvers...> chosen{};

  /// Session of the solver that was chosen.
  template <class Problem>
  class Session {
   public:
    Session(OneOf const& solver, Problem& problem)
        : chosen_(std::visit([&](auto const& one) { return session(one, problem); }, solver.chosen)) {}

    Verdict begin(double load) {
      return with_session([&](auto& session) { return session.begin(load); });
    }
    void describe(StepReport& report) const {
      with_session([&](auto& session) { session.describe(report); });
    }
    Eigen::VectorXd predict(double from, double to) {
      return with_session([&](auto& session) { return session.predict(from, to); });
    }
    void correct(Eigen::VectorXd& increment, StepReport& report, StopCondition const& stop = {}) {
      with_session([&](auto& session) { session.correct(increment, report, stop); });
    }
    void accept(Eigen::VectorXd const& increment) {
      with_session([&](auto& session) { session.accept(increment); });
    }

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
