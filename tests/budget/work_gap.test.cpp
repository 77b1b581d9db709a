// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "scarp/budget/error_budget.hpp"
#include "scarp/core/described.hpp"
#include "support/block.hpp"

namespace {

using Block = samples::Block<samples::Softening>;

/// It carries nothing.
struct Idle {
  double force = 0.0;

  static int extra_dofs() { return 0; }
  static scarp::Verdict add_forces(std::vector<scarp::Vector<2>> const&, Eigen::VectorXd const&, Eigen::VectorXd&) {
    return {};
  }
  static void add_stiffness(std::vector<Eigen::Triplet<double>>&) {}
  static void commit(std::vector<scarp::Vector<2>> const&, Eigen::VectorXd const&) {}
  SCARP_MEMBERS(force)
};

template <class Problem>
bool adds_up_work(Problem const& problem) {
  auto const parts = scarp::ErrorBudget(problem).parts();
  return std::ranges::any_of(parts, [](auto const& part) { return std::string_view(part.name) == "work_gap"; });
}

}  // namespace

TEST_CASE("a budget adds up the work of elements, and none where a body is attached") {
  scarp::SerialExecutor serial;
  auto const bare = Block::make({}, serial);
  scarp::EquilibriumProblem<Block::Grid> const attached(bare.discretisation(), bare.points(), bare.constraints(),
                                                        bare.loads(), serial, Idle{});
  CHECK(adds_up_work(bare));
  CHECK_FALSE(adds_up_work(attached));
}
