// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

#include "scarp/solver/detail/evaluation.hpp"

namespace scarp {

namespace detail {

/// A problem as a path sees it, for the concept alone.
struct AnsweringProblem {
  Evaluation evaluate(Eigen::VectorXd const& increment);
  Evaluation refine(Eigen::VectorXd const& increment);
  Evaluation advance(Eigen::VectorXd const& increment);
  Evaluation rest(Eigen::VectorXd const& increment);
};

}  // namespace detail

/// From which state points answer an iterate: evaluate(problem, increment, first iterate of the step), and refine(problem,
/// increment) after those that are not balanced have got more work.
template <class Path>
concept ResponsePath = requires(detail::AnsweringProblem& problem, Eigen::VectorXd const& increment, bool first) {
  { Path::evaluate(problem, increment, first) } -> std::same_as<Evaluation>;
  { Path::refine(problem, increment) } -> std::same_as<Evaluation>;
};

namespace detail {
/// What is missing, in words.
template <class Path>
struct MissingOfResponsePath {
  static_assert(
      requires(AnsweringProblem & problem, Eigen::VectorXd const& move) {
        { Path::evaluate(problem, move, true) } -> std::same_as<Evaluation>;
      },
      "scarp: a response path needs `static Evaluation evaluate(problem, increment, bool first)`");
  static_assert(
      requires(AnsweringProblem & problem, Eigen::VectorXd const& move) {
        { Path::refine(problem, move) } -> std::same_as<Evaluation>;
      },
      "scarp: a response path needs `static Evaluation refine(problem, increment)`");
  static constexpr bool nothing = false;
};
}  // namespace detail

/// The same; of a type that is none the compiler says in words what is missing.
template <class Path>
concept CheckedResponsePath = ResponsePath<Path> || detail::MissingOfResponsePath<Path>::nothing;

/// Whether points go on from their trial states along a path, which not all materials can.
template <class Path>
inline constexpr bool advances_trials = requires {
  requires Path::advances_trials;
};

/// Every iteration takes the points along the straight path from their committed states to the iterate: the answer is a function of
/// the iterate alone.
struct FromCommitted {
  template <class Problem>
  static Evaluation evaluate(Problem& problem, Eigen::VectorXd const& increment, bool) {
    return problem.evaluate(increment);
  }
  template <class Problem>
  static Evaluation refine(Problem& problem, Eigen::VectorXd const& increment) {
    return problem.refine(increment);
  }
};

/// The points follow the iterates: the first takes the whole increment, each later one only the correction, and a packing that
/// is not balanced works on where it is. Less work, and a disturbance shrinks with the corrections; but the answer belongs to the
/// path that the iteration took.
struct AlongIterates {
  static constexpr bool advances_trials = true;

  template <class Problem>
  static Evaluation evaluate(Problem& problem, Eigen::VectorXd const& increment, bool first) {
    return first ? problem.evaluate(increment) : problem.advance(increment);
  }
  template <class Problem>
  static Evaluation refine(Problem& problem, Eigen::VectorXd const& increment) {
    return problem.rest(increment);
  }
};

static_assert(ResponsePath<FromCommitted> && ResponsePath<AlongIterates>);

}  // namespace scarp
