// SPDX-License-Identifier: BSL-1.0
// Elements that lock or not, slivers, and elements that turn inside out.
#include <fmt/format.h>

#include "../../examples/cook_membrane/membrane.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/linear_system.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "stability/stability_case.hpp"
#include "support/crossed_rectangle.hpp"

namespace stability {

namespace {

using scarp::Vector;
using Soil = scarp::LinearElastic<2>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Deflection of Cook's panel with one element over that with reduced Quad8, which does not lock, on as many cells.
template <class Element, class Scheme>
Outcome cook(double poisson, bool should_lock, Size size) {
  int const cells = size == Size::quick ? 8 : 32;
  cook_membrane::Panel const panel{.poisson = poisson};
  double const reference = cook_membrane::solve<scarp::Quad8, scarp::ReducedIntegration>(2 * cells, panel).deflection;
  double const share = cook_membrane::solve<Element, Scheme>(cells, panel).deflection / reference;
  bool const locks = share < 0.7;
  return {std::isfinite(share) && locks == should_lock && share < 1.05, share, "deflection over the reference",
          locks ? "locks" : "does not lock"};
}

/// Deflection of a cantilever of crossed triangles, as the fault scene's ground has, over that of reduced Quad8 on as
/// many cells: two of the four volume changes of a rectangle depend on the others, so that it does not lock.
Outcome crossed(double poisson) {
  auto const deflection = [&]<class Element, class Scheme>(scarp::Mesh<Element> const& mesh, Scheme const&) {
    scarp::Discretisation<Element, scarp::SmallStrain, Scheme> const grid(mesh);
    scarp::Constraints constraints(mesh);
    for (int const node : boundary_nodes(mesh, "left")) constraints.fix(node);
    Eigen::VectorXd const moved =
        examples::elastic_solve(grid, Soil::from_young_poisson(1.0, poisson), constraints,
                                Eigen::VectorXd::Zero(grid.dof_count()), grid.traction("right", Vector<2>(0.0, 1e-3)));
    double sum = 0.0;
    for (int const node : boundary_nodes(mesh, "right")) sum += moved(2 * node + 1);
    return sum / static_cast<double>(boundary_nodes(mesh, "right").size());
  };
  double const triangles = deflection(samples::CrossedRectangle{.width = 4.0, .columns = 32, .rows = 8}.generate(),
                                      scarp::FullIntegration{});
  double const reference = deflection(scarp::BoxMesh<scarp::Quad8>{.lengths = {4.0, 1.0}, .cells = {32, 8}}.generate(),
                                      scarp::ReducedIntegration{});
  double const share = triangles / reference;
  return {share > 0.7 && share < 1.05, share, "deflection over the reference"};
}

/// Interior nodes of a patch whose outline moves affinely, solved for on elements as bad as they get.
template <class Element>
Outcome patch(scarp::Mesh<Element> mesh) {
  scarp::Discretisation<Element, scarp::SmallStrain> const grid(mesh);
  auto const solid = Soil::from_young_poisson(25e6, 0.25);
  scarp::Constraints constraints(mesh);
  Eigen::VectorXd exact(grid.dof_count());
  for (int n = 0; n < grid.node_count(); ++n) {
    auto const& place = mesh.nodes[static_cast<std::size_t>(n)];
    exact.segment<2>(2 * n) = 1e-3 * Vector<2>(place.x() + 0.3 * place.y(), 0.2 * place.x() - 0.5 * place.y());
  }
  for (auto const* side : {"left", "right", "bottom", "top"}) {
    for (int const node : boundary_nodes(mesh, side)) {
      if (!constraints.is_prescribed(2 * node)) constraints.fix(node);
    }
  }
  std::vector<scarp::VoigtStress<2>> const unstressed(static_cast<std::size_t>(grid.point_count()),
                                                      scarp::VoigtStress<2>::Zero());
  std::vector<scarp::VoigtTangent<2>> const tangents(unstressed.size(), solid.tangent({}));
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(grid.dof_count());
  Eigen::SparseMatrix<double> const stiffness = grid.stiffness(nothing, unstressed, tangents);
  scarp::LinearSystem system(constraints);
  if (!system.factorize({stiffness}).acceptable()) return {false, infinity, "no factorisation", ""};
  Eigen::VectorXd held = exact;
  system.scatter(Eigen::VectorXd::Zero(constraints.free_count()), held);
  Eigen::VectorXd found = held;
  system.scatter(system.solve(system.gather(-(stiffness * held))), found);
  double const condition = system.condition();
  double const error = (found - exact).norm() / exact.norm();
  return at_most(1e-15 * condition + 1e-14, error, "error of the displacement, up to 1e-15 of the condition",
                 fmt::format("condition {:.1e}", condition));
}

/// Sides at an angle to the base, so that all elements are slanted.
template <class Element>
scarp::Mesh<Element> slanted(double degrees, double aspect) {
  double const slope = 1.0 / std::tan(degrees * std::numbers::pi / 180.0);
  return scarp::BoxMesh<Element>{
      .cells = {4, 4},
      .map = [=](Vector<2> const& box) { return Vector<2>(aspect * box.x() + slope * box.y(), box.y()); }}
      .generate();
}

/// A block of crossed triangles that is pressed to nothing and beyond.
struct Pressed {
  using Grid = scarp::Discretisation<scarp::Tri3>;
  using Problem = scarp::EquilibriumProblem<Grid>;

  static Problem make(scarp::SerialExecutor& executor) {
    Grid grid(samples::CrossedRectangle{.columns = 2, .rows = 2}.generate());
    scarp::Constraints constraints(grid.mesh());
    for (int const node : boundary_nodes(grid.mesh(), "bottom")) constraints.fix(node);
    for (int const node : boundary_nodes(grid.mesh(), "top")) {
      constraints.fix(node, 0);
      constraints.move(node, 1, -1.0);
    }
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, 1.0));
    Eigen::VectorXd const loads = Eigen::VectorXd::Zero(grid.dof_count());
    return {std::move(grid), {Soil::from_young_poisson(25e6, 0.3), sites}, std::move(constraints), loads, executor};
  }
};

/// Records why attempts were rejected.
struct Rejections {
  int attempts = 0;
  int inverted = 0;
  int named = 0;  ///< with the point of the element

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    ++attempts;
    if (report.verdict.reason != scarp::Reason::element_inverted) return;
    ++inverted;
    named += report.worst_point >= 0 && report.worst_point < problem.points().size() ? 1 : 0;
  }
  bool wants_stop() const { return attempts > 2000; }
};

/// Pressed by 120 % of its height, at once or by steps: ends before it is flat, with the reason and a whole block.
Outcome pressed_flat(double first) {
  scarp::SerialExecutor executor;
  auto problem = Pressed::make(executor);
  scarp::LoadStepping const stepping{.first = first, .smallest = 1e-4, .max_displacement_gradient = 10.0};
  Rejections rejections;
  auto const run = stepping.run(scarp::QuasiNewton<>{.tolerance = 1e-6}, problem, 0.0, 1.2, rejections);
  double smallest = infinity;
  auto const volumes = problem.discretisation().volumes(Eigen::VectorXd::Zero(problem.dof_count()));
  for (double const volume : volumes) smallest = std::min(smallest, volume);
  double height = 0.0;
  for (auto const& place : problem.discretisation().positions()) height = std::max(height, place.y());
  Worst worst;
  worst.see(height - (1.0 - run.load));
  bool const named = run.verdict == scarp::Verdict{scarp::Status::not_converged, scarp::Reason::step_too_small} &&
                     rejections.inverted > 0 && run.load < 1.0 && smallest > 0.0 &&
                     rejections.named == rejections.inverted && rejections.attempts <= 2000;
  return {named && worst.value < 1e-12, worst.value, "height of the committed block less that of the load",
          fmt::format("{} ({}) at {:.4f}, element {}, {} attempts, {} inverted of which {} name the element",
                      name(run.verdict.reason), name(run.last_failure), run.load, run.worst_point, rejections.attempts,
                      rejections.inverted, rejections.named)};
}

}  // namespace

Cases mesh_cases() {
  Cases cases;
  auto const add = [&](std::string name, std::string expected, auto run) {
    cases.push_back({"meshes and elements", std::move(name), std::move(expected), std::move(run)});
  };
  using scarp::FullIntegration;
  for (double const poisson : {0.49, 0.499, 0.4999, 0.49999, 0.499999}) {
    bool const nearly = poisson > 0.4995;
    if (nearly) {
      add(fmt::format("Cook's panel, Quad4, nu = {}", poisson), "locks",
          [=](Size size) { return cook<scarp::Quad4, FullIntegration>(poisson, true, size); });
      add(fmt::format("Cook's panel, Tri3, nu = {}", poisson), "locks",
          [=](Size size) { return cook<scarp::Tri3, FullIntegration>(poisson, true, size); });
    }
    add(fmt::format("Cook's panel, Quad4 B-bar, nu = {}", poisson), "does not lock",
        [=](Size size) { return cook<scarp::Quad4, scarp::BBar>(poisson, false, size); });
    add(fmt::format("beam of crossed Tri3, nu = {}", poisson), "does not lock", [=](Size) { return crossed(poisson); });
  }
  for (double const degrees : {5.0, 1.0}) {
    add(fmt::format("patch of Tri3 with angles of {:g} degrees", degrees), "exact to round-off",
        [=](Size) { return patch(slanted<scarp::Tri3>(degrees, 1.0)); });
    add(fmt::format("patch of Quad4 with angles of {:g} degrees", degrees), "exact to round-off",
        [=](Size) { return patch(slanted<scarp::Quad4>(degrees, 1.0)); });
  }
  add("patch of Tri3, aspect 100", "exact to round-off", [](Size) { return patch(slanted<scarp::Tri3>(90.0, 100.0)); });
  add("patch of Quad4, aspect 100", "exact to round-off",
      [](Size) { return patch(slanted<scarp::Quad4>(90.0, 100.0)); });
  add("patch of Tri3, aspect 1e6", "exact to round-off", [](Size) { return patch(slanted<scarp::Tri3>(90.0, 1e6)); });
  std::string const stops = "step_too_small, the element named, the last state whole";
  add("pressed flat and beyond, first step 1.2", stops, [](Size) { return pressed_flat(1.2); });
  add("pressed flat and beyond, first step 0.1", stops, [](Size) { return pressed_flat(0.1); });
  return cases;
}

}  // namespace stability
