// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <chrono>
#include <cmath>
#include <numbers>

#include "../shared/elastic_solve.hpp"
#include "../shared/field_error.hpp"
#include "scarp/mesh/box_mesh.hpp"

namespace mesh_orders {

/// Displacement wave \f$ u = a \sin(k \cdot x) \f$ [m] in a linear elastic solid, with the body force that keeps it in
/// equilibrium: \f$ b = -\nabla\cdot\sigma = \sin(k \cdot x)\,[(\lambda + G)(a \cdot k)\,k + G |k|^2 a] \f$
/// The amplitude has a part along the wave (volume change) and one across (shear).
template <int Dim>
struct Wave {
  scarp::Vector<Dim> amplitude = 1e-3 * scarp::Vector<Dim>::LinSpaced(1.0, -0.6);
  scarp::Vector<Dim> wave = scarp::Vector<Dim>::LinSpaced(2.2, 1.3);  ///< [1/m]
  scarp::LinearElastic<Dim> solid = scarp::LinearElastic<Dim>::from_young_poisson(10e6, 0.3);

  scarp::Vector<Dim> displacement(scarp::Vector<Dim> const& x) const { return amplitude * std::sin(wave.dot(x)); }

  scarp::Gradient<Dim> gradient(scarp::Vector<Dim> const& x) const {
    return amplitude * wave.transpose() * std::cos(wave.dot(x));
  }

  scarp::Vector<Dim> body_force(scarp::Vector<Dim> const& x) const {
    auto const& [lame_lambda, shear_modulus] = solid.elasticity;
    return std::sin(wave.dot(x)) * ((lame_lambda + shear_modulus) * amplitude.dot(wave) * wave +
                                    shear_modulus * wave.squaredNorm() * amplitude);
  }
};

/// Moves the inside of the unit box smoothly by up to a tenth: the finer the mesh, the closer an element is to a
/// parallelogram.
template <int Dim>
scarp::Vector<Dim> bend(scarp::Vector<Dim> const& box) {
  double bump = 0.1;
  for (double const coordinate : box) {
    bump *= std::sin(std::numbers::pi * coordinate);
  }
  return box + bump * scarp::Vector<Dim>::LinSpaced(1.0, -0.7);
}

struct Outcome {
  double size = 0.0;  ///< of a cell before it is bent [m]
  int dofs = 0;
  examples::FieldError error;
  double seconds = 0.0;  ///< of the sparsity, assembly and direct solve
};

/// Solves for the wave in a unit box whose outline follows it; `distortion` moves the corners at random before bend().
template <class Element, class Scheme>
Outcome solve(int cells, double distortion = 0.0) {
  constexpr int dim = Element::dim;
  Wave<dim> const wave;
  auto const mesh =
      scarp::BoxMesh<Element>{
          .cells = scarp::BoxMesh<Element>::filled(cells), .distortion = distortion, .seed = 2, .map = bend<dim>}
          .generate();
  auto const start = std::chrono::steady_clock::now();
  scarp::Discretisation<Element, scarp::SmallStrain, Scheme> const grid(mesh);
  Eigen::VectorXd exact(grid.dof_count());
  for (int n = 0; n < grid.node_count(); ++n) {
    exact.segment<dim>(dim * n) = wave.displacement(mesh.nodes[static_cast<std::size_t>(n)]);
  }
  scarp::Constraints constraints(mesh);
  for (auto const& [name, facets] : mesh.boundaries) {
    for (int const node : boundary_nodes(mesh, name)) {
      constraints.fix(node);
    }
  }
  auto const forces = examples::varying_body_force(grid, [&](auto const& x) { return wave.body_force(x); });
  auto const found = examples::elastic_solve(grid, wave.solid, constraints, exact, forces);
  std::chrono::duration<double> const took = std::chrono::steady_clock::now() - start;
  return {1.0 / cells, grid.dof_count(),
          examples::field_error(
              mesh, found, [&](auto const& x) { return wave.displacement(x); },
              [&](auto const& x) { return wave.gradient(x); }),
          took.count()};
}

struct Orders {
  double value = 0.0;
  double gradient = 0.0;
};

inline Orders orders(Outcome const& coarse, Outcome const& fine) {
  double const ratio = std::log(coarse.size / fine.size);
  return {std::log(coarse.error.value / fine.error.value) / ratio,
          std::log(coarse.error.gradient / fine.error.gradient) / ratio};
}

}  // namespace mesh_orders
