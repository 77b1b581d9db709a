// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/dormant.hpp"

#include <doctest/doctest.h>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/loads.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/recorded.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/consistent_tangent.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;
using Ground = scarp::Recorded<Elastic>;
using Lift = scarp::Dormant<Ground>;
using Grid = scarp::Discretisation<scarp::Quad4>;

static_assert(scarp::ConstitutiveProvider<Lift> && !scarp::PlansWork<Lift>);

constexpr double unit_weight = 18e3;
constexpr double height = 4.0;  // two lifts of 2 m, two elements each

Elastic fill() { return Elastic::from_young_poisson(20e6, 0.3); }

/// A column between smooth walls whose halves are placed one after the other.
struct Embankment {
  using Problem = scarp::EquilibriumProblem<Grid, scarp::ProviderField<Lift>, scarp::SerialExecutor>;

  scarp::SerialExecutor executor;
  Problem problem = make();

  static Grid grid() {
    auto mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, height}, .cells = {1, 4}}.generate();
    mesh.regions = {"first lift", "second lift"};
    mesh.element_region = {0, 0, 1, 1};
    return Grid(mesh);
  }

  /// The weight of each lift grows over one unit of the load factor.
  Problem make() {
    Grid const disc = grid();
    scarp::Constraints constraints(disc.mesh());
    for (auto const* wall : {"left", "right"}) {
      for (int const node : scarp::boundary_nodes(disc.mesh(), wall)) constraints.fix(node, 0);
    }
    for (int const node : scarp::boundary_nodes(disc.mesh(), "bottom")) constraints.fix(node, 1);
    scarp::LoadHistory loads(Eigen::VectorXd::Zero(disc.dof_count()));
    for (int const lift : {0, 1}) {
      auto const weight = [&](int region) { return scarp::Vector<2>(0.0, region == lift ? -unit_weight : 0.0); };
      loads.add(scarp::body_force(disc, weight), scarp::TimeFunction::ramp(lift, lift + 1.0));
    }
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < disc.point_count(); ++point) sites.push_back(disc.site(point, height));
    return {disc, {Lift{.provider = {fill(), {}}}, sites}, constraints, loads, executor};
  }

  int place(int lift) {
    return scarp::activate(problem, [=](scarp::Site<2> const& site) { return site.region == lift; });
  }

  void load(double from, double to) {
    scarp::NoObserver nobody;
    scarp::QuasiNewton<scarp::ConsistentTangent> const solver{.tolerance = 1e-12};
    auto const run = scarp::LoadStepping{.first = 0.25}.run(solver, problem, from, to, nobody);
    REQUIRE(run.verdict.acceptable());
    REQUIRE(run.refused == 0);
  }

  double settlement(double initial_height) const {
    auto const& disc = problem.discretisation();
    for (std::size_t n = 0; n < disc.positions().size(); ++n) {
      if (disc.mesh().nodes[n].y() == initial_height) return initial_height - disc.positions()[n].y();
    }
    return 0.0;
  }

  auto const& history(int point) const { return problem.materials().committed(point).own.history; }
};

}  // namespace

TEST_CASE("a second lift is placed on a settled first one: overburden everywhere, its own strains only") {
  Embankment bank;
  double const modulus = fill().tangent({})(1, 1);
  CHECK(bank.place(0) == 8);
  bank.load(0.0, 1.0);
  double const settled = bank.settlement(2.0);
  // Analytic: gamma h^2 / (2 M), small strain; the strain's square is beyond 1e-2 of it.
  CHECK(settled == samples::Approx(unit_weight * 2.0 / modulus).epsilon(1e-2));
  // Analytic: a waiting body that nothing pulls follows the ground as a rigid one.
  CHECK(bank.settlement(4.0) == samples::Approx(settled).epsilon(1e-6));
  for (int point = 8; point < 16; ++point) CHECK(bank.problem.materials().committed_stress(point).isZero(0.0));

  CHECK(bank.place(1) == 8);
  CHECK(bank.place(1) == 0);
  CHECK(bank.problem.committed_tangents()[12] == fill().tangent({}));
  CHECK(bank.history(12).size() == 1);
  CHECK(bank.problem.evaluate_committed().unbalanced.tail(4).isZero(0.0));  // placing it pulls at nothing

  bank.load(1.0, 2.0);
  for (int point = 0; point < 16; ++point) {
    auto const site = Embankment::grid().site(point, height);
    double const depth = height - std::floor(site.position.y()) - 0.5;  // of the element's centre
    // Analytic: an element in one-dimensional compression carries gamma z of its centre, K0 = nu/(1 - nu) of it sideways.
    auto const stress = bank.problem.materials().committed_stress(point);
    CHECK(stress(1) == samples::Approx(-unit_weight * depth).epsilon(1e-9));
    CHECK(stress(0) == samples::Approx(-unit_weight * depth * 0.3 / 0.7).epsilon(1e-9));
    if (point < 8) continue;
    // Analytic: sigma = M ln(1 + g); the strain measure of an increment differs from the logarithm by its cube.
    CHECK(std::log1p(bank.history(point).back().gradient(1, 1)) ==
          samples::Approx(-unit_weight * depth / modulus).epsilon(1e-6));
  }
  CHECK(bank.settlement(4.0) - bank.settlement(2.0) ==
        samples::Approx(unit_weight * 2.0 / modulus).epsilon(1e-2));  // analytic, as that of the first lift
}

TEST_CASE("a waiting point answers nothing, keeps its initial state, and refuses what is no number") {
  Lift const lift{.provider = {fill(), {}}, .share = 1e-3};
  auto const state = lift.initial_state({});
  auto trial = state;
  scarp::Gradient<2> increment = scarp::Gradient<2>::Constant(0.1);
  CHECK(lift.respond(state, increment, trial).stress.isZero(0.0));
  CHECK(trial.own.history == state.own.history);
  CHECK(lift.tangent(state) == 1e-3 * fill().tangent({}));
  increment(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(lift.respond(state, increment, trial).verdict.reason == scarp::Reason::not_finite);
  CHECK_REFUSED((Lift{.provider = {fill(), {}}, .share = 0.0}).initial_state({}), "share", "is 0");
}
