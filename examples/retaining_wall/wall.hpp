// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "rankine.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/make_problem.hpp"

namespace retaining_wall {

using Grid = scarp::Discretisation<scarp::Quad4, scarp::UpdatedLagrangian, scarp::BBar>;

/// Ground between a smooth rigid wall on the left, which moves without turning, and rollers on the right, on a smooth
/// base: the whole of it yields, as Rankine has it. The load factor is the wall's displacement over the ground's
/// length.
struct Wall {
  double height = 4.0;           ///< [m]
  double length = 10.0;          ///< of the ground [m]; a passive wedge of phi = 45 degrees ends at 9.7 m
  double size = 1.0;             ///< of the cells [m]
  double unit_weight = 15.68e3;  ///< [N/m3]
  double surcharge = 4e3;        ///< [Pa]

  double overburden(double depth) const { return surcharge + unit_weight * depth; }

  /// \throws InputError for cells that do not fit in
  Grid grid() const {
    auto const cells = [&](double side) {
      double const count = std::round(side / size);
      if (std::abs(count * size - side) > 1e-9 * side)
        scarp::reject("cells of {} m do not fill {} m (they are square and alike): take 0.5, 1 or 2", size, side);
      return static_cast<int>(count);
    };
    return Grid(scarp::BoxMesh<scarp::Quad4>{.lengths = scarp::Vector<2>(length, height),
                                             .cells = {cells(length), cells(height)}}
                    .generate());
  }

  std::vector<double> depths() const {
    Grid const ground = grid();
    std::vector<double> found;
    for (int point = 0; point < ground.point_count(); ++point) found.push_back(ground.site(point, height).depth);
    return found;
  }

  template <scarp::ConstitutiveProvider Soil>
  auto problem(Soil const& soil, Movement movement, scarp::Executor& executor) const {
    Grid ground = grid();
    scarp::Constraints constraints(ground.mesh());
    for (int const node : boundary_nodes(ground.mesh(), "left")) constraints.move(node, 0, sign_of(movement) * length);
    for (int const node : boundary_nodes(ground.mesh(), "right")) constraints.fix(node, 0);
    for (int const node : boundary_nodes(ground.mesh(), "bottom")) constraints.fix(node, 1);
    scarp::Vector<2> const weight(0.0, -unit_weight);
    Eigen::VectorXd const dead =
        ground.body_force([&](int) { return weight; }) + ground.traction("top", scarp::Vector<2>(0.0, -surcharge));
    auto const regions = boost::hana::make_tuple(scarp::Region{"soil", soil});
    return make_problem(std::move(ground), height, regions, std::move(constraints), scarp::LoadHistory(dead), executor);
  }
};

/// Forces per metre of wall [N/m].
struct Pressed {
  double force = 0.0;       ///< on the wall
  double far_force = 0.0;   ///< on the rollers, which the base's smoothness makes equal
  double overburden = 0.0;  ///< integral of the vertical stress over the wall's present height
};

/// Weight and surcharge stay with the ground: where it gets shorter they press more on each metre.
template <class Problem>
Pressed pressed(Problem const& problem, Wall const& wall) {
  Grid const& ground = problem.discretisation();
  auto const& mesh = ground.mesh();
  Eigen::VectorXd forces;
  ground.internal_force(Eigen::VectorXd::Zero(ground.dof_count()), problem.committed_stresses(), forces);
  Pressed found;
  for (int const node : boundary_nodes(mesh, "right")) found.far_force -= forces(2 * node);
  std::vector<std::array<double, 2>> places;  // initial and present heights, from the toe up
  double at = 0.0;
  for (int const node : boundary_nodes(mesh, "left")) {
    auto const k = static_cast<std::size_t>(node);
    found.force += forces(2 * node);
    places.push_back({mesh.nodes[k].y(), ground.positions()[k].y()});
    at = ground.positions()[k].x();
  }
  std::sort(places.begin(), places.end());
  for (std::size_t k = 1; k < places.size(); ++k) {
    double const middle = (places[k - 1][0] + places[k][0]) / 2.0;
    found.overburden += wall.overburden(wall.height - middle) * (places[k][1] - places[k - 1][1]);
  }
  found.overburden *= wall.length / (wall.length - at);
  return found;
}

}  // namespace retaining_wall
