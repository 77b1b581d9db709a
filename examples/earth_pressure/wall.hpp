// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "scarp/bvp/discretisation.hpp"

namespace earth_pressure {

/// A smooth wall of height H, moved from or towards level ground; the ground is 3 H long.
struct Wall {
  double height = 5.0;        ///< [m]
  double unit_weight = 18e3;  ///< [N/m3]
  double cohesion = 0.0;      ///< [Pa]
  double friction = examples::radians(30.0);
  bool passive = false;
  bool rough_base = false;
  double young = 1e9;  ///< [Pa]

  /// Rankine: \f$ E = K\gamma H^2/2 \mp 2 c \sqrt K H,\; K = \tan^2(45° \mp \varphi/2) \f$ [N/m]; tension is not cut
  /// off.
  double force() const {
    double const sign = passive ? 1.0 : -1.0;
    double const root = std::tan(std::numbers::pi / 4.0 + sign * friction / 2.0);
    return root * root * unit_weight * height * height / 2.0 + sign * 2.0 * cohesion * root * height;
  }
  double at_rest() const { return 1.0 - std::sin(friction); }
};

/// Force [N/m] on the wall once it moves on without change.
/// cells: along the height
template <class Element, class Scheme>
examples::Outcome move_wall(Wall const& wall, int cells) {
  examples::Stopwatch const watch;
  using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  Soil const soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(wall.young, 0.3),
                  .strength = {{wall.cohesion, wall.friction, wall.friction}},
                  .initial = {.unit_weight = wall.unit_weight, .k0 = wall.at_rest()}};
  double const length = 3.0 * wall.height;
  scarp::BoxMesh<Element> box{.lengths = scarp::Vector<2>(length, wall.height), .cells = {2 * cells, cells}};
  if (wall.rough_base) {  // small cells at the toe, where the wall moves and the base does not
    box.map = [=](scarp::Vector<2> const& at) {
      return scarp::Vector<2>(at.x() * at.x() / length, at.y() * at.y() / wall.height);
    };
  }
  examples::PlaneGrid<Element, Scheme> grid(box.generate());
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  // A strain of twice what an unconfined specimen of the base's vertical stress needs to fail.
  double const strain = (wall.passive ? 8.0 : 2.0) * wall.unit_weight * wall.height / wall.young;
  auto const at_wall = boundary_nodes(mesh, "left");
  for (int const node : at_wall) constraints.move(node, 0, (wall.passive ? 1.0 : -1.0) * strain * length);
  for (int const node : boundary_nodes(mesh, "right")) constraints.fix(node, 0);
  auto const corner = *std::min_element(at_wall.begin(), at_wall.end(), [&](int a, int b) {
    return mesh.nodes[static_cast<std::size_t>(a)].y() < mesh.nodes[static_cast<std::size_t>(b)].y();
  });
  for (int const node : boundary_nodes(mesh, "bottom")) {
    constraints.fix(node, 1);
    if (wall.rough_base && node != corner && !constraints.is_prescribed(2 * node)) constraints.fix(node, 0);
  }
  scarp::Vector<2> const weight(0.0, -wall.unit_weight);
  Eigen::VectorXd const loads = grid.body_force([&](int) { return weight; });
  auto problem = examples::plane_problem(std::move(grid), soil, wall.height, constraints, scarp::LoadHistory(loads));
  examples::Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-8}}};
  scarp::LoadStepping const stepping{.first = 0.05, .smallest = 1e-6, .largest = 0.2, .max_displacement_gradient = 1e3};
  scarp::NoObserver no_observer;
  auto const run = stepping.run(newton, problem, 0.0, 1.0, no_observer);
  auto const& done = problem.discretisation();
  return {static_cast<int>(done.mesh().elements.size()), done.dof_count(),
          examples::support_force(problem, at_wall, 0, loads), run, watch.seconds()};
}

}  // namespace earth_pressure
