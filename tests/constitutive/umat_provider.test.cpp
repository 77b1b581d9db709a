// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/umat_provider.hpp"

#include <doctest/doctest.h>

#include "constitutive/provider_laws.hpp"
#include "constitutive/umats.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Approx;
using scarp::Gradient;

template <int Dim>
Gradient<Dim> shear(double angle) {
  Gradient<Dim> gradient = Gradient<Dim>::Zero();
  gradient(0, 1) = gradient(1, 0) = angle / 2.0;
  return gradient;
}

template <int Dim>
void follows_linear_elastic() {
  auto const umat = umats::elastic<Dim>();
  auto const own = scarp::LinearElastic<Dim>::from_lame(3e6, 2e6);
  auto state = umat.initial_state({});
  auto expected = own.initial_state({});
  // The same formulas in another order of operations: round-off of each step.
  CHECK((umat.tangent(state) - own.tangent(expected)).norm() <= 1e-15 * own.tangent(expected).norm());
  for (double const size : {0.02, -0.1, 0.3}) {
    auto const increment = provider_laws::ordinary_increment<Dim>(size);
    auto trial = state;
    auto trial_expected = expected;
    auto const response = umat.respond(state, increment, trial);
    auto const known = own.respond(expected, increment, trial_expected);
    CHECK(response.verdict.acceptable());
    CHECK((response.stress - known.stress).norm() <= 1e-14 * known.stress.norm());
    state = trial;
    expected = trial_expected;
  }
}

/// Analytic: in pure shear tau = (Y + H e)/sqrt(3) and gamma = tau/G + sqrt(3) e with the equivalent plastic strain e.
template <int Dim>
void hardens_in_shear() {
  auto const umat = umats::hardening<Dim>();
  double const modulus = umat.properties[0], yield = umat.properties[2], hardening = umat.properties[3];
  constexpr int shear_place = Dim == 2 ? 2 : 5;
  auto state = umat.initial_state({});
  int const steps = 40;
  double const whole = 0.02;
  for (int step = 0; step < steps; ++step) {
    auto trial = state;
    CHECK(umat.respond(state, shear<Dim>(whole / steps), trial).verdict.acceptable());
    state = trial;
  }
  double const plastic =
      (whole - yield / (std::sqrt(3.0) * modulus)) / (hardening / (std::sqrt(3.0) * modulus) + std::sqrt(3.0));
  // The strain of an increment of its half-way configuration differs from gamma by gamma^3/12, 1e-8 of gamma^2 each.
  CHECK(state.variables[0] == Approx(plastic).epsilon(1e-6));
  CHECK(umat.stress(state)(shear_place) == Approx((yield + hardening * plastic) / std::sqrt(3.0)).epsilon(1e-6));
  CHECK(state.variables[1] == steps);
  auto const slope = modulus * hardening / (3.0 * modulus + hardening);
  CHECK(umat.tangent(state)(shear_place, shear_place) == Approx(slope).epsilon(1e-6));
}

template <int Dim>
void tangent_is_the_derivative() {
  auto const umat = umats::hardening<Dim>();
  auto const start = umat.initial_state({});
  scarp::Tensor<Dim> strain = provider_laws::ordinary_increment<Dim>(0.01);
  strain = (strain + strain.transpose()).eval() / 2.0;
  auto trial = start;
  REQUIRE(umat.respond(start, strain, trial).verdict.acceptable());
  REQUIRE(trial.variables[0] > 1e-3);
  auto const tangent = umat.tangent(trial);
  double const step = 1e-6;
  for (int k = 0; k < scarp::voigt_size<Dim>; ++k) {
    auto more = start, less = start;
    auto const up = umat.respond(start, strain + step * scarp::unit_strain<Dim>(k), more).stress;
    auto const down = umat.respond(start, strain - step * scarp::unit_strain<Dim>(k), less).stress;
    // E = 2 (U - I)(U + I)^-1 has a derivative of 1 - eps: a hundredth of the stiffness.
    CHECK(((up - down) / (2.0 * step) - tangent.col(k)).norm() <= 0.015 * tangent.norm());
  }
}

scarp::UmatProvider<2> odd(double wish) {
  return {.umat = umats::odd, .name = "Clay", .properties = {wish}, .variables = {3.0}};
}

template <class Provider>
scarp::Response<2> response_of(Provider const& provider) {
  auto const state = provider.initial_state({});
  auto trial = state;
  auto const response = provider.respond(state, shear<2>(1e-3), trial);
  if (!response.verdict.acceptable()) {
    CHECK(trial.stress == state.stress);
    CHECK(trial.variables == state.variables);
  }
  return response;
}

}  // namespace

TEST_CASE("a UMAT of linear elasticity gives the stresses of LinearElastic, rotations included") {
  follows_linear_elastic<2>();
  follows_linear_elastic<3>();
}

TEST_CASE("a UMAT of von Mises' plasticity hardens in pure shear by its closed form") {
  hardens_in_shear<2>();
  hardens_in_shear<3>();
}

TEST_CASE("the tangent of a UMAT is the derivative of its stress in the order of components of this library") {
  tangent_is_the_derivative<2>();
  tangent_is_the_derivative<3>();
}

TEST_CASE(
    "a UMAT keeps no trial: from a committed state it responds with the same bits, and its calls are not counted up") {
  auto const umat = umats::hardening<2>();
  auto const state = umat.initial_state({});
  auto first = state, second = state;
  static_cast<void>(umat.respond(state, shear<2>(0.01), first));
  static_cast<void>(umat.respond(state, shear<2>(0.03), second));
  static_cast<void>(umat.respond(state, shear<2>(0.01), second));
  CHECK(state.variables == std::vector{0.0, 0.0});
  CHECK(second.variables == first.variables);
  CHECK(second.variables[1] == 1.0);
  CHECK(second.stress == first.stress);
}

TEST_CASE("points of a UMAT are saved and resume with the same bits") {
  auto const umat = umats::hardening<3>();
  std::vector<scarp::Site<3>> const sites(2);
  scarp::SerialExecutor executor;
  scarp::MaterialPoints<3> points(umat, sites), others(umat, sites);
  auto const step = [&](scarp::MaterialPoints<3>& batch) {
    for (int k = 0; k < batch.size(); ++k) batch.gradient(k) = shear<3>(0.01 * (k + 1));
    REQUIRE(batch.respond(executor).verdict.acceptable());
    batch.commit();
  };
  step(points);
  others.unpack(0, points.pack(0));
  others.unpack(1, points.pack(1));
  step(points);
  step(others);
  CHECK(others.committed_stress(1) == points.committed_stress(1));
  CHECK(others.committed_tangent(0) == points.committed_tangent(0));
  CHECK(others.pack(1) == points.pack(1));
  CHECK(points.state<scarp::UmatProvider<3>::State>(1).variables[1] == 2.0);
}

TEST_CASE("points of a UMAT without SAVE respond with the same bits on several threads") {
  std::vector<scarp::Site<2>> const sites(1000);
  scarp::SerialExecutor serial;
  scarp::ThreadExecutor threads(4);
  scarp::MaterialPoints<2> points(umats::hardening<2>(), sites), others(umats::hardening<2>(), sites);
  for (int k = 0; k < points.size(); ++k) points.gradient(k) = others.gradient(k) = shear<2>(3e-5 * k);
  CHECK(points.respond(serial).verdict.acceptable());
  CHECK(others.respond(threads).verdict.acceptable());
  CHECK(others.stresses() == points.stresses());
  points.commit();
  others.commit();
  CHECK(others.pack(999) == points.pack(999));
  CHECK(points.state<scarp::UmatProvider<2>::State>(999).variables[0] > 1e-2);
}

TEST_CASE("a point of a UMAT is copied, but not mirrored: nothing is known of its state variables") {
  std::vector<scarp::Site<2>> const sites(2);
  scarp::SerialExecutor executor;
  scarp::MaterialPoints<2> points(umats::hardening<2>(), sites);
  points.gradient(0) = shear<2>(0.01);
  points.gradient(1).setZero();
  REQUIRE(points.respond(executor).verdict.acceptable());
  points.commit();
  CHECK_REFUSED(points.copy(1, points, 0, true), "cannot be mirrored", "'variables'");
  CHECK(points.committed_stress(1).isZero(0.0));
  points.copy(1, points, 0);
  CHECK(points.pack(1) == points.pack(0));
}

TEST_CASE("a UMAT that writes outside of its arrays is rejected with the name of the array") {
  CHECK_REFUSED(response_of(odd(1.0)), "Clay", "STATEV", "1 numbers");
  CHECK_REFUSED(response_of(odd(2.0)), "Clay", "STRESS", "4 numbers");
  CHECK_REFUSED(response_of(odd(3.0)), "Clay", "DDSDDE", "16 numbers");
}

TEST_CASE("a UMAT that requests a smaller step does not converge, one that gives NaN fails") {
  CHECK(response_of(odd(4.0)).verdict == scarp::Verdict{scarp::Status::not_converged, scarp::Reason::no_return});
  CHECK(response_of(odd(5.0)).verdict == scarp::Verdict{scarp::Status::failed, scarp::Reason::not_finite});
}

TEST_CASE("a UMAT receives the name of its material and the increment by strain and by deformation") {
  auto const received = response_of(odd(6.0)).stress;
  CHECK(received(0) == 1.0);
  CHECK(received(1) == Approx(5e-4).epsilon(1e-12));
  CHECK(received(2) == Approx(1e-3).epsilon(1e-6));  // E differs by a quarter of the square
}

TEST_CASE("a UMAT receives the total strain in axes that have turned with the increment") {
  auto const umat = odd(7.0);
  auto const start = umat.initial_state({});
  auto strained = start, turned = start;
  static_cast<void>(umat.respond(start, shear<2>(1e-3), strained));
  scarp::Tensor<2> const turn = scarp::rotation(0.5);
  auto const received = umat.respond(strained, turn * 1.000001 - scarp::Tensor<2>::Identity(), turned).stress;
  // Analytic: gamma turned by the angle a gives -gamma/2 sin 2a, gamma/2 sin 2a and gamma cos 2a, up to gamma squared.
  CHECK(received(0) == Approx(-5e-4 * std::sin(1.0)).epsilon(2e-3));
  CHECK(received(1) == Approx(5e-4 * std::sin(1.0)).epsilon(2e-3));
  CHECK(received(2) == Approx(1e-3 * std::cos(1.0)).epsilon(2e-3));
}

TEST_CASE("a UMAT receives the number of its increment") {
  scarp::UmatProvider<2> umat = odd(8.0);
  umat.time_step = 0.1;
  auto state = umat.initial_state({});
  for (int k = 1; k <= 12; ++k) {
    auto trial = state;
    CHECK(umat.respond(state, shear<2>(1e-3), trial).stress(0) == k);
    CHECK(umat.respond(state, shear<2>(2e-3), trial).stress(0) == k);  // a second trial of the same increment
    state = trial;
  }
}

TEST_CASE("a UMAT receives the size and number of its element, and of its point in it, from a grid") {
  // Analytic: cells of 3 m by 0.75 m have the root 1.5 m; nodes between the corners halve it.
  auto const received = [](auto const& grid, int point) {
    auto const umat = odd(9.0);
    auto const start = umat.initial_state(grid.site(point, 0.0));
    auto end = start;
    return umat.respond(start, shear<2>(1e-3), end).stress;
  };
  scarp::BoxMesh<scarp::Quad4> const cells{.lengths = {9.0, 1.5}, .cells = {3, 2}};
  auto const quads = received(scarp::Discretisation<scarp::Quad4>(cells.generate(), 0.2), 14);
  CHECK(quads(0) == Approx(1.5).epsilon(1e-14));
  CHECK(quads(1) == 4.0);
  CHECK(quads(2) == 3.0);
  scarp::BoxMesh<scarp::Tri6> const cell{.lengths = {3.0, 1.5}};
  auto const triangles = received(scarp::Discretisation<scarp::Tri6>(cell.generate()), 3);
  CHECK(triangles(0) == Approx(std::sqrt(2.25) / 2.0).epsilon(1e-14));
  CHECK(triangles(1) == 2.0);
  CHECK(triangles(2) == 1.0);
  auto const umat = odd(9.0);
  auto const alone = umat.initial_state({.index = 6});
  auto end = alone;
  CHECK(umat.respond(alone, shear<2>(1e-3), end).stress == scarp::VoigtStress<2>(1.0, 7.0, 1.0));
}

TEST_CASE("what a UMAT receives of a place belongs to the point, wherever its state comes from") {
  scarp::SerialExecutor serial;
  std::vector<scarp::Site<2>> const sites{{.index = 0, .element = 0, .place = 0, .size = 2.0},
                                          {.index = 1, .element = 4, .place = 3, .size = 0.5}};
  for (bool const by_copy : {true, false}) {
    scarp::MaterialPoints<2> points(odd(9.0), sites);
    by_copy ? points.copy(1, points, 0) : points.unpack(1, points.pack(0));
    for (int k = 0; k < 2; ++k) points.gradient(k) = shear<2>(1e-3);
    REQUIRE(points.respond(serial).verdict.acceptable());
    CHECK(points.stress(1) == scarp::VoigtStress<2>(0.5, 5.0, 4.0));
  }
}

TEST_CASE("a UMAT that loses its tangent, requests a step of NaN or leaves its arrays is found out") {
  auto const umat = [](double wish) {
    return scarp::UmatProvider<2>{
        .umat = umats::tangent_once, .name = "loam", .properties = {5e6, wish}, .variables = {0.0}};
  };
  auto const strained = [&](double wish) {
    auto const one = umat(wish);
    auto const start = one.initial_state({});
    auto end = start, after = start;
    scarp::Gradient<2> const increment{{1e-3, 0.0}, {0.0, -2e-3}};
    if (auto const verdict = one.respond(start, increment, end).verdict; !verdict.acceptable()) return verdict;
    return one.respond(end, increment, after).verdict;
  };
  CHECK_REFUSED(strained(0.0), "'loam'", "leaves DDSDDE zero");
  CHECK(strained(1.0) == scarp::Verdict{scarp::Status::not_converged, scarp::Reason::no_return});
  CHECK_REFUSED(strained(2.0), "'loam'", "reads beyond its arrays");
  CHECK_REFUSED(strained(3.0), "'loam'", "DFGRD1");
  CHECK(strained(4.0).acceptable());
}

TEST_CASE("a state of another UMAT is told by its number of variables") {
  auto const few = umats::hardening<2>();
  auto more = few;
  more.variables.push_back(0.0);
  CHECK_REFUSED(more.require_fitting(few.initial_state({})), "2 state variables", "has 3");
  CHECK_NOTHROW(few.require_fitting(few.initial_state({})));
}

TEST_CASE("a UMAT that is written for space serves in plane strain, and is found out with four components") {
  scarp::UmatProvider<2> umat{.umat = umats::of_space, .properties = {4e6}, .variables = {0.0}, .components = 6};
  auto const start = umat.initial_state({});
  auto end = start;
  CHECK(umat.tangent(start) == scarp::VoigtTangent<2>(4e6 * scarp::VoigtTangent<2>::Identity()));
  CHECK(umat.respond(start, shear<2>(2e-3), end).stress(2) == Approx(8e3).epsilon(1e-5));
  CHECK(end.variables[0] == 0.0);
  umat.components = 4;
  CHECK_REFUSED(umat.initial_state({}), "wrote outside of", "components included");
  umat.components = 3;
  CHECK_REFUSED(umat.initial_state({}), "3 components", "6 of one for space");
  scarp::UmatProvider<3> const in_space{
      .umat = umats::of_space, .properties = {4e6}, .variables = {0.0}, .components = 4};
  CHECK_REFUSED(in_space.initial_state({}), "4 components");
}

TEST_CASE("a UMAT that forgets the initial stress is rejected, and without initial stress serves") {
  scarp::UmatProvider<2, scarp::GeostaticStress<2>> umat{.umat = umats::forgetful, .name = "loam", .properties = {5e6}};
  auto const start = umat.initial_state({.depth = 4.0});
  auto end = start;
  CHECK(umat.respond(start, shear<2>(1e-3), end).verdict.acceptable());
  umat.initial = {.surcharge = 2e3, .unit_weight = 18e3, .k0 = 0.6};
  CHECK_REFUSED(umat.initial_state({.depth = 4.0}), "loam", "-44400, -74000, -44400 Pa become 0, 0, 0");
  umat.umat = umats::careless;
  umat.properties = {5e6, 0.0};
  CHECK(umat.stress(umat.initial_state({.depth = 4.0}))(1) == Approx(-74e3).epsilon(1e-14));
}

TEST_CASE("a UMAT without a tangent, and one that reads beyond its arrays, are rejected before the first step") {
  scarp::UmatProvider<3> umat{.umat = umats::careless, .name = "silt", .properties = {5e6, 1.0}, .variables = {0.0}};
  CHECK_REFUSED(umat.initial_state({}), "silt", "leaves DDSDDE zero");
  for (double const wish : {2.0, 3.0, 4.0}) {
    umat.properties[1] = wish;
    CHECK_REFUSED(umat.initial_state({}), "reads beyond its arrays", "state variables");
  }
}

TEST_CASE("of a name that CMNAME cannot hold a UMAT gets the beginning where another provider made the state") {
  auto umat = odd(6.0);
  auto const state = umat.initial_state({});
  umat.name.resize(10'000, ' ');
  auto trial = state;
  CHECK(umat.respond(state, scarp::Gradient<2>::Identity() * 1e-3, trial).stress(0) == 1.0);
}

TEST_CASE("a provider without a UMAT, with a name that CMNAME cannot hold, or without time, is rejected") {
  CHECK_REFUSED(scarp::UmatProvider<2>{}.initial_state({}), "no UMAT");
  CHECK_REFUSED((scarp::UmatProvider<2>{.umat = umats::odd, .name = std::string(81, 'a')}.initial_state({})),
                "81 letters");
  CHECK_REFUSED((scarp::UmatProvider<2>{.umat = umats::odd, .time_step = 0.0}.initial_state({})), "time step", "0");
  scarp::UmatProvider<2> const undefined{
      .umat = umats::von_mises, .properties = std::vector<double>(4, NAN), .variables = {0.0, 0.0}};
  CHECK_REFUSED(undefined.initial_state({}), "zero increment", "UMAT");
}
