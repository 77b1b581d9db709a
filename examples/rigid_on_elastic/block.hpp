// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "bed.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/solver/make_problem.hpp"

namespace rigid_on_elastic {

/// The ground and, on top of its middle, a block with nodes of its own: regions "soil" and "block", boundaries of the
/// block "block_bottom", "block_top" and so on.
inline scarp::Mesh<scarp::Quad4> with_block(Layer const& layer, double height, int columns) {
  auto mesh = layer.mesh();
  int const rows = std::max(1, static_cast<int>(std::lround(columns * height / layer.width)));
  auto const block = scarp::BoxMesh<scarp::Quad4>{
      .lengths = scarp::Vector<2>(layer.width, height),
      .cells = {columns,
                rows}}.generate();
  int const offset = static_cast<int>(mesh.nodes.size());
  scarp::Vector<2> const corner = layer.centre() - layer.width / 2.0 * scarp::Vector<2>::UnitX();
  for (auto const& node : block.nodes) mesh.nodes.emplace_back(corner + node);
  auto const shifted = [&](auto numbers) {
    for (int& number : numbers) number += offset;
    return numbers;
  };
  mesh.regions.emplace_back("block");
  for (auto const& element : block.elements) {
    mesh.elements.push_back(shifted(element));
    mesh.element_region.push_back(1);
  }
  for (auto const& [name, facets] : block.boundaries) {
    for (auto const& facet : facets) mesh.boundaries["block_" + name].push_back(shifted(facet));
  }
  return mesh;
}

/// A block on an interface. Fixes the ground or parts of it, adds loads.
template <class Law, class Hold, class Loads>
auto block_problem(Layer const& layer, double contrast, double height, int columns, Law const& law, Hold const& hold,
                   Loads const& make_loads) {
  static scarp::SerialExecutor executor;
  Grid grid(with_block(layer, height, columns));
  auto const mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  hold(mesh, constraints);
  scarp::LoadHistory const loads = make_loads(grid);
  scarp::MeshedFooting const base(scarp::FacetChain(boundary(mesh, "block_bottom")), Layer::places(mesh, "top"),
                                  mesh.nodes, 1.0);
  scarp::Interface interface(law, base, scarp::FacetChain(boundary(mesh, "top")), mesh.nodes);
  auto const soil = Soil::from_young_poisson(layer.young, layer.poisson);
  auto const stiff = Soil::from_young_poisson(contrast * layer.young, layer.poisson);
  return scarp::make_problem(std::move(grid), layer.centre().y(),
                             boost::hana::make_tuple(scarp::Region{"soil", soil}, scarp::Region{"block", stiff}),
                             constraints, loads, executor, std::move(interface));
}

/// Settlement and tilt of a block's base, from its corners, under a force in the middle of its top and a couple at the
/// top's ends.
template <class Law>
Motion elastic_block(Layer const& layer, double contrast, Law const& law) {
  examples::Stopwatch const watch;
  auto problem = block_problem(
      layer, contrast, layer.width / 2.0, layer.cells, law,
      [&](auto const& mesh, auto& constraints) { layer.hold(mesh, constraints); },
      [&](Grid const& grid) {
        Eigen::VectorXd load = grid.traction("block_top", scarp::Vector<2>(0.0, -layer.force / layer.width));
        for (int const node : boundary_nodes(grid.mesh(), "block_top")) {
          double const arm = grid.mesh().nodes[static_cast<std::size_t>(node)].x() - layer.centre().x();
          if (std::abs(arm) > layer.width / 2.0 * (1.0 - 1e-9)) load(2 * node + 1) += layer.moment / (2.0 * arm);
        }
        scarp::LoadHistory loads(Eigen::VectorXd::Zero(load.size()));
        loads.add(load, {});
        return loads;
      });
  // Round-off of the strains times the block's stiffness, contrast times 1e-12 of the loads and growing with the mesh.
  auto const run = load_once(problem, 1e-5);
  auto const& grid = problem.discretisation();
  double left = 0.0;
  double right = 0.0;
  for (int const node : boundary_nodes(grid.mesh(), "block_bottom")) {
    auto const& start = grid.mesh().nodes[static_cast<std::size_t>(node)];
    double const rise = grid.positions()[static_cast<std::size_t>(node)].y() - start.y();
    if (start.x() < layer.centre().x() - layer.width / 2.0 * (1.0 - 1e-9)) left = rise;
    if (start.x() > layer.centre().x() + layer.width / 2.0 * (1.0 - 1e-9)) right = rise;
  }
  return {-(left + right) / 2.0,
          (right - left) / layer.width,
          {static_cast<int>(grid.mesh().elements.size()), grid.dof_count(), 0.0, run, watch.seconds()}};
}

/// Tangent of the tilt of gravity at which an elastic block slides down rigid ground.
inline examples::Outcome slide(double friction, int cells) {
  examples::Stopwatch const watch;
  Layer const layer{.cells = cells, .rigid = true};
  double const weight = 20e3;  // [N/m3]
  // Softer than the block: it bulges under its weight, and points that begin to slide there keep Newton from settling
  // it.
  double const springs = 10.0 * layer.young / layer.width;
  scarp::LinearFrictional const law{.normal_stiffness = springs, .tangential_stiffness = springs, .friction = friction};
  auto problem = block_problem(
      layer, 1.0, layer.width / 4.0, cells, law,
      [&](auto const& mesh, auto& constraints) {
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
          if (mesh.element_region[e] != 0) continue;
          for (int const node : mesh.elements[e]) constraints.fix(node);
        }
      },
      [&](Grid const& grid) {
        auto const of_block = [&](scarp::Vector<2> const& force) {
          return grid.body_force([=](int region) { return scarp::Vector<2>(region == 1 ? force : 0.0 * force); });
        };
        scarp::LoadHistory loads(of_block({0.0, -weight}));
        loads.add(of_block({weight, 0.0}), {});
        return loads;
      });
  examples::Newton const newton{.tolerance = 1e-9, .max_iterations = 40, .divergence_limit = 1e3};
  scarp::LoadStepping const stepping{
      .first = 0.05, .smallest = 1e-5, .largest = 0.05, .max_displacement_gradient = 1.0};
  scarp::NoObserver no_observer;
  auto const placed = stepping.settle(newton, problem, 0.0, no_observer);
  if (!placed.verdict.acceptable()) return {.run = placed, .note = "not placed"};
  auto const run = scarp::joined(placed, stepping.run(newton, problem, 0.0, 2.0, no_observer));
  auto const& grid = problem.discretisation();
  return {static_cast<int>(grid.mesh().elements.size()), grid.dof_count(), run.load, run, watch.seconds()};
}

}  // namespace rigid_on_elastic
