// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/one_of.hpp"

#include <doctest/doctest.h>

#include "scarp/io/state_bits.hpp"
#include "scarp/solver/tangent_rules.hpp"
#include "support/block.hpp"

namespace {

using Secant = scarp::QuasiNewton<>;
using Consistent = scarp::QuasiNewton<scarp::ConsistentTangent>;
using Either = scarp::OneOf<Secant, Consistent>;
using Block = samples::Block<samples::Softening, scarp::UpdatedLagrangian>;

template <class Solver>
std::vector<scarp::Vector<2>> pulled(Solver const& solver, int& iterations) {
  scarp::SerialExecutor serial;
  auto problem = Block::make({.reference_strain = 5e-3}, serial);
  scarp::NoObserver no_observer;
  auto const run = scarp::LoadStepping{}.run(solver, problem, 0.0, 2e-3, no_observer);
  REQUIRE(run.verdict.acceptable());
  iterations = static_cast<int>(run.iterations);
  return problem.discretisation().positions();
}

}  // namespace

TEST_CASE_TEMPLATE("a solver that was chosen does as it does alone", Solver, Secant, Consistent) {
  Solver const solver{.tolerance = 1e-6, .max_iterations = 50};
  int alone_iterations = 0;
  int chosen_iterations = 0;
  auto const alone = pulled(solver, alone_iterations);
  CHECK(pulled(Either{solver}, chosen_iterations) == alone);
  CHECK(chosen_iterations == alone_iterations);
}

TEST_CASE("the session of a chosen solver saves what the solver's own does") {
  scarp::SerialExecutor serial;
  auto problem = Block::make({}, serial);
  auto const saved = [&](auto const& solver) {
    typename std::remove_cvref_t<decltype(solver)>::template Session<Block::Problem> session(solver, problem);
    REQUIRE(session.begin(0.0).acceptable());
    scarp::StateWriter writer;
    writer("session", session);
    return writer.bits();
  };
  CHECK(saved(Either{Consistent{}}) == saved(Consistent{}));
  CHECK(saved(Consistent{}).size() > 100);
}
