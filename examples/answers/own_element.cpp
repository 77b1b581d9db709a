// SPDX-License-Identifier: BSL-1.0
// What does an element of one's own take? Nine nodes on a quadrilateral, in the patch test on a distorted mesh.
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/scene/scene.hpp"
#include "scarp/solver/consistent_tangent.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

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
static_assert(scarp::ReferenceElement<Quad9> && scarp::PlacesNodes<Quad9>);

int main() {
  auto const mesh = scarp::BoxMesh<Quad9>{.lengths = {2.0, 1.0}, .cells = {4, 3}, .distortion = 0.2}.generate();
  scarp::Discretisation<Quad9, scarp::SmallStrain> const grid(mesh);
  bool good = answers::agree("nodes of 4 x 3 elements", grid.node_count(), 9 * 7, 0.0);

  scarp::Tensor<2> const gradient{{1e-3, 4e-4}, {-2e-4, -5e-4}};
  scarp::Constraints fixed(mesh);
  for (char const* side : {"left", "right", "bottom", "top"}) {
    for (int const node : scarp::boundary_nodes(mesh, side)) {
      scarp::Vector<2> const moved = gradient * mesh.nodes[static_cast<std::size_t>(node)];
      for (int axis = 0; axis < 2; ++axis) fixed.move(node, axis, moved(axis));
    }
  }
  auto const elastic = scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3);
  auto const soils = boost::hana::make_tuple(scarp::Region{"soil", elastic});
  scarp::SerialExecutor serial;
  auto problem = scarp::make_problem(grid, 1.0, soils, fixed, scarp::LoadHistory{}, serial);
  scarp::NoObserver nobody;
  scarp::QuasiNewton<scarp::ConsistentTangent> const newton{.tolerance = 1e-10};
  good &= scarp::LoadStepping{.first = 1.0}.run(newton, problem, 0.0, 1.0, nobody).verdict.acceptable();
  double worst = 0.0;  // inner nodes must follow the uniform gradient
  auto const& now = problem.discretisation().positions();
  for (std::size_t n = 0; n < now.size(); ++n) {
    worst = std::max(worst, (now[n] - mesh.nodes[n] - gradient * mesh.nodes[n]).norm());
  }
  fmt::print("largest error of a displacement {:.1e} m of {:.1e} m\n", worst, gradient.norm());
  return good && worst < 1e-12 ? 0 : 1;  // round-off of the solution of 126 equations
}
