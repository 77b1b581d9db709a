// SPDX-License-Identifier: BSL-1.0
// A packing in every point of elements of every kind: the patch test with a material that is no formula.
#include <doctest/doctest.h>

#include "bvp/sample_problems.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/elements.hpp"
#include "support/packings.hpp"

namespace {

using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;

/// Equal spheres in a cubic lattice that is pressed together by a five-hundredth.
Spheres cubic_lattice() {
  constexpr int side = 3;
  constexpr std::size_t count = side * side * side;
  constexpr double radius = 5e-3;
  constexpr double spacing = 0.998 * 2.0 * radius;
  Spheres packing;
  packing.population = std::make_shared<scarp::Population<scarp::Sphere> const>(
      std::vector<std::array<double, 1>>(count, {radius}), samples::density, 1.0);
  packing.cell = side * spacing * scarp::Tensor<3>::Identity();
  packing.position.resize(count);
  packing.orientation.resize(count);
  packing.rest();
  std::size_t grain = 0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) {
        packing.position(grain, 0) = (i + 0.25) * spacing;
        packing.position(grain, 1) = (j + 0.25) * spacing;
        packing.position(grain++, 2) = (k + 0.25) * spacing;
      }
    }
  }
  return packing;
}

/// Hidden, so that elements of one dimension share one material.
template <int Dim>
scarp::AnyProvider<Dim> grains() {
  if constexpr (Dim == 2) {
    using Discs = samples::Discs;
    return scarp::DemRve<Discs, scarp::SamePacking<Discs>>{
        .law = samples::study_law(), .source = {samples::triangular_lattice<Discs>(4, 5e-3, 0.998e-2)}};
  } else {
    return scarp::DemRve<Spheres, scarp::SamePacking<Spheres>>{.law = samples::study_law(),
                                                               .source = {cubic_lattice()}};
  }
}

}  // namespace

TEST_CASE_TEMPLATE("packings in all points of a distorted patch carry the stress of one packing, in balance", Element,
                   SAMPLE_ELEMENTS) {
  constexpr int dim = Element::dim;
  scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::FullIntegration> const grid(
      samples::distorted_block<Element>(2));
  auto const gradient = samples::general_gradient<dim>(2e-4);
  auto const packing = grains<dim>();
  scarp::SerialExecutor serial;
  auto const answers = [&](std::vector<scarp::Gradient<dim>> const& gradients) {
    std::vector<scarp::Site<dim>> const sites(gradients.size());
    scarp::MaterialPoints<dim> points(packing, sites);
    for (int point = 0; point < points.size(); ++point)
      points.gradient(point) = gradients[static_cast<std::size_t>(point)];
    REQUIRE(points.respond(serial).verdict.acceptable());
    return points.stresses();
  };
  auto const expected = answers({gradient}).front();
  Eigen::VectorXd const increment = samples::affine<dim>(grid.mesh().nodes, gradient);
  std::vector<scarp::Gradient<dim>> gradients(static_cast<std::size_t>(grid.point_count()));
  grid.gradients(increment, gradients);
  auto const stresses = answers(gradients);
  // Gradients of points differ by round-off, 1e-16 over strains of 1e-4, and so do the paths of their grains.
  for (auto const& stress : stresses) CHECK((stress - expected).norm() < 1e-9 * expected.norm());
  Eigen::VectorXd force;
  grid.internal_force(increment, stresses, force);
  std::vector<bool> outer(grid.mesh().nodes.size(), false);
  for (int const node : samples::outline(grid.mesh())) outer[static_cast<std::size_t>(node)] = true;
  double inner = 0.0;
  int inner_nodes = 0;
  for (int node = 0; node < static_cast<int>(outer.size()); ++node) {
    if (outer[static_cast<std::size_t>(node)]) continue;
    ++inner_nodes;
    inner = std::max(inner, force.segment<dim>(dim * node).cwiseAbs().maxCoeff());
  }
  CHECK(inner_nodes > 0);  // or nothing is said
  CHECK(inner < 1e-9 * force.cwiseAbs().maxCoeff());
}
