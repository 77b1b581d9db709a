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

  template <class Problem>
  class Session {
   public:
    Session(OneOf const& solver, Problem& problem)
        : chosen_(std::visit([&](auto const& one) { return session(one, problem); }, solver.chosen)) {}

    Verdict begin(double load) {
      return ask([&](auto& session) { return session.begin(load); });
    }
    void describe(StepReport& report) const {
      ask([&](auto& session) { session.describe(report); });
    }
    Eigen::VectorXd predict(double from, double to) {
      return ask([&](auto& session) { return session.predict(from, to); });
    }
    void correct(Eigen::VectorXd& increment, StepReport& report, StopQuestion const& stop = {}) {
      ask([&](auto& session) { session.correct(increment, report, stop); });
    }
    void accept(Eigen::VectorXd const& increment) {
      ask([&](auto& session) { session.accept(increment); });
    }

    template <class Self, class Visit>
    static void members(Self& self, Visit&& visit) {
      self.ask([&](auto& session) { visit("session", session); });
    }

   private:
    template <class Solver>
    using SessionOf = typename Solver::template Session<Problem>;
    using Chosen = std::variant<std::unique_ptr<SessionOf<Solvers>>...>;

    template <class Solver>
    static Chosen session(Solver const& solver, Problem& problem) {
      return std::make_unique<SessionOf<Solver>>(solver, problem);
    }

    template <class Ask>
    decltype(auto) ask(Ask const& ask) const {
      return std::visit([&](auto const& session) -> decltype(auto) { return ask(*session); }, chosen_);
    }

    Chosen chosen_;
  };
};

}  // namespace scarp
