// SPDX-License-Identifier: BSL-1.0
// User-defined element: a quadrilateral of nine nodes, in the patch test on a distorted mesh.
#include "scarp/bvp/discretisation.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"

#include "lattice.hpp"

/// Square [-1, 1] x [-1, 1], nodes as Quad8 and then the middle; products of quadratic shapes along both axes.
struct Quad9 {
  using Facet = scarp::Line3;   // an element of one dimension less
  using Linear = scarp::Quad4;  // its corners; meshes are made of these and then get the further nodes

  static constexpr int dim = 2, nodes = 9, facet_nodes = 3;
  static constexpr int vtk_cell_type = 28;  // for output

  static std::array<scarp::Vector<2>, 9> node_places() {
    return {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};
  }
  static scarp::ShapeValues<Quad9> shape(scarp::Vector<2> const& xi) {
    scarp::ShapeValues<Quad9> values;
    for (int a = 0; a < nodes; ++a) {
      auto const at = node_places()[static_cast<std::size_t>(a)];
      values(a) = along(at(0), xi(0)) * along(at(1), xi(1));
    }
    return values;
  }
  static scarp::ShapeGradients<Quad9> shape_gradients(scarp::Vector<2> const& xi) {
    scarp::ShapeGradients<Quad9> slopes;
    for (int a = 0; a < nodes; ++a) {
      auto const at = node_places()[static_cast<std::size_t>(a)];
      slopes(a, 0) = slope(at(0), xi(0)) * along(at(1), xi(1));
      slopes(a, 1) = along(at(0), xi(0)) * slope(at(1), xi(1));
    }
    return slopes;
  }
  static auto quadrature() { return scarp::gauss_rule<2, 3>(); }
  static constexpr std::array<std::array<int, 3>, 4> facets() { return {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}}; }

 private:
  static double along(double node, double x) { return node == 0.0 ? 1.0 - x * x : x * (x + node) / 2.0; }
  static double slope(double node, double x) { return node == 0.0 ? -2.0 * x : x + node / 2.0; }
};
using Grid = scarp::Discretisation<Quad9, scarp::SmallStrain>;  // names what an element lacks
static_assert(scarp::PlacesNodes<Quad9>);

int main() {
  auto const mesh = scarp::BoxMesh<Quad9>{.lengths = {2.0, 1.0}, .cells = {4, 3}, .distortion = 0.2}.generate();
  Grid const grid(mesh);
  bool good = tutorials::agree("nodes of 4 x 3 elements", grid.node_count(), 9 * 7, 0.0);
  double area = 0.0;
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(grid.dof_count());
  for (double const volume : grid.volumes(displacement)) area += volume;
  good &= tutorials::agree("area [m2]", area, 2.0, 1e-12);

  // The patch test: a uniform gradient is found at every point, and a uniform stress leaves the inner nodes without
  // force.
  scarp::Tensor<2> const gradient{{1e-3, 4e-4}, {4e-4, -5e-4}};
  for (int node = 0; node < grid.node_count(); ++node) {
    displacement.segment<2>(2 * node) = gradient * mesh.nodes[static_cast<std::size_t>(node)];
  }
  std::vector<scarp::Gradient<2>> gradients(static_cast<std::size_t>(grid.point_count()));
  grid.gradients(displacement, gradients);
  double strain_error = 0.0;
  for (auto const& found : gradients) strain_error = std::max(strain_error, (found - gradient).norm());

  std::vector<scarp::VoigtStress<2>> const stresses(gradients.size(), scarp::VoigtStress<2>(-2e5, -1e5, 3e4));
  Eigen::VectorXd forces;
  grid.internal_force(displacement, stresses, forces);
  for (char const* side : {"left", "right", "bottom", "top"}) {
    for (int const node : scarp::boundary_nodes(mesh, side)) forces.segment<2>(2 * node).setZero();
  }
  fmt::print("error of the gradient {:.1e}, force on inner nodes {:.1e} N\n", strain_error,
             forces.lpNorm<Eigen::Infinity>());
  return good && strain_error < 1e-15 && forces.lpNorm<Eigen::Infinity>() < 1e-9 ? 0 : 1;  // round-off
}
