// SPDX-License-Identifier: BSL-1.0
#include "scarp/observe/distortion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/step_report.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using scarp::Vector;

auto unit_squares() {
  return scarp::Discretisation<scarp::Quad4, scarp::UpdatedLagrangian>(
      scarp::BoxMesh<scarp::Quad4>{.lengths = {2.0, 1.0}, .cells = {2, 1}}.generate());
}

/// A grid alone, as an observer sees it.
struct Ground {
  decltype(unit_squares()) elements = unit_squares();
  scarp::Grid<2> const& grid() const { return elements; }
};

/// Simple shear of all of it.
template <class Grid>
void shear(Grid& grid, double by) {
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(grid.dof_count());
  for (int node = 0; node < grid.node_count(); ++node)
    increment(2 * node) = by * grid.mesh().nodes[static_cast<std::size_t>(node)].y();
  grid.commit(increment);
}

}  // namespace

TEST_CASE_TEMPLATE("elements of a regular mesh have the mean ratio of their linear ones", Element, scarp::Tri6,
                   scarp::Quad8) {
  using Linear = typename Element::Linear;
  auto const ratio_of = []<class Cell>(scarp::BoxMesh<Cell> const& mesh) {
    scarp::Discretisation<Cell, scarp::UpdatedLagrangian> const grid(mesh.generate());
    return scarp::largest_distortion(grid).mean_ratio;
  };
  CHECK(ratio_of(scarp::BoxMesh<Element>{.cells = {2, 2}}) ==
        Approx(ratio_of(scarp::BoxMesh<Linear>{.cells = {2, 2}})).epsilon(1e-12));
}

TEST_CASE("distortion follows the simple shear of a block, and is told once for each halving") {
  Ground ground;
  std::vector<double> told;
  scarp::DistortionWarning<2> warning([&](scarp::Distortion<2> const& worst) { told.push_back(worst.shear); });
  double sheared = 0.0;
  for (double const more : {1.0, 1.5, 0.5, 0.1, 2.0}) {
    shear(ground.elements, more);
    sheared += more;
    auto const worst = scarp::largest_distortion(ground.elements);
    // Analytic: det F = 1, |F|^2 = 2 + shear^2.
    CHECK(worst.mean_ratio == Approx(2.0 / (2.0 + sheared * sheared)).epsilon(1e-12));
    CHECK(worst.shear == Approx(sheared).epsilon(1e-12));
    auto const before = told.size();
    warning.attempted(ground, scarp::StepReport{.verdict = {scarp::Status::failed, scarp::Reason::not_finite}});
    CHECK(told.size() == before);
    warning.attempted(ground, scarp::StepReport{});
  }
  // Below 0.2 at 3.0 (0.18), not again at 3.1, below half of it at 5.1.
  REQUIRE(told.size() == 2);
  CHECK(told[0] == Approx(3.0).epsilon(1e-12));
  CHECK(told[1] == Approx(5.1).epsilon(1e-12));
}

TEST_CASE("the most distorted element is found, with its place now") {
  auto grid = unit_squares();
  CHECK(scarp::largest_distortion(grid).mean_ratio == Approx(1.0).epsilon(1e-14));
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(grid.dof_count());
  for (int node = 0; node < grid.node_count(); ++node) {
    auto const& place = grid.mesh().nodes[static_cast<std::size_t>(node)];
    if (place.x() > 1.5) increment(2 * node + 1) = 0.8;  // the right side goes up
  }
  grid.commit(increment);
  auto const worst = scarp::largest_distortion(grid);
  auto const& nodes = grid.mesh().elements[static_cast<std::size_t>(worst.element)];
  CHECK(std::any_of(nodes.begin(), nodes.end(), [&](int node) { return increment(2 * node + 1) > 0.0; }));
  CHECK(worst.mean_ratio == Approx(2.0 / (2.0 + 0.8 * 0.8)).epsilon(1e-12));  // analytic: simple shear
  CHECK((worst.place - Vector<2>(1.5, 0.9)).norm() < 1e-12);
}

TEST_CASE("elements of other regions do not count where one is named") {
  auto mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = {2.0, 1.0}, .cells = {2, 1}}.generate();
  mesh.regions.push_back("thin");
  mesh.element_region.back() = static_cast<int>(mesh.regions.size()) - 1;
  for (auto& node : mesh.nodes) node.x() = node.x() > 1.5 ? 1.1 : node.x();  // the right one: 0.1 by 1
  Ground ground{decltype(unit_squares())(std::move(mesh))};
  auto const soil = ground.elements.regions().front();
  CHECK(scarp::largest_distortion(ground.elements).mean_ratio < 0.2);
  CHECK(scarp::largest_distortion(ground.elements, soil).mean_ratio == Approx(1.0).epsilon(1e-12));
  CHECK_REFUSED(scarp::largest_distortion(ground.elements, "water"), "water");
  int told = 0;
  scarp::DistortionWarning<2> warning([&](auto const& worst) { told += worst.element == 0 ? 1 : 100; }, 0.2, soil);
  warning.attempted(ground, scarp::StepReport{});
  CHECK(told == 0);
  shear(ground.elements, 3.0);
  warning.attempted(ground, scarp::StepReport{});
  CHECK(told == 1);
}

TEST_CASE("a limit that is no ratio is refused") {
  CHECK(samples::message_of([] { scarp::DistortionWarning<2>([](auto const&) {}, -0.1); }) ==
        samples::Naming{"mean ratio that is warned of", "-0.1"});
}
