// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/tangent_rules.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "support/approx.hpp"
#include "support/factorisations.hpp"

namespace {

using Strain = scarp::EngineeringStrain<2>;
using Stress = scarp::VoigtStress<2>;
using Tangent = scarp::VoigtTangent<2>;

Tangent elastic() { return scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3).tangent({}); }

double min_eigenvalue(Tangent const& tangent) { return samples::eigenvalues((tangent + tangent.transpose()) / 2.0)(0); }

// Of one update of numbers of order 1e7.
constexpr double round_off = 1e-13;

}  // namespace

TEST_CASE("after an update the tangent maps the last change of strain to the change of stress") {
  scarp::PointwiseBroyden const rule;
  Strain const strain(1e-3, -2e-3, 5e-4);
  Stress const stress = 0.7 * elastic() * strain;
  Tangent const updated = rule.update<2>(elastic(), elastic(), strain, stress);
  CHECK(min_eigenvalue(updated) > rule.floor * elastic().trace() / 3.0);  // the floor does not disturb this
  CHECK((updated * strain - stress).norm() < round_off * stress.norm());
  // Analytic (Broyden 1965): directions at right angles to the change keep their answer.
  Strain const across = Strain(2e-3, 1e-3, 0.0);
  REQUIRE(across.dot(strain) == 0.0);
  CHECK((updated * across - elastic() * across).norm() < round_off * (elastic() * across).norm());
}

TEST_CASE("a tangent that softens is raised to the floor") {
  scarp::PointwiseBroyden const rule{.floor = 0.1};
  Strain const strain(1e-3, -1e-3, 0.0);
  Tangent const updated = rule.update<2>(elastic(), elastic(), strain, -2.0 * elastic() * strain);
  double const floor = 0.1 * elastic().trace() / 3.0;
  CHECK(min_eigenvalue(updated) == samples::Approx(floor).epsilon(1e-9));
  scarp::PointwiseBroyden const no_floor{.floor = -1e300};
  Tangent const lowered = no_floor.update<2>(elastic(), elastic(), strain, -2.0 * elastic() * strain);
  CHECK(min_eigenvalue(lowered) < 0.0);
}

TEST_CASE("a change of strain that is noise teaches nothing") {
  scarp::PointwiseBroyden const rule{.min_strain_change = 1e-7};
  Stress const noise(1e3, -2e3, 1e3);
  CHECK(rule.update<2>(elastic(), elastic(), Strain(0.9e-7, 0.0, 0.0), noise) == elastic());
  CHECK(rule.update<2>(elastic(), elastic(), Strain::Zero(), noise) == elastic());
  CHECK(rule.update<2>(elastic(), elastic(), Strain::Constant(std::numeric_limits<double>::quiet_NaN()), noise) ==
        elastic());
  CHECK(rule.update<2>(elastic(), elastic(), Strain(1.1e-7, 0.0, 0.0), noise) != elastic());
}

TEST_CASE("a step starts between what the provider says and what was learned") {
  scarp::PointwiseBroyden const rule{.provider_share = 0.25};
  Tangent const learned = 0.2 * elastic();
  CHECK((rule.start<2>(elastic(), learned) - 0.4 * elastic()).norm() < round_off * elastic().norm());
}

TEST_CASE(
    "a tangent that learns from simple shear under an initial stress learns the shear modulus, not the rotation") {
  // G = 100 kPa at (-40, -100) kPa. The raw change of Cauchy's stress in simple shear g is (G + (s_yy - s_xx)/2) g: 70
  // kPa.
  using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  auto const soil = Soil::from_lame(100e3, 100e3, {.surcharge = 100e3, .unit_weight = 0.0, .k0 = 0.4});
  auto const committed = soil.initial_state({});
  auto state = committed;
  scarp::Gradient<2> shear = scarp::Gradient<2>::Zero();
  shear(0, 1) = 1e-5;
  Stress const before = soil.stress(committed);
  Stress const after = soil.respond(committed, shear, state).stress;
  scarp::PointwiseBroyden const rule;
  auto const start =
      scarp::VoigtTangent<2>((scarp::VoigtTangent<2>() << 300e3, 100e3, 0, 100e3, 300e3, 0, 0, 0, 50e3).finished());
  auto const learned_from = [&](scarp::EngineeringStrain<2> const& strain, Stress const& change) {
    return rule.update<2>(start, start, strain, change)(2, 2);
  };
  auto const raw = learned_from(scarp::to_engineering_strain<2, double>(shear), after - before);
  auto const change = scarp::corotated_secant_pair<2>(scarp::Gradient<2>::Zero(), shear, before, after);
  CHECK(std::abs(raw - 70e3) < 100.0);
  CHECK(std::abs(learned_from(change.strain, change.stress) - 100e3) < 100.0);  // errors of the order of the shear
}

TEST_CASE("a pure rotation between two answers teaches nothing") {
  Stress const before(-40e3, -100e3, 5e3);
  scarp::Tensor<2> const first = scarp::rotation(0.2);
  scarp::Tensor<2> const second = scarp::rotation(0.7);
  scarp::Tensor<2> const sigma = scarp::from_voigt_stress<2, double>(before);
  auto const turned = [&](scarp::Tensor<2> const& turn) {
    scarp::Tensor<2> const stress = turn * sigma * turn.transpose();
    return scarp::to_voigt_stress<2, double>(stress);
  };
  scarp::Tensor<2> const identity = scarp::Tensor<2>::Identity();
  auto const change =
      scarp::corotated_secant_pair<2>(first - identity, second - identity, turned(first), turned(second));
  CHECK(change.strain.norm() < 1e-14);
  CHECK(change.stress.norm() < 1e-9);  // round-off of 100 kPa
}

TEST_CASE("where no rotation leads from one gradient to the other nothing is learned") {
  Stress const stress(-40e3, -100e3, 0.0);
  auto const inverted = scarp::corotated_secant_pair<2>(
      scarp::Gradient<2>::Zero(), -2.0 * scarp::Gradient<2>::Identity() + scarp::Gradient<2>::Ones(), stress,
      2.0 * stress);
  CHECK(inverted.strain.isZero(0.0));
  CHECK(inverted.stress.isZero(0.0));
}
