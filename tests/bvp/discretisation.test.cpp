// SPDX-License-Identifier: BSL-1.0
#include "scarp/bvp/discretisation.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <numbers>
#include <type_traits>

#include "bvp/stiffness_check.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "support/approx.hpp"
#include "support/elements.hpp"
#include "support/factorisations.hpp"
#include "support/refusals.hpp"

namespace {

struct Eulerian {
  static constexpr bool follows_motion = true;
};
static_assert(!scarp::Kinematics<Eulerian>, "a policy that only tells its configuration must be refused");

}  // namespace

TEST_CASE_TEMPLATE("the stiffness is the derivative of the internal force at a large increment", Element, scarp::Quad4,
                   scarp::Tet4 ALSO_NIGHTLY(scarp::Tri3)) {
  scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::FullIntegration> const disc(
      samples::distorted_block<Element>(2));
  samples::NeoHookean<Element::dim> const solid;
  Eigen::VectorXd const increment =
      samples::affine<Element::dim>(disc.mesh().nodes, samples::general_gradient<Element::dim>(0.3)) +
      samples::random_increment(disc.dof_count(), 0.03, 9);
  // Central differences: truncation about (1e-6 over an element size of 0.1)^2, round-off 1e-16 over 1e-6, with the
  // force per stiffness up to 0.1: both below 1e-9.
  CHECK(samples::stiffness_error(solid, disc, samples::fresh<decltype(solid)>(disc), increment) < 1e-8);
}

TEST_CASE_TEMPLATE("the stiffness includes the turning of the stress that a point already carries", Element,
                   scarp::Tet4 ALSO_NIGHTLY(scarp::Tri3)) {
  using Provider = scarp::LinearElastic<Element::dim>;
  scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::FullIntegration> const disc(
      samples::distorted_block<Element>(2));
  auto const soil = Provider::from_lame(3e6, 2e6);
  scarp::VoigtStress<Element::dim> const high = scarp::VoigtStress<Element::dim>::LinSpaced(-2e6, 1e6);
  std::vector<typename Provider::State> const stressed(static_cast<std::size_t>(disc.point_count()), {high});
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(disc.dof_count());
  CHECK(samples::stiffness_error(soil, disc, stressed, nothing) < 1e-8);  // as above
}

TEST_CASE("small-strain stiffness is the derivative of the internal force") {
  scarp::Discretisation<scarp::Quad4, scarp::SmallStrain, scarp::FullIntegration> const disc(
      samples::distorted_block<scarp::Quad4>(2));
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(disc.dof_count());
  CHECK(samples::stiffness_error(soil, disc, samples::fresh<scarp::LinearElastic<2>>(disc), nothing) < 1e-8);
}

TEST_CASE("a stressed patch that turns by 30 degrees keeps its stress in its own frame and its forces turn along") {
  scarp::Discretisation<scarp::Tri3> disc(samples::distorted_block<scarp::Tri3>(3));
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  Eigen::VectorXd const first = samples::random_increment(disc.dof_count(), 0.02, 4);
  auto const before = samples::answers(soil, disc, samples::fresh<scarp::LinearElastic<2>>(disc), first);
  Eigen::VectorXd force_before;
  disc.internal_force(first, before.stresses, force_before);
  disc.commit(first);

  auto const turn = scarp::rotation(std::numbers::pi / 6.0);
  Eigen::VectorXd const turning = samples::affine<2>(disc.positions(), turn - scarp::Tensor<2>::Identity());
  auto const after = samples::answers(soil, disc, before.states, turning);
  Eigen::VectorXd force_after;
  disc.internal_force(turning, after.stresses, force_after);
  for (std::size_t p = 0; p < after.stresses.size(); ++p) {
    scarp::Tensor<2> const own = turn.transpose() * scarp::from_voigt_stress<2, double>(after.stresses[p]) * turn;
    // Analytic: objectivity. Round-off of the gradients (1e-16 over elements of 0.1) times the modulus.
    CHECK((scarp::to_voigt_stress<2, double>(own) - before.stresses[p]).norm() < 1e-12 * 7e6);
  }
  for (int n = 0; n < disc.node_count(); ++n) {
    scarp::Vector<2> const turned = turn * force_before.segment<2>(2 * n);
    CHECK((force_after.segment<2>(2 * n) - turned).norm() < 1e-12 * 7e6);
  }
  auto const volumes_before = disc.volumes(Eigen::VectorXd::Zero(disc.dof_count()));
  auto const volumes_after = disc.volumes(turning);
  for (std::size_t p = 0; p < volumes_before.size(); ++p) {
    CHECK(volumes_after[p] == samples::Approx(volumes_before[p]).epsilon(1e-12));
  }
}

TEST_CASE_TEMPLATE("a free body has its rigid motions and no other zero mode", Element,
                   scarp::Quad4 ALSO_NIGHTLY(scarp::Tri3, scarp::Tet4)) {
  scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::FullIntegration> const disc(
      samples::distorted_block<Element>(2));
  auto const soil = scarp::LinearElastic<Element::dim>::from_lame(3e6, 2e6);
  Eigen::VectorXd const nothing = Eigen::VectorXd::Zero(disc.dof_count());
  auto const points = samples::answers(soil, disc, samples::fresh<decltype(soil)>(disc), nothing);
  Eigen::MatrixXd const stiffness = disc.stiffness(nothing, points.stresses, points.tangents);
  CHECK((stiffness - stiffness.transpose()).norm() < 1e-15 * stiffness.norm() * 10.0);
  Eigen::VectorXd const values = samples::eigenvalues(stiffness);
  // Analytic: dim translations and dim (dim - 1)/2 rotations. Round-off of the eigenvalues is 1e-14 of the largest; the
  // softest true mode of so small a mesh is above 1e-3 of it.
  int const rigid = Element::dim * (Element::dim + 1) / 2;
  CHECK((values.array().abs() < 1e-12 * values.maxCoeff()).count() == rigid);
  CHECK((values.array() > 1e-4 * values.maxCoeff()).count() == values.size() - rigid);
}

TEST_CASE("internal forces are in balance for any stress, in sum and in moment") {
  scarp::Discretisation<scarp::Quad4, scarp::UpdatedLagrangian, scarp::FullIntegration> const disc(
      samples::distorted_block<scarp::Quad4>(3), 0.7);
  Eigen::VectorXd const increment = samples::random_increment(disc.dof_count(), 0.03, 6);
  std::vector<scarp::VoigtStress<2>> stresses;
  for (int p = 0; p < disc.point_count(); ++p) {
    stresses.emplace_back(1.0 + p, -2.0 + 0.5 * p, 3.0 - p);
  }
  Eigen::VectorXd forces;
  disc.internal_force(increment, stresses, forces);
  scarp::Vector<2> sum = scarp::Vector<2>::Zero();
  double moment = 0.0;
  for (int n = 0; n < disc.node_count(); ++n) {
    scarp::Vector<2> const place = disc.mesh().nodes[static_cast<std::size_t>(n)] + increment.segment<2>(2 * n);
    scarp::Vector<2> const at_node = forces.segment<2>(2 * n);
    sum += at_node;
    moment += place.x() * at_node.y() - place.y() * at_node.x();
  }
  // Analytic: shape functions add up to one and stress is symmetric. Round-off of some hundred terms of about 10.
  CHECK(sum.norm() < 1e-11);
  CHECK(std::abs(moment) < 1e-11);
}

TEST_CASE("the first element that an increment turns inside out is named, and the others still get gradients") {
  scarp::Discretisation<scarp::Tri3> const disc(samples::CrossedRectangle{}.generate());
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(disc.dof_count());
  std::vector<scarp::Gradient<2>> gradients(4);
  CHECK_FALSE(disc.gradients(increment, gradients).has_value());
  int const centre = disc.mesh().elements[0][2];
  increment(2 * centre) = 0.6;  // the centre at 0.5 leaves the cell through its right side
  auto const inverted = disc.gradients(increment, gradients);
  REQUIRE(inverted.has_value());
  CHECK(*inverted == 1);  // sides are in the order bottom, right, top, left
  // Analytic: the left triangle has the horizontal gradient 0.6 / 0.5.
  CHECK(gradients[3](0, 0) == samples::Approx(1.2).epsilon(1e-14));
  increment(2 * centre) = std::numeric_limits<double>::quiet_NaN();
  CHECK(disc.gradients(increment, gradients) == std::optional<int>(0));
  scarp::Discretisation<scarp::Tri3, scarp::SmallStrain> const small(samples::CrossedRectangle{}.generate());
  increment(2 * centre) = 0.6;
  CHECK_FALSE(small.gradients(increment, gradients).has_value());  // no configuration moves there
}

TEST_CASE("small strain drives the material by the symmetric part only and balances on the initial mesh") {
  scarp::Discretisation<scarp::Tri3, scarp::SmallStrain> disc(samples::CrossedRectangle{}.generate());
  scarp::Gradient<2> gradient;
  gradient << 0.1, 0.3, -0.1, 0.2;
  Eigen::VectorXd const increment = samples::affine<2>(disc.mesh().nodes, gradient);
  std::vector<scarp::Gradient<2>> seen(4);
  disc.commit(increment);
  disc.gradients(increment, seen);
  scarp::Gradient<2> const symmetric = (gradient + gradient.transpose()) / 2.0;
  for (auto const& one : seen) {
    CHECK((one - symmetric).norm() < 1e-15 * 10.0);
  }
  CHECK(disc.volumes(increment) == std::vector<double>(4, 0.25));
  CHECK(disc.positions()[1] == scarp::Vector<2>(disc.mesh().nodes[1] + increment.segment<2>(2)));
}

TEST_CASE("gradients refer to the configuration that was committed last") {
  scarp::Discretisation<scarp::Quad4, scarp::UpdatedLagrangian, scarp::FullIntegration> disc(
      samples::distorted_block<scarp::Quad4>(2));
  auto const first = samples::general_gradient<2>(0.2);
  auto const second = scarp::Gradient<2>(first.transpose() * 0.7);
  disc.commit(samples::affine<2>(disc.positions(), first));
  std::vector<scarp::Gradient<2>> gradients(static_cast<std::size_t>(disc.point_count()));
  disc.gradients(samples::affine<2>(disc.positions(), second), gradients);
  for (auto const& gradient : gradients) {
    CHECK((gradient - second).norm() < 1e-13);  // analytic: affine on the moved mesh; round-off over elements of 0.3
  }
}

TEST_CASE("strains of a small further displacement stand in the rows of their own points") {
  scarp::Discretisation<scarp::Quad4, scarp::SmallStrain, scarp::FullIntegration> const disc(
      samples::distorted_block<scarp::Quad4>(2));
  Eigen::VectorXd const increment = samples::random_increment(disc.dof_count(), 0.03, 7);
  std::vector<scarp::Gradient<2>> gradients(static_cast<std::size_t>(disc.point_count()));
  disc.gradients(increment, gradients);
  Eigen::VectorXd const strains = disc.strain_operator(Eigen::VectorXd::Zero(disc.dof_count())) * increment;
  for (int p = 0; p < disc.point_count(); ++p) {
    auto const expected = scarp::to_engineering_strain<2, double>(gradients[static_cast<std::size_t>(p)]);
    CHECK((strains.segment<3>(3 * p) - expected).norm() <
          1e-14);  // small strains are linear; round-off of 0.03 over 0.3
  }
}

TEST_CASE("volumes follow the motion and contain the thickness") {
  scarp::Discretisation<scarp::Tri3> const disc(samples::distorted_block<scarp::Tri3>(2), 0.2);
  scarp::Gradient<2> gradient;
  gradient << 0.5, 0.1, 0.0, -0.2;
  auto const volumes = disc.volumes(samples::affine<2>(disc.mesh().nodes, gradient));
  double sum = 0.0;
  for (double const volume : volumes) {
    sum += volume;
  }
  CHECK(sum == samples::Approx(0.2 * 1.5 * 0.8).epsilon(1e-14));  // analytic: t det(I + G)
}

TEST_CASE("a site tells where its point is and how deep") {
  auto mesh = samples::CrossedRectangle{.width = 2.0, .height = 3.0}.generate();
  mesh.regions.emplace_back("clay");
  mesh.element_region[2] = 1;
  scarp::Discretisation<scarp::Tri3> const disc(mesh);
  auto const site = disc.site(2, 3.5);
  // Analytic: the centroid of the top triangle, (1, (3 + 3 + 1.5)/3).
  CHECK(site.index == 2);
  CHECK(site.region == 1);
  CHECK((site.position - scarp::Vector<2>(1.0, 2.5)).norm() < 1e-15);
  CHECK(site.depth == samples::Approx(1.0).epsilon(1e-15));
}

TEST_CASE("the stiffness matrix keeps its memory from call to call and has the same bits each time") {
  scarp::Discretisation<scarp::Tri3> const disc(samples::distorted_block<scarp::Tri3>(3));
  auto const soil = scarp::LinearElastic<2>::from_lame(3e6, 2e6);
  Eigen::VectorXd const increment = samples::random_increment(disc.dof_count(), 0.02, 8);
  auto const points = samples::answers(soil, disc, samples::fresh<scarp::LinearElastic<2>>(disc), increment);
  Eigen::SparseMatrix<double> matrix;
  disc.stiffness(increment, points.stresses, points.tangents, matrix);
  Eigen::SparseMatrix<double> const first = matrix;
  double const* const memory = matrix.valuePtr();
  disc.stiffness(increment, points.stresses, points.tangents, matrix);
  CHECK(matrix.valuePtr() == memory);
  CHECK(std::equal(memory, memory + matrix.nonZeros(), first.valuePtr()));
  matrix.resize(3, 3);  // someone else's matrix is replaced
  disc.stiffness(increment, points.stresses, points.tangents, matrix);
  CHECK(Eigen::MatrixXd(matrix) == Eigen::MatrixXd(first));
}

TEST_CASE("an increment that is not finite cannot be committed") {
  scarp::Discretisation<scarp::Tri3> disc(samples::CrossedRectangle{}.generate());
  auto const saved = disc.positions();
  Eigen::VectorXd increment = Eigen::VectorXd::Constant(disc.dof_count(), 0.5);
  disc.commit(increment);
  CHECK(disc.positions() != saved);
  auto const moved = disc.positions();
  increment(3) = std::numeric_limits<double>::infinity();
  CHECK_REFUSED(disc.commit(increment), "displacement increment", "not finite");
  CHECK(disc.positions() == moved);
}

TEST_CASE("arrays of the wrong length and wrong thicknesses are refused") {
  scarp::Discretisation<scarp::Tri3> const disc(samples::CrossedRectangle{}.generate());
  std::vector<scarp::Gradient<2>> gradients(3);
  CHECK_REFUSED(disc.gradients(Eigen::VectorXd::Zero(disc.dof_count()), gradients), "3 entries", "4 are needed");
  gradients.resize(4);
  CHECK_REFUSED(disc.gradients(Eigen::VectorXd::Zero(3), gradients), "3 entries", "are needed");
  CHECK_REFUSED(scarp::Discretisation<scarp::Tri3>(samples::CrossedRectangle{}.generate(), 0.0), "thickness is 0");
  CHECK_REFUSED(scarp::Discretisation<scarp::Tet4>(samples::distorted_block<scarp::Tet4>(1), 0.2), "thickness is 0.2");
  CHECK_REFUSED(scarp::Discretisation<scarp::Tri3>(scarp::Mesh<scarp::Tri3>{}), "0 nodes", "empty");
}

namespace {

using scarp::Discretisation, scarp::SmallStrain;
static_assert(
    std::is_same_v<Discretisation<scarp::Quad4, SmallStrain>, Discretisation<scarp::Quad4, SmallStrain, scarp::BBar>>,
    "elements have their default integration, whatever their kinematics");
static_assert(Discretisation<scarp::Quad8, SmallStrain>::points_per_element == 4);
static_assert(Discretisation<scarp::Hex20, SmallStrain>::points_per_element == 8);
static_assert(Discretisation<scarp::Tet10>::points_per_element == 4);

}  // namespace
