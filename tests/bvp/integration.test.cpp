// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/integration.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <optional>

#include "bvp/stiffness_check.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/factorisations.hpp"

namespace {

struct OnlyPoints {
  template <class Element>
  static auto points() {
    return Element::quadrature();
  }
};
static_assert(scarp::PlacesPoints<OnlyPoints, scarp::Quad4> && !scarp::Integration<OnlyPoints, scarp::Quad4>);
static_assert(scarp::Integration<scarp::BBar, scarp::Hex20> &&
              scarp::Integration<scarp::ReducedIntegration, scarp::Quad8>);
static_assert(!scarp::Integration<scarp::ReducedIntegration, scarp::Tri3>, "one point is already the full rule");
static_assert(!scarp::Integration<scarp::ReducedIntegration, scarp::Tri6>, "three points are the fewest that hold it");

/// Stiffness of an unloaded body of linear elastic material.
template <class Discretisation>
Eigen::MatrixXd elastic_stiffness(Discretisation const& disc) {
  constexpr int dim = Discretisation::dim;
  auto const soil = scarp::LinearElastic<dim>::from_lame(3e6, 2e6);
  auto const points = static_cast<std::size_t>(disc.point_count());
  std::vector<scarp::VoigtStress<dim>> const stresses(points, scarp::VoigtStress<dim>::Zero());
  std::vector<scarp::VoigtTangent<dim>> const tangents(points, soil.tangent({}));
  return disc.stiffness(Eigen::VectorXd::Zero(disc.dof_count()), stresses, tangents);
}

/// Number of motions without stiffness of one slightly distorted element.
template <class Element, class Scheme>
int zero_modes() {
  auto mesh = scarp::BoxMesh<Element>{}.generate();
  mesh.elements.resize(1);
  mesh.element_region.resize(1);
  mesh.boundaries.clear();
  scarp::Random random(17);
  std::vector<int> number(mesh.nodes.size(), -1);
  std::vector<scarp::Vector<Element::dim>> nodes;
  for (int& node : mesh.elements[0]) {
    nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    for (auto& coordinate : nodes.back()) {
      coordinate += random.uniform(-0.04, 0.04);
    }
    node = static_cast<int>(nodes.size()) - 1;
  }
  mesh.nodes = nodes;
  Eigen::MatrixXd const stiffness = elastic_stiffness(scarp::Discretisation<Element, scarp::SmallStrain, Scheme>(mesh));
  Eigen::VectorXd const values = samples::eigenvalues(stiffness);
  int const zero = static_cast<int>((values.array().abs() < 1e-12 * values.maxCoeff()).count());
  // Round-off of the eigenvalues is 1e-14 of the largest; nothing may lie between that and the true modes.
  CHECK((values.array() > 1e-4 * values.maxCoeff()).count() == values.size() - zero);
  return zero;
}

template <int Dim, class Element>
std::vector<scarp::Vector<Dim>> moved(scarp::Mesh<Element> const& mesh, Eigen::VectorXd const& increment) {
  auto nodes = mesh.nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n] += increment.segment<Dim>(Dim * static_cast<int>(n));
  }
  return nodes;
}

template <class Element>
constexpr int rigid_modes = Element::dim*(Element::dim + 1) / 2;

/// Distance of the stiffness from the derivative of the forces, at a large increment of a hyperelastic solid where the
/// configuration moves.
template <class Element, class Motion, class Scheme>
double distance_of_stiffness() {
  scarp::Discretisation<Element, Motion, Scheme> const disc(
      samples::distorted_block<Element>(Element::dim == 2 ? 2 : 1));
  Eigen::VectorXd const increment =
      samples::affine<Element::dim>(disc.mesh().nodes, samples::general_gradient<Element::dim>(0.3)) +
      samples::random_increment(disc.dof_count(), 0.03, 9);
  if constexpr (Motion::follows_motion) {
    samples::NeoHookean<Element::dim> const solid;
    return samples::stiffness_error(solid, disc, samples::fresh<decltype(solid)>(disc), increment);
  } else {
    using Provider = scarp::LinearElastic<Element::dim>;
    auto const soil = Provider::from_lame(3e6, 2e6);
    Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(disc.dof_count());
    return samples::stiffness_error(soil, disc, samples::fresh<Provider>(disc), nothing);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("with mean dilatation the stiffness is the derivative of the internal force", Element, scarp::Quad8,
                   scarp::Hex8 ALSO_NIGHTLY(scarp::Tri6, scarp::Quad4, scarp::Tet10)) {
  // Central differences: truncation about (1e-6 over an element size of 0.1)^2, round-off 1e-16 over 1e-6, with the
  // force per stiffness up to 0.1: both below 1e-9.
  CHECK(distance_of_stiffness<Element, scarp::SmallStrain, scarp::BBar>() < 1e-8);
  CHECK(distance_of_stiffness<Element, scarp::UpdatedLagrangian, scarp::BBar>() < 1e-8);
}

TEST_CASE_TEMPLATE("at fewer points the stiffness is the derivative of the internal force", Element, scarp::Quad8,
                   scarp::Hex8 ALSO_NIGHTLY(scarp::Quad4)) {
  CHECK(distance_of_stiffness<Element, scarp::SmallStrain, scarp::ReducedIntegration>() < 1e-8);  // as above
  CHECK(distance_of_stiffness<Element, scarp::UpdatedLagrangian, scarp::ReducedIntegration>() < 1e-8);
}

TEST_CASE_TEMPLATE("an element has its rigid motions and no other zero mode", Element, SAMPLE_ELEMENTS) {
  // Analytic: dim translations and dim (dim - 1)/2 rotations.
  CHECK(zero_modes<Element, scarp::FullIntegration>() == rigid_modes<Element>);
  CHECK(zero_modes<Element, scarp::BBar>() == rigid_modes<Element>);
}

TEST_CASE_TEMPLATE("with fewer points an element has the known number of hourglass modes", Element, scarp::Quad8,
                   scarp::Hex8 ALSO_NIGHTLY(scarp::Quad4, scarp::Hex20)) {
  // Analytic: degrees of freedom less independent strains of the points, 3 or 6 each, less rigid modes: 16 - 12 - 3 and
  // 24 - 6 - 6; 8 - 3 - 3 and 60 - 48 - 6.
  constexpr int dim = Element::dim;
  int const strains = scarp::voigt_size<dim> * static_cast<int>(Element::reduced_quadrature().size());
  CHECK(zero_modes<Element, scarp::ReducedIntegration>() == dim * Element::nodes - strains);
}

TEST_CASE_TEMPLATE("with mean dilatation an element has one volume change and every point its own shape change",
                   Element, scarp::Hex8 ALSO_NIGHTLY(scarp::Quad4, scarp::Tri6)) {
  constexpr int dim = Element::dim;
  using Tensor = scarp::Tensor<dim>;
  scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::BBar> const disc(
      samples::distorted_block<Element>(2));
  constexpr auto per_element = static_cast<std::size_t>(disc.points_per_element);
  Eigen::VectorXd const increment = samples::affine<dim>(disc.mesh().nodes, samples::general_gradient<dim>(0.2)) +
                                    samples::random_increment(disc.dof_count(), 0.03, 12);
  std::vector<scarp::Gradient<dim>> seen(static_cast<std::size_t>(disc.point_count()));
  CHECK_FALSE(disc.gradients(increment, seen).has_value());
  auto const before = disc.volumes(Eigen::VectorXd::Zero(disc.dof_count()));
  auto const after = disc.volumes(increment);
  for (std::size_t e = 0; e < disc.mesh().elements.size(); ++e) {
    double start = 0.0;
    double end = 0.0;
    for (std::size_t p = e * per_element; p < (e + 1) * per_element; ++p) {
      start += before[p];
      end += after[p];
    }
    for (std::size_t p = e * per_element; p < (e + 1) * per_element; ++p) {
      Tensor const deformation = Tensor::Identity() + seen[p];
      CHECK(deformation.determinant() == samples::Approx(end / start).epsilon(1e-13));  // analytic; round-off
      auto const rows = scarp::corners<Element, dim>(disc.mesh().elements[e], disc.mesh().nodes);
      auto const ends = scarp::corners<Element, dim>(disc.mesh().elements[e], moved<dim>(disc.mesh(), increment));
      auto const shape = scarp::spatial_shape<Element>(rows, disc.local_point(static_cast<int>(p)));
      Tensor const own = ends.transpose() * shape.gradients;
      Tensor const without_volume = own / std::pow(own.determinant(), 1.0 / dim);
      CHECK((deformation / std::pow(end / start, 1.0 / dim) - without_volume).norm() < 1e-13);  // as above
    }
  }
}

TEST_CASE("an element that is turned inside out is named also with mean dilatation") {
  scarp::Discretisation<scarp::Quad8, scarp::UpdatedLagrangian, scarp::BBar> const disc(
      scarp::BoxMesh<scarp::Quad8>{.cells = {2, 1}}.generate());
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(disc.dof_count());
  std::vector<scarp::Gradient<2>> gradients(static_cast<std::size_t>(disc.point_count()));
  CHECK_FALSE(disc.gradients(increment, gradients).has_value());
  increment(2 * disc.mesh().elements[1][2]) = -0.9;  // the upper right corner of the second element, past its left side
  CHECK(disc.gradients(increment, gradients) == std::optional<int>(1));
  increment(0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(disc.gradients(increment, gradients) == std::optional<int>(0));
}
