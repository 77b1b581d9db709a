// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "bvp/sample_problems.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"

namespace {

using Newton = scarp::QuasiNewton<>;

template <int Dim>
scarp::MohrCoulomb<Dim> clayey_sand(double young = 1e7) {
  return {.elasticity = scarp::IsotropicElasticity::from_young_poisson(young, 0.3),
          .strength = {{.cohesion = 1e3, .friction = 0.4, .dilation = 0.2}}};
}

template <class Element>
using Grid = scarp::Discretisation<Element, scarp::SmallStrain>;

template <class Element>
using Problem = scarp::EquilibriumProblem<Grid<Element>>;

template <class Element, class Hold>
Problem<Element> distorted_body(int cells, scarp::SerialExecutor& executor, Hold const& hold, double young = 1e7) {
  Grid<Element> grid(samples::distorted_block<Element>(cells));
  scarp::Constraints constraints(grid.mesh());
  hold(grid.mesh(), constraints);
  std::vector<scarp::Site<Element::dim>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
  scarp::MaterialPoints<Element::dim> points(clayey_sand<Element::dim>(young), sites);
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(grid.dof_count());
  return {std::move(grid), std::move(points), std::move(constraints), nothing, executor};
}

/// Moves the outline of a distorted patch affinely, well beyond yielding.
template <class Element>
void check_plastic_patch() {
  constexpr int dim = Element::dim;
  auto const gradient = samples::general_gradient<dim>(2e-3);
  scarp::SerialExecutor executor;
  auto problem =
      distorted_body<Element>(dim == 2 ? 3 : 2, executor, [&](auto const& mesh, scarp::Constraints& constraints) {
        Eigen::VectorXd const moves = samples::affine<dim>(mesh.nodes, gradient);
        for (int const node : samples::outline(mesh)) {
          for (int axis = 0; axis < dim; ++axis) constraints.move(node, axis, moves(dim * node + axis));
        }
      });
  REQUIRE(problem.constraints().free_count() > 0);
  constexpr int steps = 4;
  scarp::LoadStepping const equal{.first = 1.0 / steps, .largest = 1.0 / steps, .max_displacement_gradient = 1.0};
  scarp::NoObserver no_observer;
  auto const run =
      equal.run(Newton{.tolerance = 1e-11, .rule = {.exact = {.floor = 1e-6}}}, problem, 0.0, 1.0, no_observer);
  REQUIRE(run.verdict.acceptable());
  REQUIRE(run.steps == steps);
  // The answer of one point to the same increments: a uniform gradient is in equilibrium on any mesh.
  auto const soil = clayey_sand<dim>();
  auto state = soil.initial_state({});
  for (int step = 0; step < steps; ++step) {
    auto const before = state;
    auto const increment = scarp::SmallStrain::material_gradient<dim>(gradient / steps);
    REQUIRE(soil.respond(before, increment, state).verdict.acceptable());
  }
  REQUIRE(state.plastic_shear > 1e-3);
  for (int point = 0; point < problem.points().size(); ++point) {
    auto const& found = problem.points().template state<typename scarp::MohrCoulomb<dim>::State>(point);
    CHECK((found.stress - state.stress).norm() <= 1e-10 * state.stress.norm());
    CHECK(found.plastic_shear == samples::Approx(state.plastic_shear).epsilon(1e-10));
  }
}

/// Steps in which the same points flow as in the step before.
struct SmoothSteps {
  std::vector<scarp::StepReport> steps{};
  std::vector<double> plastic_shear{};
  std::vector<bool> flowing{};

  template <class AnyProblem>
  void attempted(AnyProblem const& problem, scarp::StepReport const& report) {
    using State = typename scarp::MohrCoulomb<AnyProblem::dim>::State;
    std::vector<bool> now;
    std::vector<double> shear;
    for (int point = 0; point < problem.points().size(); ++point) {
      shear.push_back(problem.points().template state<State>(point).plastic_shear);
      now.push_back(plastic_shear.empty() ? false : shear.back() > plastic_shear[static_cast<std::size_t>(point)]);
    }
    if (now == flowing && report.verdict.acceptable()) steps.push_back(report);
    plastic_shear = shear;
    flowing = now;
  }
  bool wants_stop() const { return false; }
};

/// Log-log slope of the last three residuals above round-off; NaN when there are not so many.
double decay(scarp::StepReport const& step) {
  std::vector<double> logs;
  for (auto const& record : step.history) {
    if (record.residual > 5e-11) logs.push_back(std::log(record.residual));
  }
  auto const n = logs.size();
  if (n < 3) return std::nan("");
  return (logs[n - 1] - logs[n - 2]) / (logs[n - 2] - logs[n - 3]);
}

}  // namespace

TEST_CASE_TEMPLATE("a uniform plastic strain is found inside a distorted patch", Element, scarp::Quad4,
                   scarp::Hex8 ALSO_NIGHTLY(scarp::Tri3, scarp::Quad8, scarp::Tet10)) {
  // That a uniform stress is in equilibrium, whatever material it comes from, tests/bvp/patch shows for every element.
  check_plastic_patch<Element>();
}

TEST_CASE("the default solver of a plastic body is Newton's method to six digits") {
  scarp::SerialExecutor executor;
  auto const pressed = [&](auto const& solver) {
    auto problem = distorted_body<scarp::Quad4>(3, executor, [](auto const& mesh, scarp::Constraints& constraints) {
      for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
      for (int const node : boundary_nodes(mesh, "top")) constraints.move(node, 1, -4e-3);
    });
    scarp::NoObserver no_observer;
    auto const run = scarp::LoadStepping{.first = 0.1, .largest = 0.1}.run(solver, problem, 0.0, 1.0, no_observer);
    REQUIRE(run.verdict.acceptable());
    return problem.discretisation().positions();
  };
  auto const reference = pressed(Newton{.tolerance = 1e-10});
  auto const apart = [&](std::vector<scarp::Vector<2>> const& places) {
    double largest = 0.0;
    for (std::size_t n = 0; n < places.size(); ++n)
      largest = std::max(largest, (places[n] - reference[n]).norm() / 4e-3);
    return largest;
  };
  double const suited = apart(pressed(Newton{}));
  double const learned = apart(pressed(scarp::QuasiNewton<scarp::PointwiseBroyden>{.tolerance = 5e-3}));
  MESSAGE("apart " << suited << ", learned tangents " << learned);
  CHECK(suited < 1e-5);  // ten steps of 1e-6
  CHECK(learned > 10.0 * suited);
}

TEST_CASE("Newton's residuals fall quadratically on smooth plastic steps") {
  scarp::SerialExecutor executor;
  // Stiff, so that the strains are small: materials measure the stretch of an increment, small strain gives them its
  // gradient, and their derivatives differ by the strain, which becomes a linear rate. Round-off of the strain grows
  // with the stiffness.
  double const young = 1e9;
  auto problem = distorted_body<scarp::Quad4>(
      3, executor,
      [](auto const& mesh, scarp::Constraints& constraints) {
        for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
        for (int const node : boundary_nodes(mesh, "top")) {
          constraints.move(node, 0, 2e-5);
          constraints.move(node, 1, -2e-5);
        }
      },
      young);
  scarp::LoadStepping const stepping{.first = 0.1, .largest = 0.1, .max_displacement_gradient = 1.0};
  SmoothSteps smooth;
  // A step that repeats the motion of the last one begins too near to its end to show the order of the decay.
  auto const run = stepping.run(Newton{.tolerance = 1e-9, .repeats_motion = false}, problem, 0.0, 1.0, smooth);
  REQUIRE(run.verdict.acceptable());
  int measured = 0;
  for (auto const& step : smooth.steps) {
    double const slope = decay(step);
    if (std::isnan(slope)) continue;
    ++measured;
    CAPTURE(step.load);
    CHECK(slope >= 1.8);
  }
  CHECK(measured >= 2);
}
