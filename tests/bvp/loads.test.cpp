// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/discretisation.hpp"

#include <doctest/doctest.h>

#include "../../examples/shared/field_error.hpp"
#include "bvp/sample_problems.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/refusals.hpp"

namespace {

template <int Dim>
scarp::Vector<Dim> sum(Eigen::VectorXd const& forces) {
  return forces.reshaped(Dim, forces.size() / Dim).rowwise().sum();
}

}  // namespace

TEST_CASE("body forces add up to the weight of each region") {
  auto mesh = scarp::FaultMesh{.size = 2.5}.generate({-15.5, -8.5});
  scarp::mark_footing_base(mesh, -12.0, 7.0);
  scarp::add_footing_block(mesh, 1.5, 2.5);
  scarp::Discretisation<scarp::Tri3> const disc(mesh, 0.2);
  int const footing = scarp::region_number(disc.mesh(), "footing");
  auto const forces =
      disc.body_force([&](int region) { return scarp::Vector<2>(0.0, region == footing ? -25e3 : -16e3); });
  // Analytic: (75 x 25 m2 of soil, 7 x 1.5 m2 of footing) times 0.2 m; round-off of some thousand terms.
  CHECK(sum<2>(forces).y() == samples::Approx(-0.2 * (75.0 * 25.0 * 16e3 + 7.0 * 1.5 * 25e3)).epsilon(1e-12));
  CHECK(sum<2>(forces).x() == 0.0);
}

TEST_CASE_TEMPLATE("body forces keep the moment of the weight on distorted meshes", Element, SAMPLE_ELEMENTS) {
  constexpr int dim = Element::dim;
  scarp::Discretisation<Element> const disc(samples::distorted_block<Element>(3));
  scarp::Vector<dim> const gravity = -20e3 * scarp::Vector<dim>::Unit(dim - 1);
  auto const forces = disc.body_force([&](int) { return gravity; });
  double lever = 0.0;
  for (int n = 0; n < disc.node_count(); ++n) {
    lever += disc.mesh().nodes[static_cast<std::size_t>(n)](0) * forces(dim * n + dim - 1);
  }
  // Analytic: unit block, centre at 1/2. Shapes reproduce linear functions; the quadrature of simplices and of straight
  // squares and cubes (x times the Jacobian is at most cubic along an axis) is exact for them.
  CHECK(lever == samples::Approx(-20e3 / 2.0).epsilon(1e-13));
  CHECK(sum<dim>(forces)(dim - 1) == samples::Approx(-20e3).epsilon(1e-13));
}

TEST_CASE("a force that varies within the elements has its resultant and its moment") {
  scarp::Discretisation<scarp::Quad8> const disc(samples::distorted_block<scarp::Quad8>(3), 0.5);
  auto const forces = examples::varying_body_force(
      disc, [](scarp::Vector<2> const& x) { return scarp::Vector<2>(0.0, x.x() * x.x() * x.y()); });
  double lever = 0.0;
  for (int n = 0; n < disc.node_count(); ++n) {
    lever += disc.mesh().nodes[static_cast<std::size_t>(n)].x() * forces(2 * n + 1);
  }
  CHECK(sum<2>(forces).y() == samples::Approx(0.5 / 3.0 / 2.0).epsilon(1e-13));  // analytic: t int x^2 int y
  CHECK(lever == samples::Approx(0.5 / 4.0 / 2.0).epsilon(1e-13));               // analytic: t int x^3 int y
}

TEST_CASE_TEMPLATE("a traction on a quadratic side does the work of its resultant", Element, scarp::Quad8,
                   scarp::Tet10 ALSO_NIGHTLY(scarp::Tri6, scarp::Hex20)) {
  constexpr int dim = Element::dim;
  scarp::Discretisation<Element> const disc(samples::distorted_block<Element>(2));
  auto const forces = disc.traction("right", scarp::Vector<dim>::LinSpaced(1e3, -2e3));
  CHECK((sum<dim>(forces) - scarp::Vector<dim>::LinSpaced(1e3, -2e3)).norm() < 1e-9);  // analytic: side of 1 m2
  double lever = 0.0;
  for (int n = 0; n < disc.node_count(); ++n) {
    lever += disc.mesh().nodes[static_cast<std::size_t>(n)](1) * forces(dim * n);
  }
  CHECK(lever == samples::Approx(1e3 / 2.0).epsilon(1e-13));  // analytic: at mid-height
}

TEST_CASE("a traction adds up to its resultant and is shared by length") {
  scarp::Discretisation<scarp::Tri3> const disc(
      samples::CrossedRectangle{.width = 3.0, .height = 2.0, .columns = 3, .rows = 2}.generate(), 0.5);
  auto const forces = disc.traction("top", {1e3, -2e3});
  CHECK((sum<2>(forces) - scarp::Vector<2>(1e3 * 3.0 * 0.5, -2e3 * 3.0 * 0.5)).norm() < 1e-9);
  for (int const node : scarp::boundary_nodes(disc.mesh(), "top")) {
    double const x = disc.mesh().nodes[static_cast<std::size_t>(node)].x();
    double const share = x == 0.0 || x == 3.0 ? 0.5 : 1.0;  // analytic: half of each 1 m facet to each of its ends
    CHECK(forces(2 * node + 1) == samples::Approx(-2e3 * 0.5 * share).epsilon(1e-15));
  }
}

TEST_CASE("a pressure on the side of a block in space adds up to its area") {
  scarp::Discretisation<scarp::Hex8> const disc(samples::distorted_block<scarp::Hex8>(2));
  CHECK(sum<3>(disc.traction("top", {0.0, 0.0, -3e3})).z() == samples::Approx(-3e3).epsilon(1e-13));
}

TEST_CASE("loads stay when the mesh moves") {
  scarp::Discretisation<scarp::Tri3> disc(samples::CrossedRectangle{.columns = 2, .rows = 2}.generate());
  auto const weight = [](int) { return scarp::Vector<2>(0.0, -1.0); };
  auto const before = disc.body_force(weight);
  auto const pressed_before = disc.traction("top", {0.0, -1.0});
  disc.commit(samples::random_increment(disc.dof_count(), 0.1, 2));
  CHECK(disc.body_force(weight) == before);
  CHECK(disc.traction("top", {0.0, -1.0}) == pressed_before);
}

TEST_CASE("a traction on an unknown boundary is refused") {
  scarp::Discretisation<scarp::Tri3> const disc(samples::CrossedRectangle{}.generate());
  CHECK_REFUSED(disc.traction("roof", {0.0, -1.0}), "'roof'", "top");
}

TEST_CASE("a load history without loads takes the size of the first one") {
  scarp::LoadHistory loads;
  CHECK(loads.size() == 0);
  loads.add(Eigen::VectorXd::Ones(4), {});
  CHECK(loads.size() == 4);
  CHECK_REFUSED(loads.add(Eigen::VectorXd::Ones(3), {}), "3 entries", "4");
  CHECK(loads.at(2.0).sum() == 8.0);
}
