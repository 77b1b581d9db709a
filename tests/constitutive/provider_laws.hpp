// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/tensor/voigt.hpp"

/// Laws that every constitutive provider obeys. A provider takes part by specialising `Sample` and being named in the
/// list of provider_laws.test.cpp.
namespace provider_laws {

using scarp::Gradient;
using scarp::Tensor;
using scarp::VoigtStress;

/// What a provider tells of itself for these laws:
///   static Provider provider();            as in use
///   static State state(Provider const&);   a stressed state at rest
///   static bool same(State, State);        all bits equal
///   static constexpr double increment;     strain of an ordinary load increment
///   static constexpr double rest;          relative change of stress that a zero increment may bring
///   static constexpr double rotation_step; [rad] of one increment
///   static constexpr double rotation;      relative error of the stress turned by one such step
///   static constexpr bool elastic;         stress is a smooth function, its derivative the tangent
template <class Provider>
struct Sample;

/// An increment with stretch, shear and rotation.
template <int Dim>
Gradient<Dim> ordinary_increment(double size) {
  Gradient<Dim> gradient;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) gradient(i, j) = size * ((i == j ? (i == 0 ? 0.6 : -0.8) : 0.3) + 0.1 * (i - j));
  }
  return gradient;
}

template <class Provider>
void committed_state_is_never_touched() {
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  auto const copy = committed;
  auto trial = committed;
  auto const increment = ordinary_increment<Provider::dim>(Sample<Provider>::increment);
  static_cast<void>(provider.respond(committed, increment, trial));
  static_cast<void>(provider.tangent(committed));
  CHECK(Sample<Provider>::same(committed, copy));
  CHECK_FALSE(Sample<Provider>::same(trial, committed));
}

template <class Provider>
void same_input_gives_the_same_bits() {
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  auto const increment = ordinary_increment<Provider::dim>(Sample<Provider>::increment);
  auto first = committed;
  auto const answer = provider.respond(committed, increment, first);
  auto second = committed;
  static_cast<void>(provider.respond(committed, -2.0 * increment, second));  // whatever the trial state held before
  auto const again = provider.respond(committed, increment, second);
  CHECK(answer.stress == again.stress);
  CHECK(answer.verdict == again.verdict);
  CHECK(Sample<Provider>::same(first, second));
  CHECK(provider.stress(first) == answer.stress);
  CHECK(provider.tangent(first) == provider.tangent(second));
}

template <class Provider>
void a_zero_increment_changes_nothing() {
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  auto trial = committed;
  auto const answer = provider.respond(committed, Gradient<Provider::dim>::Zero(), trial);
  auto const before = provider.stress(committed);
  CHECK(answer.verdict.acceptable());
  CHECK((answer.stress - before).norm() <= Sample<Provider>::rest * before.norm());
}

template <class Provider>
void a_rotation_turns_the_stress() {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  Tensor<dim> turn = Tensor<dim>::Identity();
  turn.template topLeftCorner<2, 2>() = scarp::rotation(Sample<Provider>::rotation_step);
  auto trial = committed;
  auto const answer = provider.respond(committed, turn - Tensor<dim>::Identity(), trial);
  Tensor<dim> const before = scarp::from_voigt_stress<dim, double>(provider.stress(committed));
  Tensor<dim> const expected = turn * before * turn.transpose();
  CHECK(answer.verdict.acceptable());
  CHECK((answer.stress - scarp::to_voigt_stress<dim, double>(expected)).norm() <=
        Sample<Provider>::rotation * before.norm());
}

/// An increment of strain that is turned on its way ends in the turned stress of the strain alone.
template <class Provider>
void a_rotation_on_top_of_a_strain_turns_its_answer() {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  Tensor<dim> const identity = Tensor<dim>::Identity();
  Tensor<dim> turn = identity;
  turn.template topLeftCorner<2, 2>() = scarp::rotation(Sample<Provider>::rotation_step);
  Gradient<dim> const whole = ordinary_increment<dim>(Sample<Provider>::increment);
  Gradient<dim> const strain = (whole + whole.transpose()) / 2.0;
  auto trial = committed;
  VoigtStress<dim> const alone = provider.respond(committed, strain, trial).stress;
  auto const answer = provider.respond(committed, turn * (identity + strain) - identity, trial);
  Tensor<dim> const expected = turn * scarp::from_voigt_stress<dim, double>(alone) * turn.transpose();
  CHECK(answer.verdict.acceptable());
  // Where the path within the increment counts, its axes are off by less than the rotation.
  double const off = Sample<Provider>::elastic ? 0.0 : Sample<Provider>::rotation_step;
  CHECK((answer.stress - scarp::to_voigt_stress<dim, double>(expected)).norm() <=
        Sample<Provider>::rotation * alone.norm() + off * (alone - provider.stress(committed)).norm());
}

/// Work [J/m3 of the start] on a point whose deformation goes straight from corner to corner in steps.
template <class Provider>
double work_along(std::vector<Tensor<Provider::dim>> const& corners, int steps) {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto state = Sample<Provider>::state(provider);
  Tensor<dim> before = corners.front();
  double work = 0.0;
  for (std::size_t side = 1; side < corners.size(); ++side) {
    for (int step = 1; step <= steps; ++step) {
      double const part = static_cast<double>(step) / steps;
      Tensor<dim> const now = (1.0 - part) * corners[side - 1] + part * corners[side];
      auto trial = state;
      auto const answer = provider.respond(state, now * before.inverse() - Tensor<dim>::Identity(), trial);
      REQUIRE(answer.verdict.status != scarp::Status::failed);
      Tensor<dim> const rate = 2.0 * (now - before) * (now + before).inverse();  // at the middle, to third order
      VoigtStress<dim> const mean = (provider.stress(state) + answer.stress) / 2.0;
      double const volume = (now.determinant() + before.determinant()) / 2.0;
      work += volume * (scarp::from_voigt_stress<dim, double>(mean) * rate).trace();
      state = trial;
      before = now;
    }
  }
  return work;
}

/// A strain that goes back the way it came, or round a square either way, gives no energy away.
template <class Provider>
void a_closed_cycle_of_strain_gives_no_energy() {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto const start = Sample<Provider>::state(provider);
  double const size = Sample<Provider>::increment;
  double const stiffness = provider.tangent(start).norm();
  double const stress = provider.stress(start).norm();
  Tensor<dim> const origin = Tensor<dim>::Identity();
  Gradient<dim> const whole = ordinary_increment<dim>(size);
  Tensor<dim> const first = origin + (whole + whole.transpose()) / 2.0;
  Tensor<dim> second = origin;
  second(0, 1) = second(1, 0) = size;
  Tensor<dim> const both = first + second - origin;
  constexpr int steps = 4;
  // Third order of the strain: the trapezoid's, and that of a stress rate that no energy stands behind. Rest: what an
  // answer may be off by on each of the sides.
  double const order = 3.0 * stiffness * size * size * size + 4.0 * Sample<Provider>::rest * stress * size;
  CHECK(work_along<Provider>({origin, first, origin}, steps) >= -order);
  // Round a square such a rate gives or takes the stress times the square's area, less than a tenth of the energy that
  // strain of this size stores.
  double const area = order + stress * size * size;
  CHECK(work_along<Provider>({origin, first, both, second, origin}, steps) >= -area);
  CHECK(work_along<Provider>({origin, second, both, first, origin}, steps) >= -area);
}

/// Elastic providers: central differences of the stress, corrected for the rotation-free increment's own terms, are the
/// tangent's columns. Others: along every strain the measured stiffness is positive and not above the tangent's.
template <class Provider>
void the_tangent_is_the_derivative_or_bounds_it() {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  auto const tangent = provider.tangent(committed);
  double const step = Sample<Provider>::elastic ? 1e-5 : 1e-6;
  for (int k = 0; k < scarp::voigt_size<dim>; ++k) {
    auto trial = committed;
    VoigtStress<dim> const up = provider.respond(committed, step * scarp::unit_strain<dim>(k), trial).stress;
    VoigtStress<dim> const down = provider.respond(committed, -step * scarp::unit_strain<dim>(k), trial).stress;
    VoigtStress<dim> const measured = (up - down) / (2.0 * step);
    if constexpr (Sample<Provider>::elastic) {
      // Truncation step^2 = 1e-10, round-off 1e-16/step = 1e-11, relative to the stiffness.
      CHECK((measured - tangent.col(k)).norm() < 1e-8 * tangent.norm());
    } else {
      MESSAGE("component " << k << ": measured over tangent " << measured(k) / tangent(k, k));
      CHECK(measured(k) > 0.2 * tangent(k, k));  // a packing at rest is far from failure
      CHECK(measured(k) < tangent(k, k));        // uniform strain is one trial motion of the minimum principle
    }
  }
  for (int k = 0; k < scarp::voigt_size<dim>; ++k) CHECK(tangent(k, k) > 0.0);
  CHECK((tangent - tangent.transpose()).norm() < 1e-10 * tangent.norm());
}

template <class Provider>
void not_a_number_fails_with_a_reason() {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  auto trial = committed;
  for (double const broken : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Gradient<dim> gradient = Gradient<dim>::Zero();
    gradient(0, dim - 1) = broken;
    auto const answer = provider.respond(committed, gradient, trial);
    CHECK(answer.verdict.status == scarp::Status::failed);
    CHECK(answer.verdict.reason == scarp::Reason::not_finite);
  }
}

/// A tiny increment has a tiny answer.
template <class Provider>
void the_answer_does_not_jump() {
  constexpr int dim = Provider::dim;
  auto const provider = Sample<Provider>::provider();
  auto const committed = Sample<Provider>::state(provider);
  auto trial = committed;
  auto const before = provider.stress(committed);
  double const size = 1e-7;  // strain
  auto const answer = provider.respond(committed, ordinary_increment<dim>(size), trial);
  double const stiffness = provider.tangent(committed).norm();
  CHECK(answer.verdict.acceptable());
  // A strain of size eps moves the stress by at most the tangent's norm times eps; three covers the norms' factors.
  CHECK((answer.stress - before).norm() <= 3.0 * stiffness * size + Sample<Provider>::rest * before.norm());
}

}  // namespace provider_laws
