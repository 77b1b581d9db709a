// SPDX-License-Identifier: BSL-1.0
// Packings at the ends of what can be placed in a cell, servos that are asked for the impossible, and input that is
// none.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scarp/core/worse_of.hpp"
#include "stability/groups.hpp"
#include "support/packings.hpp"

namespace stability {

namespace {

using samples::Discs;
using scarp::Reason;
using scarp::Status;
using scarp::Tensor;
using scarp::Vector;
using scarp::Verdict;

constexpr char const* group = "Packings";

std::string words(Verdict const& verdict) {
  return verdict.reason == Reason::none ? fmt::format("{}", name(verdict.status))
                                        : fmt::format("{} / {}", name(verdict.status), name(verdict.reason));
}

/// Pairs of discs nearer than `reach` and Love and Weber's stress, from all pairs with all images of two cells about.
struct AllPairs {
  std::size_t near = 0;
  Tensor<2> stress = Tensor<2>::Zero();
};

AllPairs all_pairs(Discs const& packing, double stiffness, double reach) {
  AllPairs all;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (std::size_t j = 0; j < packing.grain_count(); ++j) {
      for (int code = 0; code < 25; ++code) {
        Vector<2> const shift = packing.cell * Vector<2>(code % 5 - 2, code / 5 - 2);
        Vector<2> branch = shift;
        for (int a = 0; a < 2; ++a) branch(a) += packing.position(j, a) - packing.position(i, a);
        if (i == j && code == 12) continue;
        double const gap = branch.norm() - packing.population->size(i)[0] - packing.population->size(j)[0];
        if (gap <= reach) ++all.near;
        if (gap < 0.0) all.stress -= -0.5 * stiffness * gap * branch.normalized() * branch.transpose();
      }
    }
  }
  all.near /= 2;
  all.stress /= packing.volume();
  return all;
}

/// Discs of two sizes thrown anywhere, in a sheared cell: overlaps of any depth.
Outcome size_ratio(double ratio, Size size) {
  constexpr double stiffness = 6e6;
  scarp::Random random(5);
  scarp::LinearFrictional const law{.normal_stiffness = stiffness, .tangential_stiffness = 0.0, .friction = 0.0};
  Outcome outcome{.as_expected = true, .measure = "largest difference of the stress over its size"};
  std::size_t pairs = 0;
  for (int trial = 0; trial < (size == Size::quick ? 10 : 200); ++trial) {
    constexpr double largest = 1e-2;
    Tensor<2> cell = random.uniform(3.0, 5.0) * largest * Tensor<2>::Identity();
    cell(0, 1) = random.uniform(-3.0, 3.0) * cell(0, 0);
    std::vector<scarp::Disc::Size<double>> sizes{{largest}};
    std::vector<Vector<2>> places{cell * Vector<2>(random.uniform(), random.uniform())};
    for (int i = 0; i < 60; ++i) {
      sizes.push_back({largest * std::pow(ratio, -random.uniform())});
      places.push_back(cell * Vector<2>(random.uniform(-1.0, 2.0), random.uniform(-1.0, 2.0)));
    }
    auto packing = samples::place<Discs>(cell, sizes, places);
    scarp::TimeStepper<Discs> stepper;
    scarp::StepObservation<2> seen;
    if (!stepper.observe(packing, law, seen).acceptable()) {
      outcome.as_expected = false;
      continue;
    }
    AllPairs const all = all_pairs(packing, stiffness, packing.pairs.skin);
    outcome.as_expected = outcome.as_expected && all.near == packing.pairs.count();
    pairs += all.near;
    outcome.worst = scarp::worse_of(outcome.worst, (all.stress - seen.stress).norm() / all.stress.norm());
  }
  outcome.remark = fmt::format("{} pairs", pairs);
  outcome.as_expected = outcome.as_expected && outcome.worst <= 1e-12;
  return outcome;
}

/// So few grains that each touches images of itself or of one other on several sides.
Outcome few_grains(int grains) {
  auto const law = samples::study_law();
  auto const [packing, verdict] =
      scarp::IsotropicPreparation{.pressure = samples::pressure}.prepare(samples::loose_cloud<Discs>(grains, 4), law);
  Outcome outcome{.measure = "pressure of all pairs with all images over the asked one, less one",
                  .remark = words(verdict)};
  if (verdict == Verdict{Status::failed, Reason::cell_collapsed}) {
    outcome.measure = "nothing to compare";
    outcome.as_expected = grains < 16;
    return outcome;
  }
  AllPairs const all = all_pairs(packing, law.normal_stiffness, 0.0);
  // Normal forces give all of the pressure of discs.
  outcome.worst = std::abs(-0.5 * all.stress.trace() / samples::pressure - 1.0);
  outcome.as_expected = verdict.acceptable() && outcome.worst < 1e-3;
  return outcome;
}

/// Undamped grains: nothing but round-off can change the sum of their momenta.
Outcome momentum(Size size) {
  auto packing = samples::consolidated<Discs>(40).packing;
  auto const law = samples::study_law();
  scarp::Random random(2);
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    for (int a = 0; a < 2; ++a) packing.velocity(i, a) = random.uniform(-0.1, 0.1);
  }
  auto const sums = [&] {
    Vector<2> sum = Vector<2>::Zero();
    double size_of_all = 0.0;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      Vector<2> const one =
          Vector<2>(packing.velocity(i, 0), packing.velocity(i, 1)) / packing.population->inverse_mass()[i];
      sum += one;
      size_of_all += one.norm();
    }
    return std::pair{sum, size_of_all};
  };
  auto const [start, scale] = sums();
  scarp::TimeStepper<Discs> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  long const steps = size == Size::quick ? 100'000 : 10'000'000;
  for (long step = 0; step < steps; ++step) {
    if (Verdict const verdict = stepper.step(packing, law, Tensor<2>::Zero()); !verdict.acceptable()) {
      return {.measure = "nothing", .remark = words(verdict)};
    }
  }
  double const drift = (sums().first - start).norm() / scale;
  double const walk = 1e-15 * std::sqrt(static_cast<double>(steps));  // random walk of round-off, some units each
  return {.as_expected = drift <= walk,
          .worst = drift,
          .measure = fmt::format("drift of momentum over the sum of sizes in {} steps", steps),
          .remark = fmt::format("a random walk of round-off makes {:.1g}", walk)};
}

/// A loading that is asked of 40 discs under 200 kPa.
Outcome servo(scarp::Loading<2> const& loading, scarp::Servo const& servo, std::vector<Verdict> const& allowed) {
  auto packing = samples::consolidated<Discs>(40).packing;
  auto const before = packing;
  scarp::TimeStepper<Discs> stepper;
  Verdict const verdict = servo.reach(stepper, packing, samples::study_law(), loading);
  bool const at_once = packing == before;
  scarp::StepObservation<2> seen;
  Verdict const looked = stepper.observe(packing, samples::study_law(), seen);
  Outcome outcome{.measure = "largest stress left [Pa]", .remark = words(verdict) + (at_once ? ", at once" : "")};
  outcome.worst = looked.acceptable() ? seen.stress.cwiseAbs().maxCoeff() : 0.0;
  for (Verdict const& one : allowed) outcome.as_expected = outcome.as_expected || verdict == one;
  // No packing carries them: that is known before the first step.
  auto const& controls = loading.controls;
  bool const impossible =
      std::any_of(controls.begin(), controls.end(), [](auto const& one) { return !one.reachable(false); });
  outcome.as_expected = outcome.as_expected && (at_once || !impossible);
  return outcome;
}

Case servo_case(std::string name, std::string expected, scarp::Loading<2> const& loading, scarp::Servo const& asked,
                std::vector<Verdict> const& allowed) {
  return {.group = "Servo", .name = std::move(name), .expected = std::move(expected), .run = [=](Size) {
            return servo(loading, asked, allowed);
          }};
}

Cases servo_cases() {
  constexpr Verdict unreachable{Status::not_converged, Reason::unreachable};
  constexpr Verdict unbalanced{Status::not_converged, Reason::unbalanced};
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  constexpr double endless = std::numeric_limits<double>::infinity();
  auto const stress = [](double x, double y) { return scarp::Loading<2>::stress({x, y, 0.0}); };
  scarp::Servo const bounded{.most_steps = 20'000};
  Cases all;
  for (double const target : {0.0, 1e5, none, -endless}) {
    all.push_back(servo_case(fmt::format("isotropic target {} Pa", target), "unreachable, at once",
                             stress(target, target), bounded, {unreachable}));
  }
  all.push_back(servo_case("stress ratio beyond the strength", "unreachable or unbalanced within 20000 steps",
                           stress(-2e4, -4e5), bounded, {unreachable, unbalanced}));
  all.push_back(servo_case("isotropic target 1e-6 of the present pressure", "settles or is named within 20000 steps",
                           stress(-0.2, -0.2), bounded, {Verdict{}, unreachable, unbalanced}));
  for (double const steps : {1e-3, 0.1, 1.0}) {
    auto quick = bounded;
    quick.feedback.response_steps = steps;
    all.push_back(servo_case(fmt::format("a cell that answers within {} steps", steps),
                             "settles or is named within 20000 steps", stress(-3e5, -3e5), quick,
                             {Verdict{}, unreachable, unbalanced}));
  }
  return all;
}

/// Calls make() and wants InputError.
template <class Make>
Case refused(std::string name, Make make) {
  return {.group = "Input", .name = std::move(name), .expected = "refused in words", .run = [make](Size) {
            try {
              make();
            } catch (scarp::InputError const& error) {
              return Outcome{.as_expected = true, .measure = "nothing", .remark = error.what()};
            }
            return Outcome{.measure = "nothing", .remark = "was accepted"};
          }};
}

/// Spoils a packing under 200 kPa and goes on with it.
template <class Spoil>
Case spoiled(std::string name, Spoil spoil) {
  auto const run = [spoil](Size) {
    auto packing = samples::consolidated<Discs>(40).packing;
    auto law = samples::study_law();
    Tensor<2> strain = Tensor<2>::Zero();
    spoil(packing, law, strain);
    scarp::TimeStepper<Discs> stepper;
    Verdict verdict{};
    scarp::StepObservation<2> seen;
    int steps = 0;
    for (; steps < 1000 && verdict.acceptable(); ++steps) verdict = stepper.step(packing, law, strain);
    if (verdict.acceptable()) verdict = stepper.observe(packing, law, seen);
    bool const silent = verdict.acceptable();
    return Outcome{.as_expected = !silent,
                   .worst = static_cast<double>(steps),
                   .measure = "steps until it is named",
                   .remark = words(verdict)};
  };
  return {.group = "Input", .name = std::move(name), .expected = "a named status", .run = run};
}

Cases input_cases() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  constexpr double endless = std::numeric_limits<double>::infinity();
  Cases all;
  for (double const bad : {none, endless, 0.0, -1.0}) {
    all.push_back(
        refused(fmt::format("radius {}", bad), [=] { scarp::Population<scarp::Disc>({{bad}}, 2650.0, 0.2); }));
    all.push_back(refused(fmt::format("density {}", bad), [=] { scarp::Population<scarp::Disc>({{1e-2}}, bad, 0.2); }));
    all.push_back(refused(fmt::format("preparation at {} Pa", bad), [=] {
      scarp::IsotropicPreparation{.pressure = bad}.prepare(samples::loose_cloud<Discs>(16, 1), samples::study_law());
    }));
  }
  for (double const bad : {none, endless}) {
    all.push_back(
        spoiled(fmt::format("position {}", bad), [=](auto& packing, auto&, auto&) { packing.position(3, 0) = bad; }));
    all.push_back(
        spoiled(fmt::format("velocity {}", bad), [=](auto& packing, auto&, auto&) { packing.velocity(3, 0) = bad; }));
    all.push_back(spoiled(fmt::format("spin {}", bad), [=](auto& packing, auto&, auto&) { packing.spin(3, 0) = bad; }));
    all.push_back(spoiled(fmt::format("cell {}", bad), [=](auto& packing, auto&, auto&) { packing.cell(0, 0) = bad; }));
    all.push_back(spoiled(fmt::format("strain step {}", bad), [=](auto&, auto&, auto& strain) { strain(0, 0) = bad; }));
    all.push_back(
        spoiled(fmt::format("normal stiffness {}", bad), [=](auto&, auto& law, auto&) { law.normal_stiffness = bad; }));
    all.push_back(spoiled(fmt::format("tangential stiffness {}", bad),
                          [=](auto&, auto& law, auto&) { law.tangential_stiffness = bad; }));
    all.push_back(spoiled(fmt::format("friction {}", bad), [=](auto&, auto& law, auto&) { law.friction = bad; }));
  }
  return all;
}

}  // namespace

Cases packing_cases() {
  Cases all;
  for (double const ratio : {1.0, 2.0, 10.0, 100.0}) {
    all.push_back({.group = group,
                   .name = fmt::format("size ratio {}", ratio),
                   .expected = "pairs and stress of all pairs with all images",
                   .run = [ratio](Size size) { return size_ratio(ratio, size); }});
  }
  for (int const grains : {1, 2, 3, 4, 16}) {
    all.push_back({.group = group,
                   .name = fmt::format("{} grains", grains),
                   .expected = grains < 16 ? "asked pressure, or the cell is refused as too thin" : "asked pressure",
                   .run = [grains](Size) { return few_grains(grains); }});
  }
  all.push_back(
      {.group = group, .name = "momentum over many steps", .expected = "drifts by round-off only", .run = momentum});
  for (auto&& some : {servo_cases(), input_cases()}) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace stability
