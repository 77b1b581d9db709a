// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "scarp/bvp/discretisation.hpp"

namespace strip_footing {

/// A rigid strip footing of width 2 m on weightless Mohr-Coulomb soil with a surcharge beside it.
struct Footing {
  double cohesion = 1.0;   ///< [Pa]
  double friction = 0.0;   ///< [rad]
  double dilation = 0.0;   ///< [rad]
  double surcharge = 0.0;  ///< [Pa]
  bool rough = true;

  static constexpr double half_width = 1.0;  ///< [m]

  /// \f$ N_q = e^{\pi\tan\varphi}\tan^2(45°+\varphi/2),\; N_c = (N_q - 1)\cot\varphi \f$, 2 + pi without friction; the
  /// weightless problem's exact solution is \f$ q_u = c N_c + q N_q \f$ (Prandtl 1920, Reissner 1924).
  double surcharge_factor() const {
    double const passive = std::tan(std::numbers::pi / 4.0 + friction / 2.0);
    return std::exp(std::numbers::pi * std::tan(friction)) * passive * passive;
  }
  double cohesion_factor() const {
    return friction > 0.0 ? (surcharge_factor() - 1.0) / std::tan(friction) : 2.0 + std::numbers::pi;
  }
  double bearing_pressure() const { return cohesion * cohesion_factor() + surcharge * surcharge_factor(); }

  /// How far Prandtl's mechanism reaches from the edge of the footing, and how deep [m].
  double interaction_range() const {
    double const rotation = std::exp(std::numbers::pi / 2.0 * std::tan(friction));
    return 2.0 * half_width * std::tan(std::numbers::pi / 4.0 + friction / 2.0) * rotation;
  }
  double depth() const {
    double const angle = std::numbers::pi / 4.0 + friction / 2.0;
    return half_width / std::cos(angle) * std::exp(angle * std::tan(friction)) * std::cos(friction);
  }
};

/// Sizes of the cells, smallest at the footing's edge and growing linearly with the distance from it.
struct Grading {
  double at_edge = 0.04;  ///< [m] on the coarsest mesh; halved by each refinement
  double growth = 0.5;    ///< of the size over the distance on the coarsest mesh; halved as well
  int refinements = 0;

  double size(double distance) const { return (at_edge + growth * distance) / std::exp2(refinements); }
};

template <class Element>
scarp::Mesh<Element> half_space(Footing const& footing, Grading const& grading) {
  double const b = Footing::half_width;
  double const width = b + 1.3 * footing.interaction_range();
  double const depth = 1.5 * footing.depth();
  scarp::Spacing const along({{0.0, grading.size(b)}, {b, grading.size(0.0)}, {width, grading.size(width - b)}});
  scarp::Spacing const down({{-depth, grading.size(depth)}, {0.0, grading.size(0.0)}});
  auto mesh = examples::mesh_of_lines<Element>(graded_lines(along, {0.0, b, width}), graded_lines(down, {-depth, 0.0}));
  examples::split_boundary(mesh, "top", "footing", b);
  return mesh;
}

/// Follows the load on the footing and ends the run when it has stopped rising.
struct Plateau {
  std::vector<int> footing;
  Eigen::VectorXd loads;
  double pressure = 0.0;  ///< [Pa] over the footing's width
  double slope = 1.0;     ///< d ln(pressure) / d ln(settlement)
  double level = 0.0;

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    double const now = -examples::support_force(problem, footing, 1, loads) / Footing::half_width;
    if (level > 0.0) slope = std::log(now / pressure) / std::log(report.load / level);
    pressure = now;
    level = report.load;
  }
  bool wants_stop() const { return std::abs(slope) < 4e-3; }
};

/// The pressure [Pa] at which the footing sinks without further load.
template <class Element, class Scheme>
examples::Outcome press(Footing const& footing, Grading const& grading) {
  examples::Stopwatch const watch;
  using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;
  double const pressure = footing.bearing_pressure();
  double const young = 1e5 * pressure;
  Soil const soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(young, 0.3),
                  .strength = {{footing.cohesion, footing.friction, footing.dilation}},
                  .initial = {.surcharge = footing.surcharge}};
  examples::PlaneGrid<Element, Scheme> grid(half_space<Element>(footing, grading));
  auto const& mesh = grid.mesh();
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node);
  for (int const node : boundary_nodes(mesh, "left")) constraints.fix(node, 0);
  for (int const node : boundary_nodes(mesh, "right")) constraints.fix(node, 0);
  auto const below = boundary_nodes(mesh, "footing");
  for (int const node : below) {
    constraints.move(node, 1, -1e-3 * Footing::half_width);
    if (footing.rough) constraints.fix(node, 0);
  }
  Eigen::VectorXd const loads = grid.traction("top", scarp::Vector<2>(0.0, -footing.surcharge));
  Plateau plateau{below, loads};
  auto problem = examples::plane_problem(std::move(grid), soil, 0.0, constraints, scarp::LoadHistory(loads));
  // Without associated flow the tangent is unsymmetric and may lose its definiteness: a share of the elastic one keeps
  // it.
  bool const associated = footing.dilation == footing.friction;
  examples::Newton const newton{.tolerance = associated ? 1e-7 : 1e-4,
                                .max_iterations = associated ? 20 : 60,
                                .divergence_limit = 1e3,
                                .rule = {.exact = {.floor = associated ? 1e-8 : 0.02}}};
  scarp::LoadStepping const stepping{.first = 4e-3,
                                     .smallest = 1e-5,
                                     .largest = associated ? 0.04 : 0.01,
                                     .max_displacement_gradient = 1e3,
                                     .grow_below = associated ? 10 : 30,
                                     .shrink_above = associated ? 14 : 50};
  auto const run = stepping.run(newton, problem, 0.0, 0.25, plateau);
  auto const& done = problem.discretisation();
  return {static_cast<int>(done.mesh().elements.size()), done.dof_count(), plateau.pressure, run, watch.seconds(),
          plateau.slope < 0.02 ? "" : "no plateau"};
}

}  // namespace strip_footing
