// SPDX-License-Identifier: BSL-1.0
#include "scarp/solver/detail/answer_change.hpp"

#include <doctest/doctest.h>

#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/solver/point_secant.hpp"

namespace {

using scarp::Gradient;
using scarp::VoigtStress;

}  // namespace

TEST_CASE(
    "a tangent that learns from simple shear under an initial stress learns the shear modulus, not the rotation") {
  // G = 100 kPa at (-40, -100) kPa. The raw change of Cauchy's stress in simple shear g is (G + (s_yy - s_xx)/2) g: 70 kPa.
  using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  auto const soil = Soil::from_lame(100e3, 100e3, {.surcharge = 100e3, .unit_weight = 0.0, .k0 = 0.4});
  auto const committed = soil.initial_state({});
  auto state = committed;
  Gradient<2> shear = Gradient<2>::Zero();
  shear(0, 1) = 1e-5;
  VoigtStress<2> const before = soil.stress(committed);
  VoigtStress<2> const after = soil.respond(committed, shear, state).stress;
  scarp::PointSecant const rule;
  auto const start =
      scarp::VoigtTangent<2>((scarp::VoigtTangent<2>() << 300e3, 100e3, 0, 100e3, 300e3, 0, 0, 0, 50e3).finished());
  auto const learned_from = [&](scarp::EngineeringStrain<2> const& strain, VoigtStress<2> const& change) {
    return rule.update<2>(start, start, strain, change)(2, 2);
  };
  auto const raw = learned_from(scarp::to_engineering_strain<2, double>(shear), after - before);
  auto const change = scarp::unturned_change<2>(Gradient<2>::Zero(), shear, before, after);
  CHECK(std::abs(raw - 70e3) < 100.0);
  CHECK(std::abs(learned_from(change.strain, change.stress) - 100e3) < 100.0);  // errors of the order of the shear
}

TEST_CASE("a pure rotation between two answers teaches nothing") {
  VoigtStress<2> const before(-40e3, -100e3, 5e3);
  scarp::Tensor<2> const first = scarp::rotation(0.2);
  scarp::Tensor<2> const second = scarp::rotation(0.7);
  scarp::Tensor<2> const sigma = scarp::from_voigt_stress<2, double>(before);
  auto const turned = [&](scarp::Tensor<2> const& turn) {
    scarp::Tensor<2> const stress = turn * sigma * turn.transpose();
    return scarp::to_voigt_stress<2, double>(stress);
  };
  scarp::Tensor<2> const identity = scarp::Tensor<2>::Identity();
  auto const change = scarp::unturned_change<2>(first - identity, second - identity, turned(first), turned(second));
  CHECK(change.strain.norm() < 1e-14);
  CHECK(change.stress.norm() < 1e-9);  // round-off of 100 kPa
}

TEST_CASE("where no rotation leads from one gradient to the other nothing is learned") {
  VoigtStress<2> const stress(-40e3, -100e3, 0.0);
  auto const inverted = scarp::unturned_change<2>(
      Gradient<2>::Zero(), -2.0 * Gradient<2>::Identity() + Gradient<2>::Ones(), stress, 2.0 * stress);
  CHECK(inverted.strain.isZero(0.0));
  CHECK(inverted.stress.isZero(0.0));
}
