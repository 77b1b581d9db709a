// SPDX-License-Identifier: BSL-1.0
#include "scarp/points/point_path.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/points/laboratory_paths.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;

constexpr double young = 20e6, poisson = 0.3, pressure = 1e5;
constexpr double lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
                 shear = young / (2.0 * (1.0 + poisson));
constexpr double strain = 0.01;
constexpr double tiny = 2e-9;  // the elastic strain of an increment of 1e-4 is its logarithm but for 1e-8 / 12
constexpr double degree = std::numbers::pi / 180.0;

template <int Dim>
scarp::GeostaticStress<Dim> confined() {
  return {.surcharge = pressure};
}

/// A point after a path in increments of a hundredth.
template <int Dim, class Provider>
struct Tested {
  scarp::MaterialPoints<Dim> points;
  scarp::PointPath<Dim> path;
  scarp::SerialExecutor serial{};

  Tested(Provider const& provider, scarp::PathConditions<Dim> conditions)
      : points(provider, std::array{scarp::Site<Dim>{}}), path(points, std::move(conditions), {.tolerance = 1e-11}) {}

  void go(double length, int increments = 100) {
    for (int k = 0; k < increments; ++k) {
      auto const report = path.advance(length / increments, serial);
      REQUIRE(report.verdict.acceptable());
      REQUIRE(report.done == 1.0);
    }
  }
};

template <int Dim>
auto elastic(scarp::PathConditions<Dim> conditions) {
  using Provider = scarp::LinearElastic<Dim, scarp::GeostaticStress<Dim>>;
  return Tested<Dim, Provider>(Provider::from_young_poisson(young, poisson, confined<Dim>()), std::move(conditions));
}

template <int Dim>
auto frictional(scarp::PathConditions<Dim> conditions, double stiffness = young, double dilation = 10.0 * degree,
                double cohesion = 0.0) {
  using Provider = scarp::MohrCoulomb<Dim, scarp::GeostaticStress<Dim>>;
  return Tested<Dim, Provider>({scarp::IsotropicElasticity::from_young_poisson(stiffness, poisson),
                                {{.cohesion = cohesion, .friction = 30.0 * degree, .dilation = dilation}},
                                confined<Dim>()},
                               std::move(conditions));
}

/// Changes of stress of an elastic point that begins with a pressure, and its lateral strain, positive in compression.
template <int Dim>
void check_elastic(scarp::PathConditions<Dim> conditions, double axial, double lateral, double lateral_strain) {
  auto test = elastic<Dim>(std::move(conditions));
  test.go(strain);
  auto const near = [](double value, double expected, double scale) {
    return std::abs(value - expected) < tiny * scale;
  };
  double const stress = std::max(std::abs(axial), pressure);
  for (int k = 0; k < Dim - 1; ++k) {
    CHECK(near(-test.path.stress(0)(k) - pressure, lateral, stress));
    CHECK(near(-test.path.strain(0)(k), lateral_strain, strain));
  }
  CHECK(near(-test.path.stress(0)(Dim - 1) - pressure, axial, stress));
  CHECK(near(test.path.length(), strain, strain));
  CHECK(test.points.committed_stress(0) == test.path.stress(0));
  CHECK(near(std::log(test.path.deformation(0).determinant()), test.path.strain(0).template head<Dim>().sum(), strain));
  test.go(-strain);  // and back
  CHECK((test.path.stress(0) + pressure * scarp::detail::trace<Dim>()).norm() < tiny * pressure);
}

template <int Dim>
double ratio(scarp::VoigtStress<Dim> const& stress) {
  return stress(Dim - 1) / stress(0);
}

}  // namespace

TEST_CASE("elastic points in the plane: the laboratory's paths in closed form") {
  double const drained = young * strain / (1.0 - poisson * poisson);
  check_elastic<2>(scarp::drained_path<2>(), drained, 0.0, -poisson / (1.0 - poisson) * strain);
  check_elastic<2>(scarp::undrained_path<2>(), 2.0 * shear * strain, -2.0 * shear * strain, -strain);
  check_elastic<2>(scarp::constant_mean_stress_path<2>(), 2.0 * shear * strain, -2.0 * shear * strain, -strain);
  check_elastic<2>(scarp::oedometer_path<2>(), (lambda + 2.0 * shear) * strain, lambda * strain, 0.0);
  double const bulk = (lambda + shear) * strain;  // length is the volumetric strain
  check_elastic<2>(scarp::isotropic_path<2>(), bulk, bulk, strain / 2.0);
  double const proportional = young * strain / ((1.0 + poisson) * (1.0 - poisson - poisson * 0.4));
  check_elastic<2>(scarp::proportional_stress_path<2>(0.4), proportional, 0.4 * proportional,
                   (1.0 + poisson) / young * ((1.0 - poisson) * 0.4 - poisson) * proportional);
  check_elastic<2>(scarp::proportional_strain_path<2>(0.4), (lambda * 1.4 + 2.0 * shear) * strain,
                   (lambda * 1.4 + 2.0 * shear * 0.4) * strain, 0.4 * strain);
}

TEST_CASE("elastic points in space: the laboratory's paths in closed form") {
  check_elastic<3>(scarp::drained_path<3>(), young * strain, 0.0, -poisson * strain);
  check_elastic<3>(scarp::undrained_path<3>(), 2.0 * shear * strain, -shear * strain, -strain / 2.0);
  check_elastic<3>(scarp::constant_mean_stress_path<3>(), 2.0 * shear * strain, -shear * strain, -strain / 2.0);
  check_elastic<3>(scarp::oedometer_path<3>(), (lambda + 2.0 * shear) * strain, lambda * strain, 0.0);
  double const bulk = (lambda + 2.0 / 3.0 * shear) * strain;
  check_elastic<3>(scarp::isotropic_path<3>(), bulk, bulk, strain / 3.0);
  double const proportional = young * strain / (1.0 - 2.0 * poisson * 0.4);
  check_elastic<3>(scarp::proportional_stress_path<3>(0.4), proportional, 0.4 * proportional,
                   (0.4 - poisson * 1.4) * proportional / young);
  check_elastic<3>(scarp::proportional_strain_path<3>(0.4), (lambda * 1.8 + 2.0 * shear) * strain,
                   (lambda * 1.8 + 2.0 * shear * 0.4) * strain, 0.4 * strain);
}

TEST_CASE_TEMPLATE("direct simple shear of an elastic point", Number, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  constexpr int dim = Number::value;
  constexpr int sheared = dim == 2 ? 2 : 4;
  constexpr double angle = 1e-4;
  for (auto const& conditions : {scarp::simple_shear_path<dim>(), scarp::simple_shear_at_stress_path<dim>()}) {
    auto test = elastic<dim>(conditions);
    test.go(angle, 10);
    // tau = G gamma; terms of second order are gamma times smaller.
    CHECK(test.path.stress(0)(sheared) == Approx(shear * angle).epsilon(2.0 * angle));
    CHECK(test.path.deformation(0)(0, dim - 1) == Approx(angle).epsilon(1e-4));
    CHECK(test.path.deformation(0)(dim - 1, 0) == 0.0);
    CHECK(test.path.stress(0)(dim - 1) == Approx(-pressure).epsilon(2.0 * angle));
  }
}

TEST_CASE("Mohr-Coulomb points, drained: ratio of principal stresses and dilation of compression and extension") {
  auto const check = [](auto test, double direction, double expected) {
    constexpr int dim = std::remove_reference_t<decltype(test.points)>::dim;
    test.go(direction * 0.05);
    CHECK(ratio<dim>(test.path.stress(0)) == Approx(expected).epsilon(tiny));
    auto const before = test.path.strain(0);
    test.go(direction * 0.01);
    // Flow on any planes of the surface: -d eps_v / sum of |d eps_i| = sin psi; all strain is plastic, stress is
    // constant.
    scarp::Vector<dim> const change = (test.path.strain(0) - before).template head<dim>();
    CHECK(change.sum() / change.cwiseAbs().sum() == Approx(std::sin(10.0 * degree)).epsilon(1e-7));
  };
  double const passive = 3.0;  // tan^2(45 + 30/2)
  check(frictional<2>(scarp::drained_path<2>()), 1.0, passive);
  check(frictional<2>(scarp::drained_path<2>()), -1.0, 1.0 / passive);
  check(frictional<3>(scarp::drained_path<3>()), 1.0, passive);
  check(frictional<3>(scarp::drained_path<3>()), -1.0, 1.0 / passive);
  // sigma_1 = N sigma_3 + 2 c sqrt N.
  check(frictional<3>(scarp::drained_path<3>(), young, 10.0 * degree, 2e3), 1.0,
        passive + 2.0 * 2e3 * std::sqrt(passive) / pressure);
  check(frictional<2>(scarp::constant_mean_stress_path<2>()), 1.0, passive);
  check(frictional<3>(scarp::constant_mean_stress_path<3>()), 1.0, passive);
}

TEST_CASE("Mohr-Coulomb points, undrained without dilation: the mean stress stays and limits the deviator") {
  double const sine = 0.5;  // of the friction
  auto plane = frictional<2>(scarp::undrained_path<2>(), young, 0.0);
  plane.go(0.05);
  // In the plane (s1 - s3)/2 = p sin phi.
  CHECK(plane.path.stress(0)(1) == Approx(-pressure * (1.0 + sine)).epsilon(tiny));
  CHECK(plane.path.stress(0)(0) == Approx(-pressure * (1.0 - sine)).epsilon(tiny));
  constexpr double volume = 2e-7;  // sum of e^3 / 12 over 100 increments, times the bulk modulus over the pressure
  auto space = frictional<3>(scarp::undrained_path<3>(), young, 0.0);
  space.go(0.05);
  // In space q = 6 sin phi / (3 - sin phi) p.
  auto const& stress = space.path.stress(0);
  CHECK(stress.head<3>().mean() == Approx(-pressure).epsilon(volume));
  CHECK(stress(0) - stress(2) == Approx(6.0 * sine / (3.0 - sine) * pressure).epsilon(volume));
}

TEST_CASE("Mohr-Coulomb points in direct simple shear end where the horizontal neither lengthens nor shortens") {
  // tau / sigma_n = sin phi cos psi / (1 - sin phi sin psi) (Davis 1968), with stiff elasticity: the spin of the stress
  // shifts it by the order of the stress over the stiffness, 5e-5.
  auto const check = [](auto test, double dilation) {
    test.go(0.04, 400);
    auto const& stress = test.path.stress(0);
    CHECK(-stress(2) / stress(1) == Approx(0.5 * std::cos(dilation) / (1.0 - 0.5 * std::sin(dilation))).epsilon(1e-3));
  };
  check(frictional<2>(scarp::simple_shear_at_stress_path<2>(), 2e9, 0.0), 0.0);
  check(frictional<2>(scarp::simple_shear_at_stress_path<2>(), 2e9, 10.0 * degree), 10.0 * degree);
  auto undrained = frictional<2>(scarp::simple_shear_path<2>(), 2e9, 0.0);
  undrained.go(0.04, 400);
  CHECK(undrained.path.stress(0)(2) == Approx(0.5 * pressure).epsilon(1e-3));
  CHECK(undrained.path.stress(0)(1) == Approx(-pressure).epsilon(1e-3));
}

TEST_CASE("points of one path keep their own stresses, and targets are reached by all") {
  using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  std::array const sites{scarp::Site<2>{.index = 0, .depth = 1.0}, scarp::Site<2>{.index = 1, .depth = 4.0}};
  scarp::MaterialPoints<2> points(Soil::from_young_poisson(young, poisson, {.unit_weight = 2e4, .k0 = 0.5}), sites);
  scarp::PointPath<2> path(points, scarp::drained_path<2>());
  scarp::SerialExecutor serial;
  CHECK(path.advance(1e-3, serial).verdict.acceptable());
  CHECK(path.stress(0)(0) == Approx(-1e4).epsilon(1e-5));
  CHECK(path.stress(1)(0) == Approx(-4e4).epsilon(1e-5));
  auto conditions = scarp::undrained_path<2>();
  conditions[0] = {.of_stress = {0.0, 1.0, 0.0}, .target = -9e4};
  conditions[1] = {.of_strain = {1.0, 0.0, 0.0}, .target = 2e-3};
  path.load(conditions);
  for (int k = 0; k < 4; ++k) CHECK(path.advance(0.25, serial).done == 1.0);
  for (int k = 0; k < 2; ++k) {
    CHECK(path.stress(k)(1) == Approx(-9e4).epsilon(1e-5));
    CHECK(path.strain(k)(0) == Approx(2e-3).epsilon(1e-9));
  }
}

TEST_CASE("a stress beyond the strength is no increment: the path ends with a reason at the last state that bears") {
  auto conditions = scarp::drained_path<2>();
  conditions[0] = {.of_stress = {0.0, 1.0, 0.0}, .target = -4.0 * pressure};  // 3 times is the strength
  auto test = frictional<2>(conditions);
  auto const report = test.path.advance(1.0, test.serial);
  CHECK(report.verdict.status == scarp::Status::not_converged);
  CHECK(report.cut_backs >= 12);
  CHECK(report.done < 2.0 / 3.0);
  CHECK(report.done == Approx(2.0 / 3.0).epsilon(1e-3));  // 12 halvings
  CHECK(ratio<2>(test.path.stress(0)) == Approx(3.0).epsilon(1e-3));
  CHECK(test.points.committed_stress(0) == test.path.stress(0));
}

TEST_CASE("conditions that make no path are rejected") {
  auto conditions = scarp::drained_path<2>();
  conditions[1].of_strain = {1.0, 0.0, 0.0};
  CHECK_REFUSED(elastic<2>(conditions), "controls strain and stress");
  conditions[1] = {};
  CHECK_REFUSED(elastic<2>(conditions), "or neither");
  conditions.pop_back();
  CHECK_REFUSED(elastic<2>(conditions), "2 conditions (the strain has 3 components)");
  CHECK_REFUSED(scarp::proportional_stress_path<2>(std::nan("")), "is nan");
  CHECK_REFUSED(elastic<2>({conditions[0], conditions[0], scarp::drained_path<2>()[1]}), "follows from the others");
}
