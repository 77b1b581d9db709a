// SPDX-License-Identifier: BSL-1.0
// Ground over a fault: hardly any confinement or gravity, a hundred times the gravity, other units, every dip and
// throw.
#include "stability/fault_ground.hpp"

#include <fmt/format.h>

#include "stability/stability_case.hpp"

namespace stability {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double gamma_soil = 15.68e3;  // [N/m3]

std::string effort(FaultResponse const& found) {
  return fmt::format("{} at throw/depth {:.3g}, {} steps, {} rejected, {} iterations", name(found.run.verdict.reason),
                     found.run.load / 25.0, found.run.steps, found.run.refused, found.run.iterations);
}

/// Reaches the throw in balance, without tension that the strength does not have.
Outcome reaches(FaultGround const& ground, double scale, double limit = 1e-9) {
  auto const found = response(ground);
  Worst worst;
  worst.see(found.run.verdict.acceptable() && found.run.load == ground.throw_to
                ? 0.0
                : std::numeric_limits<double>::infinity());
  worst.see(found.imbalance);
  double const allowed = ground.soil.strength.strength.cut_off();
  worst.see(std::max(0.0, found.tension - allowed) / scale);
  // The residual's tolerance, over the weight instead of all reactions; the slack of the return.
  return at_most(limit, worst.value, "imbalance over weight, excess tension over overburden",
                 effort(found) + fmt::format(", largest tension {:.2g} Pa", found.tension));
}

Outcome surcharge(double pressure, double cohesion) {
  FaultGround ground;
  ground.loaded(gamma_soil, pressure);
  ground.soil.strength.strength.cohesion = cohesion;
  return reaches(ground, gamma_soil * ground.layer().depth);
}

Outcome gravity(double times) {
  FaultGround ground;
  ground.loaded(times * gamma_soil, 0.0);
  if (times >= 1.0) return reaches(ground, times * gamma_soil * ground.layer().depth);
  // Where cohesion is all that holds, ground tears at the surface, and what is torn off carries its weight by
  // nothing: 1e-8 of the forces at 1e-9 g, below which the run takes hundreds of tiny steps.
  ground.solver.tolerance = 1e-7;
  return reaches(ground, ground.soil.strength.strength.cohesion, 1e-6);
}

Outcome units(double length, double stress) {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  auto const reference = response(ground);
  auto const other = response(ground.in_units(length, stress));
  Worst worst;
  worst.see(difference(other, reference));
  worst.see(static_cast<double>(other.run.iterations - reference.run.iterations));
  return at_most(1e-9, worst.value, "difference of the surfaces and of iterations", effort(other));
}

Outcome dip(double degrees, double throw_over_depth, Size size) {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  ground.fault.dip = degrees * degree;
  if (size == Size::full) ground.layer().size = 2.5;
  ground.throw_to = throw_over_depth * ground.layer().depth;
  return reaches(ground, gamma_soil * ground.layer().depth);
}

Outcome tiny_throw() {
  FaultGround ground;
  ground.loaded(gamma_soil, 4e3);
  ground.throw_to = 1e-9;
  auto const found = response(ground);
  double most = 0.0;
  for (auto const& moved : found.surface) most = scarp::nan_max(most, moved.norm() * ground.layer().depth);
  // No node goes further than the hanging wall, the square root of 1 + 1/tan(60 degrees)^2 times the throw.
  double const beyond = std::max(0.0, most / (ground.throw_to * std::sqrt(4.0 / 3.0)) - 1.0);
  auto outcome = at_most(1e-6, beyond, "largest motion of the surface over that of the hanging wall, less 1",
                         effort(found) + fmt::format(", imbalance {:.1e}", found.imbalance));
  outcome.as_expected &= found.run.verdict.acceptable() && found.run.load == ground.throw_to && most > 0.5e-9;
  return outcome;
}

}  // namespace

Cases fault_cases() {
  Cases cases;
  auto const add = [&](std::string name, std::string expected, auto run) {
    cases.push_back({"ground over a fault", std::move(name), std::move(expected), std::move(run)});
  };
  std::string const arrives = "reaches the throw in balance, no tension beyond the strength";
  for (double const pressure : {0.0, 1e-6, 1e-3, 1.0}) {
    for (double const cohesion : {0.0, 1e3}) {
      add(fmt::format("surcharge {:g} Pa, cohesion {:g} Pa", pressure, cohesion), arrives,
          [=](Size) { return surcharge(pressure, cohesion); });
    }
  }
  for (double const times : {0.0, 1e-9, 1.0, 115.0})
    add(fmt::format("gravity {:g} g", times), arrives, [=](Size) { return gravity(times); });
  struct Units {
    double length;
    double stress;
  };
  for (Units const of : {Units{1e-12, 1.0}, Units{1e12, 1.0}, Units{1.0, 1e-12}, Units{1.0, 1e12}, Units{1e-12, 1e-12},
                         Units{1e12, 1e12}}) {
    add(fmt::format("lengths x {:g}, stresses x {:g}", of.length, of.stress), "as in metres and pascals to 1e-9",
        [=](Size) { return units(of.length, of.stress); });
  }
  for (double const degrees : {30.0, 45.0, 60.0, 90.0})
    add(fmt::format("dip {:g} degrees, throw 2 % of the depth", degrees), arrives,
        [=](Size size) { return dip(degrees, 0.02, size); });
  add("dip 60 degrees, throw 12 % of the depth", arrives, [](Size size) { return dip(60.0, 0.12, size); });
  add("throw 1e-9 m", "reached; nothing moves more than the hanging wall", [](Size) { return tiny_throw(); });
  return cases;
}

}  // namespace stability
