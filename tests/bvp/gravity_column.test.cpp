// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "bvp/sample_problems.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "support/approx.hpp"

namespace {

constexpr double young = 20e6;
constexpr double poisson = 0.3;
constexpr double unit_weight = 18e3;

/// Elastic soil between smooth walls on a smooth bottom under its own weight, 4 m wide and 6 m high, 4 x 5 cells.
struct Column {
  samples::CrossedRectangle grid{.width = 4.0, .height = 6.0, .columns = 4, .rows = 5};
  scarp::Discretisation<scarp::Tri3, scarp::SmallStrain> disc{grid.generate(), 0.2};
  scarp::LinearElastic<2> soil = scarp::LinearElastic<2>::from_young_poisson(young, poisson);
  Eigen::VectorXd weight = disc.body_force([](int) { return scarp::Vector<2>(0.0, -unit_weight); });
  Eigen::VectorXd displacement;
  std::vector<scarp::VoigtStress<2>> stresses;

  Column() {
    scarp::Constraints constraints(disc.mesh());
    for (auto const* wall : {"left", "right"}) {
      for (int const node : scarp::boundary_nodes(disc.mesh(), wall)) {
        constraints.fix(node, 0);
      }
    }
    for (int const node : scarp::boundary_nodes(disc.mesh(), "bottom")) {
      constraints.fix(node, 1);
    }
    auto const points = static_cast<std::size_t>(disc.point_count());
    Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(disc.dof_count());
    std::vector<scarp::VoigtStress<2>> const zero(points, scarp::VoigtStress<2>::Zero());
    std::vector<scarp::VoigtTangent<2>> const tangents(points, soil.tangent({}));
    displacement = samples::solve_free(disc.stiffness(nothing, zero, tangents), constraints, weight);
    std::vector<scarp::Gradient<2>> gradients(points);
    disc.gradients(displacement, gradients);
    for (auto const& gradient : gradients) {
      stresses.emplace_back(soil.tangent({}) * scarp::to_engineering_strain<2, double>(gradient));
    }
  }
};

}  // namespace

TEST_CASE("the grid nodes of a column under gravity settle by the exact parabola") {
  Column const column;
  double const modulus = column.soil.elasticity.lame_lambda + 2.0 * column.soil.elasticity.shear_modulus;
  double const height = 6.0;
  int checked = 0;
  for (int n = 0; n < column.disc.node_count(); ++n) {
    auto const& place = column.disc.mesh().nodes[static_cast<std::size_t>(n)];
    if (n < 5 * 6) {  // grid nodes come first, centres of the cells later
      // Analytic: M u'' = gamma, u(0) = 0, M u'(H) = 0 gives u = -gamma (H y - y^2/2) / M. Crossed triangles: the
      // centre's excess over the mean of the corners decouples, so that the grid nodes obey the one-dimensional
      // elements, which are exact at nodes. Round-off of the solve.
      double const exact = -unit_weight * (height * place.y() - place.y() * place.y() / 2.0) / modulus;
      CHECK(std::abs(column.displacement(2 * n + 1) - exact) < 1e-12 * unit_weight * height * height / modulus * 10.0);
      ++checked;
    }
    CHECK(std::abs(column.displacement(2 * n)) < 1e-14);  // symmetry: nothing moves sideways; round-off
  }
  CHECK(checked == 30);
}

TEST_CASE("the centre of a crossed cell settles more than its corners' mean by what its own weight makes of it") {
  Column const column;
  double const modulus = column.soil.elasticity.lame_lambda + 2.0 * column.soil.elasticity.shear_modulus;
  auto const& mesh = column.disc.mesh();
  for (std::size_t cell = 0; cell < mesh.elements.size(); cell += 4) {
    int const centre = mesh.elements[cell][2];
    double mean = 0.0;
    for (std::size_t side = 0; side < 4; ++side) {
      mean += column.displacement(2 * mesh.elements[cell + side][0] + 1) / 4.0;
    }
    // Analytic: stiffness against the excess is 8 A (M/h^2 + G/w^2) with A a quarter of the cell, w x h; the centre
    // carries a third of the cell's weight: excess = -gamma / (6 (M/h^2 + G/w^2)).
    double const exact =
        -unit_weight / (6.0 * (modulus / (1.2 * 1.2) + column.soil.elasticity.shear_modulus / (1.0 * 1.0)));
    CHECK(column.displacement(2 * centre + 1) - mean ==
          samples::Approx(exact).epsilon(1e-9));  // difference of larger ones
  }
}

TEST_CASE("the mean stress of every cell is its overburden and the at-rest part of it") {
  Column const column;
  auto const& mesh = column.disc.mesh();
  for (std::size_t cell = 0; cell < mesh.elements.size(); cell += 4) {
    scarp::VoigtStress<2> mean = scarp::VoigtStress<2>::Zero();
    for (std::size_t side = 0; side < 4; ++side) {
      mean += column.stresses[cell + side] / 4.0;
    }
    double const depth = 6.0 - mesh.nodes[static_cast<std::size_t>(mesh.elements[cell][2])].y();
    double const vertical = -unit_weight * depth;
    // Analytic: sigma_v = -gamma z, sigma_h = nu/(1 - nu) sigma_v; the cell's mean is taken at its centre. Round-off of
    // the solve relative to the stress at the bottom.
    CHECK(std::abs(mean(1) - vertical) < 1e-11 * unit_weight * 6.0);
    CHECK(std::abs(mean(0) - poisson / (1.0 - poisson) * vertical) < 1e-11 * unit_weight * 6.0);
    CHECK(std::abs(mean(2)) < 1e-11 * unit_weight * 6.0);
  }
}

TEST_CASE("the bottom carries the whole weight and the walls push back at rest") {
  Column const column;
  Eigen::VectorXd force;
  column.disc.internal_force(column.displacement, column.stresses, force);
  Eigen::VectorXd const reaction = force - column.weight;
  double bottom = 0.0;
  for (int const node : scarp::boundary_nodes(column.disc.mesh(), "bottom")) {
    bottom += reaction(2 * node + 1);
  }
  double left = 0.0;
  for (int const node : scarp::boundary_nodes(column.disc.mesh(), "left")) {
    left += reaction(2 * node);
  }
  // Analytic: gamma W H t, and the integral of K0 gamma z over the wall, K0 gamma H^2/2 t. Every cut between columns of
  // cells carries the mean of the cells beside it, so the wall does too. Round-off of the solve.
  CHECK(bottom == samples::Approx(unit_weight * 4.0 * 6.0 * 0.2).epsilon(1e-11));
  CHECK(left == samples::Approx(poisson / (1.0 - poisson) * unit_weight * 18.0 * 0.2).epsilon(1e-11));
}
