// SPDX-License-Identifier: BSL-1.0
// Mohr-Coulomb points at the ends of their parameters, far outside their surface, almost without stress and over many
// cycles.
#include <fmt/format.h>

#include <limits>
#include <numbers>

#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/constitutive/strength.hpp"
#include "scarp/core/random.hpp"
#include "stability/stability_case.hpp"

namespace stability {

namespace {

using scarp::Gradient;
using scarp::Strength;
using Soil = scarp::MohrCoulomb<2>;
using State = Soil::State;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180.0;

scarp::IsotropicElasticity elasticity() { return scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25); }

Soil soil(Strength const& strength) { return {.elasticity = elasticity(), .strength = {strength}, .initial = {}}; }

State under(Soil const& soil, double pressure) {
  State state = soil.initial_state({});
  state.stress.head<3>().setConstant(-pressure);
  return state;
}

Gradient<2> random_gradient(scarp::Random& random, double size) {
  Gradient<2> gradient;
  for (auto& entry : gradient.reshaped()) entry = random.uniform(-size, size);
  return gradient;
}

/// How far a stress lies outside the surface and its cut-off. [Pa]
double excess(Strength const& strength, scarp::VoigtStress<3> const& stress) {
  auto const values = scarp::principal(scarp::from_voigt_stress<3, double>(stress)).values;
  double const largest = values.maxCoeff();
  double const smallest = values.minCoeff();
  double const shear = largest - smallest + (largest + smallest) * std::sin(strength.friction) -
                       2.0 * strength.cohesion * std::cos(strength.friction);
  return std::max({0.0, shear, largest - strength.cut_off()});
}

/// Excess after random increments from random pressures, over the size of the elastic trial stress.
Outcome random_returns(Strength const& strength, Size size) {
  auto const law = soil(strength);
  scarp::Random random(17);
  Worst worst;
  int const draws = size == Size::quick ? 300 : 30000;
  int none = 0;
  for (int k = 0; k < draws; ++k) {
    State const start = under(law, std::pow(10.0, random.uniform(-6.0, 6.0)));
    auto const increment = random_gradient(random, std::pow(10.0, random.uniform(-9.0, -0.7)));
    State trial;
    auto const verdict = law.respond(start, increment, trial).verdict;
    if (verdict.reason == scarp::Reason::no_return && strength.friction > 84.0 * degree) {
      ++none;
      continue;
    }
    worst.see(verdict.acceptable() ? 0.0 : infinity);
    double const scale = start.stress.norm() + law.elasticity.shear_modulus * increment.norm();
    worst.see(excess(strength, trial.stress) / scale);
    worst.see(trial.tangent.allFinite() ? 0.0 : infinity);
  }
  // Slack of the return, 1e-12 of the largest trial stress, and round-off of a face whose normal leaves the largest
  // stress by 1 - sin(phi) only.
  return at_most(4e-12 + 16.0 * 2.2e-16 / (1.0 - std::sin(strength.friction)), worst.value,
                 "stress outside the surface over the elastic trial stress",
                 none > 0 ? fmt::format("{} of {} increments have no_return", none, draws) : "");
}

Gradient<2> diagonal(double x, double y) {
  Gradient<2> gradient = Gradient<2>::Zero();
  gradient.diagonal() << x, y;
  return gradient;
}

/// Shear at almost no pressure with strains as small as the elastic ones there: all is as at 1 Pa, but for the
/// round-off of the strain.
Outcome faint_pressure() {
  Strength const strength{.friction = 30.0 * degree, .dilation = 5.0 * degree};
  auto const law = soil(strength);
  auto const ratio = [&](double pressure) {
    State state = under(law, pressure);
    double const strain = pressure / law.elasticity.shear_modulus;
    for (int k = 0; k < 20; ++k) {
      State next;
      if (!law.respond(state, diagonal(0.2 * strain, -0.3 * strain), next).verdict.acceptable()) return infinity;
      state = next;
    }
    return (state.stress(0) - state.stress(1)) / pressure;
  };
  double const reference = ratio(1.0);  // more, and the square of the strain would be seen
  Worst scaled;
  std::string remark;
  for (double const pressure : {1e-2, 1e-4, 1e-6}) {
    double const error = relative(ratio(pressure), reference);
    scaled.see(error * pressure);  // round-off of I + gradient: 1e-16 of strain, over strains of p/G
    remark += fmt::format("{:.0e} at {:g} Pa; ", error, pressure);
  }
  // 20 steps of some units of round-off (2e-16) in a strain, times G (1e7 Pa).
  return at_most(4e-8, scaled.value, "change of the stress ratio with p, times p [Pa]", remark);
}

/// Strain forth and back a thousand times; the way back undoes the way there exactly but for round-off.
Outcome tiny_cycles(double pressure, double amplitude, bool yielding, Size size) {
  auto const law = soil({.cohesion = 1e3, .friction = 30.0 * degree, .dilation = 5.0 * degree});
  State state = under(law, pressure);
  bool all_found = true;
  if (yielding) {
    State next;
    for (int k = 0; k < 100; ++k) {
      all_found = all_found && law.respond(state, diagonal(3e-4, -4e-4), next).verdict.acceptable();
      state = next;
    }
  }
  State const start = state;
  Gradient<2> const there = diagonal(-amplitude, amplitude);  // off the surface
  Gradient<2> const back = (Gradient<2>::Identity() + there).inverse() - Gradient<2>::Identity();
  int const cycles = size == Size::quick ? 1000 : 100000;
  for (int k = 0; k < cycles; ++k) {
    State next;
    for (auto const& increment : {there, back}) {
      all_found = all_found && law.respond(state, increment, next).verdict.acceptable();
      state = next;
    }
  }
  Worst worst;
  worst.see((state.stress - start.stress).norm() / start.stress.norm());
  double const ratchet = (state.plastic_shear - start.plastic_shear) / amplitude;
  // Units of round-off of a strain, one for each half cycle, times the stiffness.
  double const limit = 2.0 * cycles * 2.3e-16 * 25e6 / pressure;
  auto outcome = at_most(limit, worst.value, "drift of stress over stress",
                         fmt::format("{} cycles; plastic shear grew by {:.1e} of the amplitude", cycles, ratchet));
  outcome.as_expected &= ratchet <= 1e-6;
  return outcome;
}

/// From peak to residual within 1e-9 to 1 of plastic shear: a stress on the surface of its own strength, or
/// `no_return`.
Outcome steep_softening() {
  Worst worst;
  int none = 0;
  int evaluated = 0;
  for (double const softening_strain : {1.0, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    scarp::MohrCoulomb<2, scarp::StressFree<2>, scarp::SofteningStrength> const law{
        .elasticity = elasticity(),
        .strength = {.peak = {.cohesion = 20e3, .friction = 35.0 * degree, .dilation = 10.0 * degree},
                     .residual = {.cohesion = 0.0, .friction = 25.0 * degree},
                     .softening_strain = softening_strain},
        .initial = {}};
    for (double const strain : {1e-5, 1e-4, 1e-3, 1e-2}) {
      auto state = law.initial_state({});
      state.stress.head<3>().setConstant(-50e3);
      for (int k = 0; k < 50; ++k) {
        auto next = state;
        ++evaluated;
        auto const response = law.respond(state, diagonal(0.8 * strain, -strain), next);
        if (response.verdict.reason == scarp::Reason::no_return) {
          ++none;
          break;
        }
        worst.see(response.verdict.acceptable() ? 0.0 : infinity);
        worst.see(excess(law.strength.at(next.plastic_shear), next.stress) / (25e6 * strain + 50e3));
        worst.see(next.tangent.allFinite() ? 0.0 : infinity);
        state = next;
      }
    }
  }
  return at_most(1e-9, worst.value, "stress outside the surface over the elastic trial stress",
                 fmt::format("{} of {} increments have no_return", none, evaluated));
}

}  // namespace

Cases strength_cases() {
  Cases cases;
  auto const add = [&](std::string name, std::string expected, auto run) {
    cases.push_back({"strength of a point", std::move(name), std::move(expected), std::move(run)});
  };
  std::string const on_surface = "returns on the surface, finite tangent";
  for (double const friction : {0.0, 1e-9, 30.0, 60.0, 85.0, 89.0, 89.9}) {
    for (double const share : {0.0, 1.0}) {
      if (friction == 0.0 && share > 0.0) continue;
      Strength const strength{.cohesion = 1e3, .friction = friction * degree, .dilation = share * friction * degree};
      add(fmt::format("friction {:g} degrees, dilation {:g}", friction, share * friction), on_surface,
          [=](Size size) { return random_returns(strength, size); });
    }
  }
  add("no cohesion, friction 35 degrees", on_surface,
      [](Size size) { return random_returns({.friction = 35.0 * degree, .dilation = 5.0 * degree}, size); });
  add("no strength at all", on_surface, [](Size size) { return random_returns({}, size); });
  add("no tension, cohesion 10 kPa", on_surface, [](Size size) {
    return random_returns({.cohesion = 10e3, .friction = 30.0 * degree, .dilation = 30.0 * degree, .tension = 0.0},
                          size);
  });
  add("pressure 1e-2 to 1e-6 Pa", "as at 1 Pa but for the round-off of strains", [](Size) { return faint_pressure(); });
  add("tiny cycles, elastic", "no drift", [](Size size) { return tiny_cycles(1e5, 1e-6, false, size); });
  add("tiny cycles off the surface", "no drift beyond round-off, no plastic strain",
      [](Size size) { return tiny_cycles(1e5, 1e-6, true, size); });
  add("steep softening", "on the surface or no_return", [](Size) { return steep_softening(); });
  return cases;
}

}  // namespace stability
