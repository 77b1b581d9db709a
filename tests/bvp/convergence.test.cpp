// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include "../../examples/cook_membrane/membrane.hpp"
#include "../../examples/mesh_orders/manufactured.hpp"
#include "scarp/bvp/default_integration.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/refusals.hpp"

namespace {

/// Analytic: an element of degree p has the order p + 1 in the displacement and p in its gradient. These meshes are too
/// coarse for the orders by up to 0.15 (`./examples/run mesh_orders` shows them on finer ones).
template <class Element>
void check_orders() {
  using Scheme = scarp::DefaultIntegration<Element>;
  int const degree = scarp::HasMidSides<Element> ? 2 : 1;
  int const cells = Element::dim == 2 ? 8 : 4;
  auto const coarse = mesh_orders::solve<Element, Scheme>(cells);
  auto const fine = mesh_orders::solve<Element, Scheme>(2 * cells);
  auto const order = orders(coarse, fine);
  CHECK(order.value > degree + 1 - 0.2);
  CHECK(order.gradient > degree - 0.2);
}

}  // namespace

TEST_CASE_TEMPLATE("elements converge at the order of their degree", Element, scarp::Quad8 ALSO_NIGHTLY(scarp::Hex8)) {
  // The others are checked by the example itself, which ctest runs.
  check_orders<Element>();
}

TEST_CASE("Cook's panel has the deflections that other codes find") {
  // Another code: 23.97 at the middle of the right side for plane stress, E = 1, Poisson's ratio 1/3 and unit force;
  // FinEtools.jl, tutorials/Cook-plane-stress-tutorial.md. Plane strain with E (1 + 2 nu)/(1 + nu)^2 and nu/(1 + nu) is
  // the same problem. 16 cells miss 0.0013 of it.
  cook_membrane::Panel const sheet{.young = 0.9375, .poisson = 0.25};
  CHECK(cook_membrane::solve<scarp::Quad8, scarp::ReducedIntegration>(16, sheet).middle ==
        samples::Approx(23.97).epsilon(2e-3));
  // Another code: 16.4326 in plane strain for lambda = 7500, G = 0.375 (Poisson's ratio 0.499975), the limit of its
  // triangles; FinEtools' Matlab predecessor, function Cook_3D_strain. 32 cells miss 0.0042 of it, 64 cells 0.001.
  double const lambda = 7500.0;
  double const shear = 0.375;
  cook_membrane::Panel const rubber{.young = shear * (3.0 * lambda + 2.0 * shear) / (lambda + shear),
                                    .poisson = lambda / (2.0 * (lambda + shear))};
  CHECK(cook_membrane::solve<scarp::Quad4, scarp::BBar>(32, rubber).middle == samples::Approx(16.4326).epsilon(6e-3));
}

TEST_CASE("mean dilatation does not lock where every point on its own does") {
  // Regression: limit of finer meshes, `./examples/run cook_membrane`; three kinds of elements agree on it within 5e-4.
  double const limit = 0.08075;
  CHECK(cook_membrane::solve<scarp::Quad4, scarp::BBar>(16).deflection == samples::Approx(limit).epsilon(0.03));
  CHECK(cook_membrane::solve<scarp::Quad8, scarp::ReducedIntegration>(8).deflection ==
        samples::Approx(limit).epsilon(0.05));
  CHECK(cook_membrane::solve<scarp::Quad4, scarp::FullIntegration>(16).deflection < 0.4 * limit);
  // Locking comes from the material: with Poisson's ratio 0.3 both are right.
  cook_membrane::Panel const panel{.poisson = 0.3};
  CHECK(cook_membrane::solve<scarp::Quad4, scarp::FullIntegration>(16, panel).deflection ==
        samples::Approx(cook_membrane::solve<scarp::Quad4, scarp::BBar>(16, panel).deflection).epsilon(0.03));
}

TEST_CASE("errors of a field are integrals over the mesh") {
  auto const mesh = scarp::BoxMesh<scarp::Quad8>{.lengths = {2.0, 1.0}, .cells = {2, 2}, .distortion = 0.2}.generate();
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(2 * static_cast<int>(mesh.nodes.size()));
  auto const field = [](scarp::Vector<2> const& x) { return scarp::Vector<2>(x.x() * x.x(), 0.0); };
  auto const slope = [](scarp::Vector<2> const& x) -> scarp::Gradient<2> {
    return (scarp::Gradient<2>() << 2.0 * x.x(), 0.0, 0.0, 0.0).finished();
  };
  auto const error = examples::field_error(mesh, nothing, field, slope);
  // Analytic: the integrals of x^4 and 4 x^2 from 0 to 2.
  CHECK(error.value == samples::Approx(std::sqrt(32.0 / 5.0)).epsilon(1e-14));
  CHECK(error.gradient == samples::Approx(std::sqrt(32.0 / 3.0)).epsilon(1e-14));
  CHECK_REFUSED(examples::field_error(mesh, Eigen::VectorXd(3), field, slope), "3 entries");
}
