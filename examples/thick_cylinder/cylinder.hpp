// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "ring.hpp"

namespace thick_cylinder {

/// A long thick cylinder under inner pressure in plane strain, of a material of Tresca, that is Mohr-Coulomb without
/// friction.
/// Radii and yield stress as in de Souza Neto, Peric and Owen, Computational Methods for Plasticity, 7.5.1 (there in mm
/// and GPa), whose limit \f$ 2\sigma_y/\sqrt3 \ln(b/a) \f$ is that of von Mises.
struct Cylinder {
  double inner = 100.0;
  double outer = 200.0;
  double young = 210.0;
  double poisson = 0.3;
  double yield_stress = 0.24;

  double cohesion() const { return yield_stress / 2.0; }
  /// Tresca in plane strain: \f$ p = 2 c \ln(b/a) \f$
  double limit_pressure() const { return 2.0 * cohesion() * std::log(outer / inner); }
  double first_yield_pressure() const { return cohesion() * (1.0 - inner * inner / (outer * outer)); }
  /// Lame: pressure over the displacement of the inner wall.
  double elastic_stiffness() const {
    double const a2 = inner * inner;
    double const b2 = outer * outer;
    return young * (b2 - a2) / ((1.0 + poisson) * inner * ((1.0 - 2.0 * poisson) * a2 + b2));
  }
};

struct Pressures {
  examples::Outcome elastic;  ///< pressure over displacement, within the elastic range
  examples::Outcome limit;    ///< pressure at which the wall yields without more
};

/// Moves the inner wall outwards until the whole ring is plastic.
/// cells: along the radius and around
template <class Element, class Scheme>
Pressures expand(Cylinder const& cylinder, int cells) {
  examples::Stopwatch const watch;
  using Metal = scarp::MohrCoulomb<2>;
  Metal const metal{.elasticity = scarp::IsotropicElasticity::from_young_poisson(cylinder.young, cylinder.poisson),
                    .strength = {{.cohesion = cylinder.cohesion()}}};
  QuarterRing const ring{cylinder.inner, cylinder.outer, cells, cells};
  examples::PlaneGrid<Element, Scheme> grid(ring.mesh<Element>());
  auto const& mesh = grid.mesh();
  auto constraints = symmetric(mesh);
  auto const wall = boundary_nodes(mesh, "left");
  double const yield_move = cylinder.first_yield_pressure() / cylinder.elastic_stiffness();
  std::vector<scarp::Vector<2>> outwards;
  for (int const node : wall) {
    outwards.push_back(mesh.nodes[static_cast<std::size_t>(node)].normalized());
    for (double& part : outwards.back()) {
      if (std::abs(part) < 1e-12) part = 0.0;  // round-off of a cosine must not move what symmetry fixes
    }
    for (int axis = 0; axis < 2; ++axis) constraints.move(node, axis, yield_move * outwards.back()(axis));
  }
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(grid.dof_count());
  auto problem = examples::plane_problem(std::move(grid), metal, 0.0, constraints, scarp::LoadHistory(nothing));
  auto const& done = problem.discretisation();
  auto const pressure = [&] {
    Eigen::VectorXd forces;
    done.internal_force(nothing, problem.committed_stresses(), forces);
    double sum = 0.0;
    for (std::size_t k = 0; k < wall.size(); ++k) sum += forces.segment<2>(2 * wall[k]).dot(outwards[k]);
    return sum / (std::numbers::pi / 2.0 * cylinder.inner);
  };
  examples::Newton const newton{.tolerance = 1e-8, .rule = {.exact = {.floor = 1e-9}}};
  scarp::LoadStepping const stepping{.first = 0.5, .smallest = 1e-5, .max_displacement_gradient = 1e3};
  scarp::NoObserver no_observer;
  int const elements = static_cast<int>(done.mesh().elements.size());
  // So little that the strain measure's square, half the strain beside it, does not count.
  double const little = 1e-3;
  auto const elastic = stepping.run(newton, problem, 0.0, little, no_observer);
  double const stiffness = pressure() / (little * yield_move);
  Pressures result{{elements, done.dof_count(), stiffness, elastic, watch.seconds()}, {}};
  auto const plastic = stepping.run(newton, problem, little, 6.0, no_observer);
  result.limit = {elements, done.dof_count(), pressure(), plastic, watch.seconds()};
  return result;
}

}  // namespace thick_cylinder
