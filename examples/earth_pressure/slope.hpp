// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "tied_pairs.hpp"

namespace earth_pressure {

/// A slope without end of sand on a rough base: a column across the layer whose sides move alike. Gravity tilts.
struct EndlessSlope {
  double thickness = 5.0;     ///< across the layer [m]
  double unit_weight = 18e3;  ///< [N/m3]
  double friction = examples::radians(30.0);
  double dilation = examples::radians(30.0);
  double young = 1e9;  ///< [Pa]

  /// Tangent of the inclination where the factor of safety tan(phi)/tan(beta) is one; with another dilation of the
  /// coaxial flow along the layer \f$ \sin\varphi\cos\psi/(1 - \sin\varphi\sin\psi) \f$ (Davis 1968).
  double steepest() const {
    return std::sin(friction) * std::cos(dilation) / (1.0 - std::sin(friction) * std::sin(dilation));
  }
};

/// The last tangent of the inclination with equilibrium.
/// cells: across the layer
template <class Element, class Scheme>
examples::Outcome tilt(EndlessSlope const& slope, int cells) {
  examples::Stopwatch const watch;
  using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  Soil const soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(slope.young, 0.3),
                  .strength = {{0.0, slope.friction, slope.dilation}},
                  .initial = {.unit_weight = slope.unit_weight, .k0 = 1.0}};
  examples::PlaneGrid<Element, Scheme> grid(scarp::BoxMesh<Element>{
      .lengths = scarp::Vector<2>(slope.thickness / cells, slope.thickness),
      .cells = {1, cells}}.generate());
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
  TiedPairs const ties(opposite_nodes(mesh), 1e4 * slope.young);
  scarp::Vector<2> const across(0.0, -slope.unit_weight);
  scarp::Vector<2> const along(slope.unit_weight, 0.0);
  scarp::LoadHistory loads(grid.body_force([&](int) { return across; }));
  loads.add(grid.body_force([&](int) { return along; }), {});
  auto problem = examples::plane_problem(std::move(grid), soil, slope.thickness, constraints, loads, ties);
  examples::Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-8}}};
  scarp::LoadStepping const stepping{
      .first = 0.05, .smallest = 1e-4, .largest = 0.05, .max_displacement_gradient = 1.0};
  scarp::NoObserver no_observer;
  auto const run = stepping.run(newton, problem, 0.0, 2.0, no_observer);
  auto const& done = problem.discretisation();
  return {static_cast<int>(done.mesh().elements.size()), done.dof_count(), run.load, run, watch.seconds()};
}

}  // namespace earth_pressure
