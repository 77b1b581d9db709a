// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/element/quad4.hpp"

namespace rigid_on_elastic {

using Soil = scarp::LinearElastic<2>;
using Bonded = scarp::CohesiveBond<scarp::LinearFrictional>;
using Grid = examples::PlaneGrid<scarp::Quad4, scarp::FullIntegration>;

/// Springs that neither open nor slide. stiffness [Pa/m]
inline Bonded bonded(double stiffness) {
  constexpr double never = std::numeric_limits<double>::infinity();
  return {{.normal_stiffness = stiffness, .tangential_stiffness = stiffness, .friction = 0.0}, never, never};
}

/// Response of a footing to its loads.
struct Motion {
  double settlement = 0.0;  ///< [m]
  double tilt = 0.0;        ///< [rad], counter-clockwise
  examples::Outcome outcome{};
};

/// A footing of 2 m in the middle of an elastic layer of 6 m x 2 m on a rough base between smooth sides.
struct Layer {
  double width = 2.0;   ///< of the footing [m]
  double young = 20e6;  ///< [Pa]
  double poisson = 0.3;
  double force = 20e3;  ///< downwards [N/m]
  double moment = 4e3;  ///< counter-clockwise [N]
  int cells = 8;        ///< below the footing; the cells are square
  bool rigid = false;   ///< the ground does not move

  scarp::Mesh<scarp::Quad4> mesh() const {
    return scarp::BoxMesh<scarp::Quad4>{.lengths = scarp::Vector<2>(3.0 * width, width), .cells = {3 * cells, cells}}
        .generate();
  }
  scarp::Vector<2> centre() const { return {1.5 * width, width}; }

  void hold(scarp::Mesh<scarp::Quad4> const& mesh, scarp::Constraints& constraints) const {
    for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
    for (char const* side : {"left", "right"}) {
      for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 0);
    }
  }

  static std::vector<double> places(scarp::Mesh<scarp::Quad4> const& mesh, char const* boundary) {
    std::vector<double> x;
    for (int const node : boundary_nodes(mesh, boundary)) x.push_back(mesh.nodes[static_cast<std::size_t>(node)].x());
    return x;
  }
};

/// All load in one step. Stiffness times the round-off of places, up to 1e-7 of the loads here, bounds the tolerance
/// from below.
template <class Problem>
scarp::RunReport load_once(Problem& problem, double tolerance = 1e-6) {
  examples::Newton const newton{.tolerance = tolerance, .divergence_limit = 1e9};
  scarp::LoadStepping const stepping{.first = 1.0, .smallest = 1e-3, .max_displacement_gradient = 1e3};
  scarp::NoObserver no_observer;
  return stepping.run(newton, problem, 0.0, 1.0, no_observer);
}

/// A rigid footing on an interface.
/// sliding: may the footing move sideways?
template <class Law>
Motion rigid_footing(Layer const& layer, Law const& law, bool sliding) {
  examples::Stopwatch const watch;
  Grid grid(layer.mesh());
  auto const ground = grid.mesh();
  scarp::Constraints constraints(ground, scarp::RigidBody::extra_dofs);
  if (layer.rigid) {
    for (int node = 0; node < grid.node_count(); ++node) constraints.fix(node);
  } else {
    layer.hold(ground, constraints);
  }
  if (!sliding) constraints.move_extra(0, 0.0);
  double const arm = layer.width / 2.0;
  scarp::Vector<2> const half = arm * scarp::Vector<2>::UnitX();
  scarp::RigidFooting const footing({layer.centre(), arm}, layer.centre() - half, layer.centre() + half,
                                    Layer::places(ground, "top"), 1.0, grid.dof_count());
  scarp::Interface interface(law, footing, scarp::FacetChain(boundary(ground, "top")), ground.nodes);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(constraints.dof_count());
  load.tail<3>() << 0.0, -layer.force, layer.moment / arm;
  scarp::LoadHistory loads(Eigen::VectorXd::Zero(load.size()));
  loads.add(load, {});
  auto problem = examples::plane_problem(std::move(grid), Soil::from_young_poisson(layer.young, layer.poisson),
                                         layer.width, constraints, loads, std::move(interface));
  auto const run = load_once(problem);
  auto const& body = problem.template attached<decltype(interface)>().body().body();
  return {layer.centre().y() - body.reference().y(),
          body.rotation(),
          {static_cast<int>(ground.elements.size()), constraints.dof_count(), 0.0, run, watch.seconds()}};
}

/// Nodes below the footing that move as a rigid body which does not go sideways, by their reactions.
inline Motion tied_nodes(Layer const& layer) {
  examples::Stopwatch const watch;
  auto const stiffness = [&](bool turned) {
    Grid grid(layer.mesh());
    auto const ground = grid.mesh();
    scarp::Constraints constraints(ground);
    layer.hold(ground, constraints);
    double const unit = 5e-4;  // about what the loads bring: the strain measure's square is the same
    std::vector<std::pair<int, double>> base;
    for (int const node : boundary_nodes(ground, "top")) {
      double const arm = ground.nodes[static_cast<std::size_t>(node)].x() - layer.centre().x();
      if (std::abs(arm) > layer.width / 2.0 * (1.0 + 1e-9)) continue;
      constraints.fix(node, 0);
      constraints.move(node, 1, turned ? unit * arm : -unit);
      base.emplace_back(node, turned ? arm : -1.0);
    }
    Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(grid.dof_count());
    auto problem = examples::plane_problem(std::move(grid), Soil::from_young_poisson(layer.young, layer.poisson),
                                           layer.width, constraints, scarp::LoadHistory(nothing));
    if (!load_once(problem).verdict.acceptable()) return std::nan("");
    Eigen::VectorXd forces;
    problem.discretisation().internal_force(nothing, problem.committed_stresses(), forces);
    double sum = 0.0;
    for (auto const& [node, lever] : base) sum += forces(2 * node + 1) * lever;
    return sum / unit;
  };
  return {layer.force / stiffness(false), layer.moment / stiffness(true), {.seconds = watch.seconds()}};
}

}  // namespace rigid_on_elastic
