// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/mesh/graded_lines.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace examples {

using Newton = scarp::QuasiNewton<>;

template <class Element, class Scheme>
using PlaneGrid = scarp::Discretisation<Element, scarp::SmallStrain, Scheme>;

/// A body of one material in small strain.
template <class Element, class Scheme>
using PlaneProblem = scarp::EquilibriumProblem<PlaneGrid<Element, Scheme>>;

inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// surface_level [m]: height from which depths are measured
template <class Element, class Scheme, class Provider, class Attached = scarp::NoAttachment>
PlaneProblem<Element, Scheme> plane_problem(PlaneGrid<Element, Scheme> grid, Provider const& provider,
                                            double surface_level, scarp::Constraints constraints,
                                            scarp::LoadHistory loads, Attached attached = {}) {
  static scarp::SerialExecutor executor;
  std::vector<scarp::Site<2>> sites;
  for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, surface_level));
  scarp::MaterialPoints<2> points(provider, sites);
  return {std::move(grid), std::move(points), std::move(constraints), std::move(loads), executor, std::move(attached)};
}

/// A rectangle with grid lines at the given places [m], increasing.
template <class Element>
scarp::Mesh<Element> mesh_of_lines(std::vector<double> const& x, std::vector<double> const& y) {
  auto const between = [](std::vector<double> const& lines, double cells) {
    auto const k = std::min(static_cast<std::size_t>(cells), lines.size() - 2);
    return lines[k] + (cells - static_cast<double>(k)) * (lines[k + 1] - lines[k]);
  };
  std::array const cells{static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1};
  return scarp::BoxMesh<Element>{
      .lengths = scarp::Vector<2>(cells[0], cells[1]),
      .cells = cells,
      .map = [&](scarp::Vector<2> const& box) { return scarp::Vector<2>(between(x, box.x()), between(y, box.y())); }}
      .generate();
}

/// Moves the facets of a boundary that lie left of a place [m] to a boundary of their own.
template <class Element>
void split_boundary(scarp::Mesh<Element>& mesh, std::string const& from, std::string const& left, double place) {
  auto& facets = mesh.boundaries[from];
  auto const is_left = [&](auto const& facet) {
    return std::all_of(facet.begin(), facet.end(), [&](int node) {
      return mesh.nodes[static_cast<std::size_t>(node)].x() <= place * (1.0 + 1e-12);
    });
  };
  auto& chosen = mesh.boundaries[left];
  std::copy_if(facets.begin(), facets.end(), std::back_inserter(chosen), is_left);
  std::erase_if(facets, is_left);
}

/// Sum [N] of the forces that the committed state of a body needs at some nodes along an axis, beside the given loads.
template <class Problem>
double support_force(Problem const& problem, std::vector<int> const& nodes, int axis, Eigen::VectorXd const& loads) {
  Eigen::VectorXd forces;
  auto const stresses = problem.committed_stresses();
  auto const& grid = problem.discretisation();
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), stresses, forces);
  double sum = 0.0;
  for (int const node : nodes) sum += forces(2 * node + axis) - loads(2 * node + axis);
  return sum;
}

}  // namespace examples
