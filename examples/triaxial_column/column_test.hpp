// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "specimen.hpp"

namespace triaxial_column {

struct ColumnResult {
  std::vector<Row> rows;
  scarp::RunReport run;
  int elements = 0;
  int points = 0;
};

/// Keeps a row of every accepted step.
struct Watch {
  std::vector<Row>& rows;

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (report.verdict.acceptable()) rows.push_back(row(problem, report.load));
  }
  bool wants_stop() const { return false; }

  /// shortening: over the initial height
  template <class Problem>
  static Row row(Problem const& problem, double shortening) {
    auto const& grid = problem.discretisation();
    auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
    auto const stresses = problem.committed_stresses();
    double volume = 0.0;
    double axial = 0.0;
    for (std::size_t k = 0; k < volumes.size(); ++k) {
      volume += volumes[k];
      axial -= volumes[k] * stresses[k](2);
    }
    axial /= volume;
    double spread = 0.0;
    for (auto const& stress : stresses) spread = std::max(spread, std::abs(-stress(2) / axial - 1.0));
    return {-std::log1p(-shortening), axial, -std::log(volume / 2.0), spread};
  }
};

/// A column of 1 m x 1 m x 2 m between smooth platens, the upper one pushed down; its sides carry the confining
/// pressure as a dead load. Two nodes of the base keep it from drifting and turning.
template <class Element>
ColumnResult column_test(Packing const& packing, Choice const& choice) {
  using Grid = scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::FullIntegration>;
  scarp::Vector<3> const lengths(1.0, 1.0, 2.0);
  Grid grid(scarp::BoxMesh<Element>{.lengths = lengths, .cells = {1, 1, 2}}.generate());
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) {
    constraints.fix(node, 2);
    auto const& place = mesh.nodes[static_cast<std::size_t>(node)];
    if (place.isZero(0.0)) constraints.fix(node, 0);
    if (place.isZero(0.0) || place == scarp::Vector<3>::UnitX()) constraints.fix(node, 1);
  }
  for (int const node : scarp::boundary_nodes(mesh, "top")) constraints.move(node, 2, -lengths.z());
  Eigen::VectorXd confining = Eigen::VectorXd::Zero(grid.dof_count());
  scarp::Vector<3> const along_x(choice.pressure, 0.0, 0.0);
  scarp::Vector<3> const along_y(0.0, choice.pressure, 0.0);
  confining += grid.traction("left", along_x) + grid.traction("right", scarp::Vector<3>(-along_x));
  confining += grid.traction("front", along_y) + grid.traction("back", scarp::Vector<3>(-along_y));
  std::vector<scarp::Site<3>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, lengths.z()));
  ColumnResult result{{}, {}, static_cast<int>(mesh.elements.size()), grid.point_count()};

  Sand const sand{.law = contact_law(), .source = {packing}};
  scarp::ThreadExecutor executor;
  scarp::EquilibriumProblem<Grid> problem(std::move(grid), {sand, sites}, std::move(constraints), std::move(confining),
                                          executor);
  result.rows.push_back(Watch::row(problem, 0.0));
  Watch watch{result.rows};
  scarp::QuasiNewton<> const solver{.tolerance = choice.tolerance};
  scarp::LoadStepping const stepping{.first = choice.load_step / 4.0, .largest = choice.load_step};
  result.run = stepping.run(solver, problem, 0.0, choice.strain, watch);
  return result;
}

}  // namespace triaxial_column
