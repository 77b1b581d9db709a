// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "scarp/bvp/discretisation.hpp"

namespace earth_pressure {

/// A vertical cut of height 1 m in clay, the toe at the origin; the ground gets heavier until it falls.
struct VerticalCut {
  double cohesion = 1.0;  ///< [Pa]

  /// \f$ \gamma H/c \f$ has no closed form; static and kinematic bounds from the literature enclose it between 3.7752
  /// and 3.7776 (no source at hand to cite). A triangle sliding on 45 degrees gives 4.
  static constexpr double stability_number = 3.776;
};

/// A mesh without the elements whose centre lies in front of the cut.
template <class Element>
scarp::Mesh<Element> without_front(scarp::Mesh<Element> const& whole) {
  scarp::Mesh<Element> part{{}, {}, {}, whole.regions, {}};
  std::vector<int> number(whole.nodes.size(), -1);
  auto const renumbered = [&](auto nodes) {
    for (int& node : nodes) node = number[static_cast<std::size_t>(node)];
    return nodes;
  };
  for (auto const& element : whole.elements) {
    scarp::Vector<2> centre = scarp::Vector<2>::Zero();
    for (int const node : element) centre += whole.nodes[static_cast<std::size_t>(node)] / Element::nodes;
    if (centre.x() < 0.0 && centre.y() > 0.0) continue;
    for (int const node : element) {
      auto& known = number[static_cast<std::size_t>(node)];
      if (known >= 0) continue;
      known = static_cast<int>(part.nodes.size());
      part.nodes.push_back(whole.nodes[static_cast<std::size_t>(node)]);
    }
    part.elements.push_back(renumbered(element));
    part.element_region.push_back(0);
  }
  for (auto const& [name, facets] : whole.boundaries) {
    for (auto const& facet : facets) {
      auto const kept = renumbered(facet);
      if (std::none_of(kept.begin(), kept.end(), [](int node) { return node < 0; })) {
        part.boundaries[name].push_back(kept);
      }
    }
  }
  return part;
}

/// Cells of 0.04 m at the toe on the coarsest mesh, growing by half of the distance; halved by each refinement.
template <class Element>
scarp::Mesh<Element> cut_mesh(int refinements) {
  auto const size = [&](double distance) { return (0.04 + 0.5 * std::min(distance, 0.4)) / std::exp2(refinements); };
  scarp::Spacing const along(
      {{-1.0, size(1.0)}, {-0.4, size(0.4)}, {0.0, size(0.0)}, {0.4, size(0.4)}, {2.5, size(1.0)}});
  scarp::Spacing const up({{-0.8, size(1.0)}, {-0.4, size(0.4)}, {0.0, size(0.0)}, {0.4, size(0.4)}, {1.0, size(1.0)}});
  return without_front(
      examples::mesh_of_lines<Element>(graded_lines(along, {-1.0, 0.0, 2.5}), graded_lines(up, {-0.8, 0.0, 1.0})));
}

/// The last \f$ \gamma H/c \f$ with equilibrium.
template <class Element, class Scheme>
examples::Outcome load_cut(VerticalCut const& cut, int refinements) {
  examples::Stopwatch const watch;
  using Clay = scarp::MohrCoulomb<2>;
  Clay const clay{.elasticity = scarp::IsotropicElasticity::from_young_poisson(1e6 * cut.cohesion, 0.3),
                  .strength = {{.cohesion = cut.cohesion}}};
  examples::PlaneGrid<Element, Scheme> grid(cut_mesh<Element>(refinements));
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
  for (char const* side : {"left", "right"}) {
    for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 0);
  }
  scarp::Vector<2> const weight(0.0, -cut.cohesion);
  scarp::LoadHistory loads(Eigen::VectorXd::Zero(grid.dof_count()));
  loads.add(grid.body_force([&](int) { return weight; }), {});
  auto problem = examples::plane_problem(std::move(grid), clay, 1.0, constraints, loads);
  examples::Newton const newton{.tolerance = 1e-7, .max_iterations = 15, .rule = {.exact = {.floor = 1e-7}}};
  scarp::LoadStepping const stepping{.first = 1.0, .smallest = 2e-3, .largest = 0.4, .max_displacement_gradient = 1.0};
  scarp::NoObserver no_observer;
  auto const run = stepping.run(newton, problem, 0.0, 8.0, no_observer);
  auto const& done = problem.discretisation();
  return {static_cast<int>(done.mesh().elements.size()), done.dof_count(), run.load, run, watch.seconds()};
}

}  // namespace earth_pressure
