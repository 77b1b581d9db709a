// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "scarp/bvp/discretisation.hpp"
#include "support/approx.hpp"
#include "support/block.hpp"

namespace {

using Grid = scarp::Discretisation<scarp::Tri3, scarp::SmallStrain>;
using Problem = scarp::EquilibriumProblem<Grid>;

constexpr double ground_weight = 20e3 * 4.0 * 4.0;  // [N], unit weight times width, height; 1 m thick
constexpr double footing_weight = 0.1e3 * 4.0 * 1.0;

/// 4 m x 4 m of heavy ground, fixed at its base, below a light block 1 m high that shares its nodes. The load factor
/// places the block.
template <class Provider>
Problem ground_with_block(Provider const& provider, scarp::SerialExecutor& executor) {
  auto mesh = samples::CrossedRectangle{.width = 4.0, .height = 5.0, .columns = 4, .rows = 5}.generate();
  mesh.regions.emplace_back("footing");
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double height = 0.0;
    for (int const node : mesh.elements[e]) height += mesh.nodes[scarp::detail::index(node)].y() / 3.0;
    mesh.element_region[e] = height > 4.0 ? 1 : 0;
  }
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node);
  Grid grid(std::move(mesh));
  auto const weight_of = [&](int chosen, double unit_weight) {
    return grid.body_force([=](int region) { return scarp::Vector<2>(0.0, region == chosen ? -unit_weight : 0.0); });
  };
  scarp::LoadHistory loads(weight_of(0, 20e3));
  loads.add(weight_of(1, 0.1e3), scarp::TimeFunction::ramp(0.0, 1.0));
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 5.0));
  return {std::move(grid), {provider, sites}, std::move(constraints), std::move(loads), executor};
}

template <class Problem>
std::vector<int> base_of_block(Problem const& problem) {
  std::vector<int> nodes;
  auto const& places = problem.discretisation().mesh().nodes;
  for (int node = 0; node < scarp::detail::count(places); ++node)
    if (places[scarp::detail::index(node)].y() == 4.0) nodes.push_back(node);
  return nodes;
}

/// Forces [N] when the ground is carried but a part of the block's weight is not, at the block's base.
template <class Problem>
Eigen::VectorXd unsupported(Problem const& problem, double part) {
  Eigen::VectorXd unbalanced = Eigen::VectorXd::Zero(problem.dof_count());
  auto const bottom = scarp::boundary_nodes(problem.discretisation().mesh(), "bottom");
  for (int const node : bottom)
    unbalanced(2 * node + 1) = (ground_weight + (1.0 - part) * footing_weight) / static_cast<double>(bottom.size());
  auto const base = base_of_block(problem);
  for (int const node : base) unbalanced(2 * node + 1) = part * footing_weight / static_cast<double>(base.size());
  return unbalanced;
}

double value_of(std::vector<scarp::PartResidual> const& parts, std::string const& name) {
  for (auto const& part : parts)
    if (part.name == name) return part.value;
  FAIL("no part has the name " << name);
  return 0.0;
}

}  // namespace

TEST_CASE("a block whose loads balance each other to round-off has no residual of its own") {
  scarp::SerialExecutor serial;
  auto const problem = ground_with_block(samples::elastic_soil(), serial);
  auto const& mesh = problem.discretisation().mesh();
  scarp::detail::RegionResiduals<2> const parts(problem.grid(), problem.constraints());
  REQUIRE(!parts.empty());
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(problem.dof_count());
  std::vector<int> top;
  for (int node = 0; node < scarp::detail::count(mesh.nodes); ++node)
    if (mesh.nodes[scarp::detail::index(node)].y() == 5.0) top.push_back(node);
  REQUIRE(top.size() >= 3);
  loads(2 * top[0]) = 0.1;
  loads(2 * top[1]) = 0.2;
  loads(2 * top[2]) = -0.3;  // 0.1 + 0.2 - 0.3 is not zero
  CHECK(parts.largest(1e-3 * Eigen::VectorXd::Ones(problem.dof_count()), loads, 0.0) == 0.0);
}

TEST_CASE("a block that weighs less than a millionth of the whole needs no equilibrium of its own") {
  scarp::SerialExecutor serial;
  auto const problem = ground_with_block(samples::elastic_soil(), serial);
  scarp::detail::RegionResiduals<2> const parts(problem.grid(), problem.constraints());
  Eigen::VectorXd loads = problem.loads().at(0.0);
  auto const weight = (problem.loads().at(1.0) - loads).eval();
  CHECK(parts.largest(weight, loads + weight, 0.0) > 1.0);
  CHECK(parts.largest(1e-9 * weight, loads + 1e-9 * weight, 0.0) < 1e-5);
}

TEST_CASE("nine hundredths of a light block that nothing carries are no equilibrium, however heavy the ground") {
  scarp::SerialExecutor serial;
  auto problem = ground_with_block(samples::elastic_soil(), serial);
  problem.set_load(1.0);
  auto const unbalanced = unsupported(problem, 0.09);
  auto const parts = problem.residuals(unbalanced);
  REQUIRE(parts.size() == 2);  // the ground has reactions of its own
  // Analytic: 9 % of the weight on five nodes over all of it on five, 400 / 320 400 of each other.
  CHECK(value_of(parts, "all") == samples::Approx(0.09 * 400.0 / 320364.0));
  CHECK(value_of(parts, "all") < 1e-3);
  // Analytic: nodes that the block has of its own bear two thirds of it (one row of crossed triangles).
  CHECK(value_of(parts, "footing") == samples::Approx(0.09 * 1.5));
  CHECK(problem.residual(unbalanced) == value_of(parts, "footing"));
}

TEST_CASE("a block whose loads pass through zero is compared with those that it had") {
  scarp::SerialExecutor serial;
  auto const weighed = ground_with_block(samples::elastic_soil(), serial);
  auto const& grid = weighed.discretisation();
  scarp::LoadHistory loads;
  Eigen::VectorXd const weight = weighed.loads().at(1.0) - weighed.loads().at(0.0);
  loads.add(weight, scarp::TimeFunction({{0.0, 0.0}, {1.0, 1.0}, {1.3, 1.0}, {1.4, -1.0}}));
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 5.0));
  Problem problem(grid, {samples::elastic_soil(), sites}, weighed.constraints(), loads, serial);
  auto const unbalanced = unsupported(problem, 0.09);
  problem.set_load(1.0);
  double const at_peak = value_of(problem.residuals(unbalanced), "footing");
  problem.set_load(0.5);  // no larger loads were known before
  CHECK(value_of(problem.residuals(unbalanced), "footing") == samples::Approx(2.0 * at_peak));
  problem.set_load(1.35);
  REQUIRE(problem.loads().at(1.35).norm() > 0.0);
  REQUIRE(problem.loads().at(1.35).norm() < 1e-12 * weight.norm());
  CHECK(value_of(problem.residuals(unbalanced), "footing") == samples::Approx(10.0 * at_peak));
}

TEST_CASE("forces that turn a block without pushing it count as well") {
  scarp::SerialExecutor serial;
  auto problem = ground_with_block(samples::elastic_soil(), serial);
  problem.set_load(1.0);
  auto const base = base_of_block(problem);
  REQUIRE(base.size() == 5);
  Eigen::VectorXd unbalanced = Eigen::VectorXd::Zero(problem.dof_count());
  unbalanced(2 * base.front() + 1) = 1.0;
  unbalanced(2 * base.back() + 1) = -1.0;
  // Analytic: couple 1 N x 4 m over the radius of the 14 nodes of a row of crossed triangles, two lines of five nodes
  // 0.5 m off the middle and four centres: squares of x sum up to 25, those of y to 2.5.
  double const radius = std::sqrt(27.5 / 14.0);
  CHECK(value_of(problem.residuals(unbalanced), "footing") == samples::Approx(4.0 / radius / (footing_weight / 1.5)));
}

TEST_CASE("a block that is not placed yet has nothing to be measured against") {
  scarp::SerialExecutor serial;
  auto problem = ground_with_block(samples::elastic_soil(), serial);
  problem.set_load(0.0);
  auto const parts = problem.residuals(unsupported(problem, 0.09));
  CHECK(value_of(parts, "footing") == 0.0);
}

TEST_CASE("a mesh of one region has one residual") {
  scarp::SerialExecutor serial;
  auto problem = samples::Block<scarp::LinearElastic<2>>::make(samples::elastic_soil(), serial);
  Eigen::VectorXd const unbalanced = Eigen::VectorXd::LinSpaced(problem.dof_count(), -1.0, 2.0);
  auto const parts = problem.residuals(unbalanced);
  REQUIRE(parts.size() == 1);
  CHECK(parts.front().name == "all");
  CHECK(parts.front().value == problem.residual(unbalanced));
}

TEST_CASE("a step is iterated until the light block is carried, and tells the residual of every part") {
  scarp::SerialExecutor serial;
  // Tells a tangent twice too stiff in shear, so that predictions are wrong.
  auto problem = ground_with_block(samples::Planning{}, serial);
  scarp::QuasiNewton<> const solver{.tolerance = 1e-3};
  scarp::LoadStepping const stepping{.first = 1.0, .max_displacement_gradient = 1.0};
  auto witness = samples::watch(problem);
  REQUIRE(stepping.settle(solver, problem, 0.0, witness).verdict == scarp::Verdict{});
  REQUIRE(stepping.run(solver, problem, 0.0, 1.0, witness).verdict == scarp::Verdict{});
  auto const& placed = witness.reports.back();
  CHECK(value_of(placed.parts, "all") < 1e-4);  // had done for the step long before
  CHECK(value_of(placed.parts, "footing") <= 1e-3);
  CHECK(placed.residual() == value_of(placed.parts, "footing"));
  // The vertical part of the imbalance of the block with its base.
  double carried = 0.0;
  auto const unbalanced = problem.evaluate_committed().unbalanced;
  for (int node = 0; node < problem.discretisation().node_count(); ++node)
    if (problem.discretisation().mesh().nodes[scarp::detail::index(node)].y() >= 4.0)
      carried += unbalanced(2 * node + 1);
  CHECK(std::abs(carried) <= 1e-3 * footing_weight);
}
