// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/core/random.hpp"
#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/linear_system.hpp"
#include "support/crossed_rectangle.hpp"

/// Small distorted meshes for every element, and what the tests of the finite-element side do with them.
namespace samples {

/// Unit square or cube of `cells` cells along each axis, interior nodes moved at random.
template <class Element>
scarp::Mesh<Element> distorted_block(int cells) {
  return scarp::BoxMesh<Element>{.cells = scarp::BoxMesh<Element>::filled(cells), .distortion = 0.15, .seed = 5}
      .generate();
}

template <>
inline scarp::Mesh<scarp::Tri3> distorted_block<scarp::Tri3>(int cells) {
  return samples::CrossedRectangle{.columns = cells, .rows = cells, .distortion = 0.2, .seed = 5}.generate();
}

/// Increment of every node by a displacement gradient: u = G X.
template <int Dim>
Eigen::VectorXd affine(std::vector<scarp::Vector<Dim>> const& positions, scarp::Gradient<Dim> const& gradient) {
  Eigen::VectorXd increment(Dim * static_cast<int>(positions.size()));
  for (int n = 0; n < static_cast<int>(positions.size()); ++n) {
    increment.segment<Dim>(Dim * n) = gradient * positions[static_cast<std::size_t>(n)];
  }
  return increment;
}

/// A displacement gradient with stretch, shear and rotation; entries up to `size`.
template <int Dim>
scarp::Gradient<Dim> general_gradient(double size) {
  scarp::Random random(3);
  scarp::Gradient<Dim> gradient;
  for (auto& entry : gradient.reshaped()) {
    entry = random.uniform(-size, size);
  }
  return gradient;
}

inline Eigen::VectorXd random_increment(int length, double size, std::uint64_t seed) {
  scarp::Random random(seed);
  Eigen::VectorXd increment(length);
  for (auto& entry : increment) {
    entry = random.uniform(-size, size);
  }
  return increment;
}

/// Stress and tangent of a material at all points.
template <class Provider>
struct PointStates {
  static constexpr int dim = Provider::dim;
  std::vector<typename Provider::State> states;
  std::vector<scarp::VoigtStress<dim>> stresses;
  std::vector<scarp::VoigtTangent<dim>> tangents;
};

/// Answers of the material to an increment from `committed` states.
template <class Provider, class Discretisation>
PointStates<Provider> answers(Provider const& provider, Discretisation const& disc,
                              std::vector<typename Provider::State> const& committed,
                              Eigen::VectorXd const& increment) {
  constexpr int dim = Provider::dim;
  auto const size = static_cast<std::size_t>(disc.point_count());
  std::vector<scarp::Gradient<dim>> gradients(size);
  disc.gradients(increment, gradients);
  PointStates<Provider> points;
  for (std::size_t p = 0; p < size; ++p) {
    typename Provider::State trial = committed[p];
    points.stresses.push_back(provider.respond(committed[p], gradients[p], trial).stress);
    points.tangents.push_back(provider.tangent(trial));
    points.states.push_back(trial);
  }
  return points;
}

/// Nodes on the outline of the unit block.
template <class Element>
std::vector<int> outline(scarp::Mesh<Element> const& mesh) {
  std::vector<int> nodes;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    auto const& node = mesh.nodes[static_cast<std::size_t>(n)];
    if (node.minCoeff() == 0.0 || node.maxCoeff() == 1.0) {
      nodes.push_back(n);
    }
  }
  return nodes;
}

/// Solves the free rows of K x = f with x = 0 at prescribed degrees of freedom.
inline Eigen::VectorXd solve_free(Eigen::SparseMatrix<double> const& matrix, scarp::Constraints const& constraints,
                                  Eigen::VectorXd const& force) {
  scarp::LinearSystem system(constraints);
  if (!system.factorize({matrix}).acceptable()) {
    throw std::runtime_error("the stiffness of a sample problem could not be factorised");
  }
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(force.size());
  system.scatter(system.solve(system.gather(force)), solution);
  return solution;
}

}  // namespace samples
