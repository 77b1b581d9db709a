// SPDX-License-Identifier: BSL-1.0
#include "scarp/constitutive/linear_elastic.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "support/approx.hpp"
#include "support/refusals.hpp"

namespace {

using Elastic = scarp::LinearElastic<2>;
using scarp::Gradient;
using scarp::VoigtStress;

struct DepthBlind {
  VoigtStress<2> at() const { return VoigtStress<2>::Zero(); }
};

static_assert(!scarp::InitialStressField<DepthBlind, 2>, "a field that does not take the depth must be refused");
static_assert(!scarp::InitialStressField<scarp::StressFree<3>, 2>, "a field of the wrong dimension must be refused");

struct Forgetful : Elastic {
  using State = void;
};
static_assert(!scarp::ConstitutiveProvider<Forgetful>, "a provider without a state that can be copied must be refused");

Gradient<2> sample_gradient() {
  Gradient<2> gradient;
  gradient << 0.02, 0.015, -0.01, -0.03;
  return gradient;
}

}  // namespace

TEST_CASE("oedometric compression gives the constrained modulus and the ratio of Lame's moduli") {
  auto const soil = Elastic::from_lame(3e6, 2e6);
  Gradient<2> gradient = Gradient<2>::Zero();
  gradient(1, 1) = -1e-3;
  Elastic::State trial;
  auto const answer = soil.respond({}, gradient, trial);
  // Analytic: E = 2 e / (2 + e) along the axis, vertical (lambda + 2 G) E, horizontal lambda E.
  double const strain = -2e-3 / (2.0 - 1e-3);
  CHECK(answer.verdict == scarp::Verdict{});
  CHECK(answer.stress(1) == samples::Approx(7e6 * strain).epsilon(1e-12));  // round-off: 1e-16 over a strain of 1e-3
  CHECK(answer.stress(0) == samples::Approx(3e6 * strain).epsilon(1e-12));
  CHECK(std::abs(answer.stress(2)) < 1e-8);
  CHECK(soil.stress(trial) == answer.stress);
}

TEST_CASE("Young's modulus and Poisson's ratio are turned into Lame's moduli") {
  auto const steel = Elastic::from_young_poisson(210e9, 0.3);
  // Analytic: lambda = E nu / ((1 + nu)(1 - 2 nu)), G = E / (2 (1 + nu)); round-off.
  CHECK(steel.elasticity.lame_lambda == samples::Approx(210e9 * 0.3 / (1.3 * 0.4)).epsilon(1e-14));
  CHECK(steel.elasticity.shear_modulus == samples::Approx(210e9 / 2.6).epsilon(1e-14));
}

TEST_CASE("a pure rotation turns the stress exactly, at every angle") {
  auto const soil = Elastic::from_lame(3e6, 2e6);
  Elastic::State const committed{{-2e5, -5e5, 1e5}};
  for (double const angle : {1e-8, 0.5235987755982988, 1.5707963267948966, 2.9, 3.141592653589793, -1.0}) {
    auto const turn = scarp::rotation(angle);
    Elastic::State trial;
    auto const answer = soil.respond(committed, turn - Gradient<2>::Identity(), trial);
    scarp::Tensor<2> const turned = turn * scarp::from_voigt_stress<2, double>(committed.stress) * turn.transpose();
    // Analytic: sigma' = R sigma R^T; the error is round-off of the stretch times the modulus.
    CHECK((answer.stress - scarp::to_voigt_stress<2, double>(turned)).norm() < 1e-12 * 7e6 * 10.0);
  }
}

TEST_CASE("a rotation on top of a deformation turns the answer and changes nothing else") {
  auto const soil = Elastic::from_lame(3e6, 2e6);
  Elastic::State const committed{{-2e5, -5e5, 1e5}};
  Elastic::State trial;
  Gradient<2> const identity = Gradient<2>::Identity();
  auto const plain = soil.respond(committed, sample_gradient(), trial);
  auto const turn = scarp::rotation(1.1);
  Gradient<2> const deformation = turn * (identity + sample_gradient());
  auto const answer = soil.respond(committed, deformation - identity, trial);
  scarp::Tensor<2> const turned = turn * scarp::from_voigt_stress<2, double>(plain.stress) * turn.transpose();
  // Analytic: objectivity; round-off of the stretch times the modulus.
  CHECK((answer.stress - scarp::to_voigt_stress<2, double>(turned)).norm() < 1e-12 * 7e6 * 10.0);
}

TEST_CASE("one increment and the same in two halves differ by third order only") {
  auto const soil = Elastic::from_lame(3e6, 2e6);
  auto const stretch_in = [&](double strain, int parts) {
    Elastic::State state;
    double const factor = std::pow(1.0 + strain, 1.0 / parts);
    Gradient<2> part = Gradient<2>::Zero();
    part(0, 0) = factor - 1.0;
    for (int k = 0; k < parts; ++k) {
      Elastic::State trial;
      REQUIRE(soil.respond(state, part, trial).verdict.acceptable());
      state = trial;
    }
    return state.stress(0);
  };
  // Analytic: E = ln(1 + e) - e^3/12 + ..., so one step against many lacks (lambda + 2 G) e^3/12; the next terms of the
  // series are e and e^2 times smaller, below 4 % at e = 0.02.
  double const large = stretch_in(0.02, 64) - stretch_in(0.02, 1);
  CHECK(large == samples::Approx(7e6 * std::pow(0.02, 3) / 12.0).epsilon(0.04));
  double const small = stretch_in(0.01, 64) - stretch_in(0.01, 1);
  CHECK(large / small == samples::Approx(8.0).epsilon(0.04));
}

TEST_CASE_TEMPLATE("the tangent is the derivative of the stress with the strain", Model, scarp::LinearElastic<2>,
                   scarp::LinearElastic<3>) {
  constexpr int dim = Model::dim;
  auto const soil = Model::from_lame(3e6, 2e6);
  typename Model::State const committed{VoigtStress<dim>::LinSpaced(-5e5, 1e5)};
  auto const tangent = soil.tangent(committed);
  constexpr auto indices = scarp::voigt_indices<dim>();
  double const step = 1e-5;
  for (int k = 0; k < scarp::voigt_size<dim>; ++k) {
    auto const [i, j] = indices[static_cast<std::size_t>(k)];
    Gradient<dim> gradient = Gradient<dim>::Zero();
    gradient(i, j) += step / 2.0;
    gradient(j, i) += step / 2.0;
    typename Model::State trial;
    VoigtStress<dim> const up = soil.respond(committed, gradient, trial).stress;
    VoigtStress<dim> const down = soil.respond(committed, -gradient, trial).stress;
    // Central difference: truncation step^2 = 1e-10, round-off 1e-16/step = 1e-11, both relative to the modulus.
    CHECK(((up - down) / (2.0 * step) - tangent.col(k)).norm() < 1e-8 * 7e6);
  }
}

TEST_CASE("committed state is untouched and a failed answer leaves it as the trial state") {
  auto const soil = Elastic::from_lame(3e6, 2e6);
  Elastic::State const committed{{-2e5, -5e5, 1e5}};
  Elastic::State trial;
  Gradient<2> broken = Gradient<2>::Zero();
  broken(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(soil.respond(committed, broken, trial).verdict ==
        scarp::Verdict{scarp::Status::failed, scarp::Reason::not_finite});
  CHECK(trial.stress == committed.stress);
  Gradient<2> inside_out = Gradient<2>::Zero();
  inside_out(0, 0) = -1.5;
  CHECK(soil.respond(committed, inside_out, trial).verdict ==
        scarp::Verdict{scarp::Status::failed, scarp::Reason::element_inverted});
  CHECK(trial.stress == committed.stress);
}

TEST_CASE("points start with the stress of their depth") {
  scarp::GeostaticStress<2> const ground{.surcharge = 1e4, .unit_weight = 2e4, .k0 = 0.5};
  auto const soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>::from_lame(3e6, 2e6, ground);
  scarp::Site<2> site;
  site.depth = 10.0;
  // Analytic: vertical -(1e4 + 2e4 * 10), horizontal half of it, no shear; exact in binary.
  CHECK(soil.stress(soil.initial_state(site)) == VoigtStress<2>(-1.05e5, -2.1e5, 0.0));
  site.depth = -1e-12;  // round-off: the surcharge only
  CHECK(soil.stress(soil.initial_state(site)) == VoigtStress<2>(-5e3, -1e4, 0.0));
  site.depth = -3.0;
  CHECK_REFUSED(soil.initial_state(site), "3 m above the ground surface");
  VoigtStress<3> expected;
  expected << -1.05e5, -1.05e5, -2.1e5, 0.0, 0.0, 0.0;  // the vertical is the last axis
  CHECK(scarp::GeostaticStress<3>{1e4, 2e4, 0.5}.at(10.0) == expected);
  // Water from 4 m down lifts 6 kN/m3: 36 kPa at 10 m; from a pond on, 60 kPa.
  CHECK(scarp::GeostaticStress<2>{1e4, 2e4, 0.5, {.water_table = 4.0, .lift = 6e3}}.at(10.0)(1) == -174e3);
  CHECK(scarp::GeostaticStress<2>{1e4, 2e4, 0.5, {.water_table = -2.0, .lift = 6e3}}.at(10.0)(1) == -150e3);
  CHECK(scarp::GeostaticStress<2>{1e4, 2e4, 0.5, {.water_table = 4.0, .lift = 6e3}}.at(4.0)(1) == -90e3);
  CHECK(Elastic::from_lame(3e6, 2e6).initial_state(site).stress.isZero(0.0));
}

TEST_CASE("parameters of an unstable material are refused") {
  CHECK_REFUSED(Elastic::from_lame(1e6, 0.0), "shear modulus is 0");
  CHECK_REFUSED(Elastic::from_lame(std::numeric_limits<double>::quiet_NaN(), 1e6), "lambda is nan");
  CHECK_REFUSED(Elastic::from_lame(-1e6, 1e6), "bulk modulus is -");
  CHECK_NOTHROW(Elastic::from_lame(-0.6e6, 1e6));
  CHECK_REFUSED(Elastic::from_young_poisson(1e6, 0.5), "Poisson's ratio is 0.5");
  CHECK_REFUSED(Elastic::from_young_poisson(1e6, -1.0), "Poisson's ratio is -1");
  CHECK_REFUSED(Elastic::from_young_poisson(-1e6, 0.3), "Young's modulus is -1");
}
