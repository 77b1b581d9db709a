// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "bvp/sample_problems.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "support/elements.hpp"

namespace {

/// Prescribes the affine displacement on the outline and lets Newton's method find the interior.
template <class Element, class Motion, class Scheme = scarp::FullIntegration>
void check_patch(double size, int iterations) {
  constexpr int dim = Element::dim;
  using Provider = scarp::LinearElastic<dim>;
  scarp::Discretisation<Element, Motion, Scheme> const disc(
      samples::distorted_block<Element>(Element::dim == 2 ? 3 : 2));
  auto const soil = Provider::from_lame(3e6, 2e6);
  auto const gradient = samples::general_gradient<dim>(size);
  Eigen::VectorXd const expected = samples::affine<dim>(disc.mesh().nodes, gradient);
  scarp::Constraints constraints(disc.mesh());
  for (int const node : samples::outline(disc.mesh())) {
    for (int axis = 0; axis < dim; ++axis) {
      constraints.move(node, axis, expected(dim * node + axis));
    }
  }
  REQUIRE(constraints.free_count() > 0);
  std::vector<typename Provider::State> const start(static_cast<std::size_t>(disc.point_count()));
  Eigen::VectorXd increment = constraints.displacement(1.0);
  if constexpr (Motion::follows_motion) {
    // A start near the answer, off by a tenth of the deformation: a stiff boundary move alone turns elements over.
    increment = expected;
    for (int const dof : constraints.free_dofs()) {
      increment(dof) += 0.1 * size * ((dof % 3) - 1.0) / 3.0;
    }
  }
  Eigen::VectorXd force;
  for (int k = 0; k < iterations; ++k) {
    auto points = samples::answers(soil, disc, start, increment);
    if constexpr (!Motion::follows_motion) {
      for (std::size_t p = 0; p < points.stresses.size(); ++p) {
        std::vector<scarp::Gradient<dim>> gradients(points.stresses.size());
        disc.gradients(increment, gradients);
        points.stresses[p] = points.tangents[p] * scarp::to_engineering_strain<dim, double>(gradients[p]);
      }
    }
    disc.internal_force(increment, points.stresses, force);
    Eigen::VectorXd const correction =
        samples::solve_free(disc.stiffness(increment, points.stresses, points.tangents), constraints, force);
    increment -= correction;
    if (correction.norm() < 1e-14 * expected.norm()) break;
  }
  // Analytic: a uniform gradient is in equilibrium on any mesh (patch test). Round-off of the solve, condition below
  // 100.
  CHECK((increment - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff() * 10.0);
  std::vector<scarp::Gradient<dim>> gradients(static_cast<std::size_t>(disc.point_count()));
  CHECK_FALSE(disc.gradients(increment, gradients).has_value());
  typename Provider::State trial;
  auto const uniform = soil.respond({}, Motion::template material_gradient<dim>(gradient), trial).stress;
  for (auto const& stress : samples::answers(soil, disc, start, increment).stresses) {
    CHECK((stress - uniform).norm() < 1e-12 * 7e6);  // the answer to the affine gradient, relative to the modulus
  }
}

/// With full and with reduced integration and with the mean dilatation, as far as the element has them.
template <class Element, class Motion>
void check_patches(double size, int iterations) {
  constexpr bool reduced = scarp::GivesReducedQuadrature<Element>;
  check_patch<Element, Motion>(size, iterations);
  if constexpr (reduced) check_patch<Element, Motion, scarp::ReducedIntegration>(size, iterations);
  if constexpr (reduced || samples::nightly) check_patch<Element, Motion, scarp::BBar>(size, iterations);
}

}  // namespace

TEST_CASE_TEMPLATE("a linear displacement on the outline of a distorted patch is found inside with one linear solve",
                   Element, SAMPLE_ELEMENTS) {
  check_patches<Element, scarp::SmallStrain>(1e-3, 1);
}

TEST_CASE_TEMPLATE("a large homogeneous deformation is found inside a distorted patch", Element, SAMPLE_ELEMENTS) {
  check_patches<Element, scarp::UpdatedLagrangian>(0.2, 25);
}

TEST_CASE("a stretched patch carries the stress of its strain") {
  scarp::Discretisation<scarp::Tri3> const disc(samples::distorted_block<scarp::Tri3>(3));
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  scarp::Gradient<2> gradient = scarp::Gradient<2>::Zero();
  gradient.diagonal() << 0.02, -0.01;
  std::vector<scarp::LinearElastic<2>::State> const start(static_cast<std::size_t>(disc.point_count()));
  auto const points = samples::answers(soil, disc, start, samples::affine<2>(disc.mesh().nodes, gradient));
  // Analytic: E = 2 e / (2 + e) along each axis; sigma = lambda tr(E) + 2 G E.
  double const across = 0.04 / 2.02;
  double const up = -0.02 / 1.99;
  scarp::VoigtStress<2> const expected(7e6 * across + 3e6 * up, 3e6 * across + 7e6 * up, 0.0);
  for (auto const& stress : points.stresses) {
    CHECK((stress - expected).norm() < 1e-12 * 7e6);
  }
}
