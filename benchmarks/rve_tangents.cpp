// SPDX-License-Identifier: BSL-1.0
// How far is each tangent policy from the derivative of a packing's stress, and what does it cost? 400 ellipses at
// 200 kPa and after pure shear; prints the tables of docs/notes/tangents.md.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../examples/shared/study/study_sand.hpp"
#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/perturbation_tangent.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/condensed_tangent.hpp"

namespace {

using Packing = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using Voigt = scarp::VoigtTangent<2>;

constexpr double strain_per_step = 2e-6;
scarp::LinearFrictional const law = examples::study_law();
scarp::EngineeringStrain<2> const onward(1.0, -1.0, 0.0);

/// Strains of a trial to the side of the shearing: the first is the derivative, the others what load steps look like.
std::vector<double> const amplitudes{1e-6, 1e-4, 1e-3};

struct State {
  std::string name;
  Packing moving;             ///< as the shearing left it
  Packing settled;            ///< the base of all tangents
  std::vector<Voigt> answer;  ///< for each amplitude
};

struct Policy {
  std::string name;
  std::function<Voigt(Packing const&)> tangent;
};

double seconds(std::function<void()> const& work) {
  auto const started = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

Packing settled(Packing packing) {
  scarp::TimeStepper<Packing> stepper;
  scarp::StepObservation<2> seen;
  packing.rest();
  for (int step = 0; step < 400'000; ++step) {
    if (step % 100 != 0) {
      stepper.step(packing, law, scarp::Tensor<2>::Zero());
      continue;
    }
    stepper.step<scarp::Observe::balance>(packing, law, scarp::Tensor<2>::Zero(), &seen);
    if (seen.unbalanced_ratio < 1e-7) break;
  }
  packing.rest();
  return packing;
}

std::vector<State> make_states() {
  auto const prepared =
      scarp::IsotropicPreparation{.pressure = 200e3}.prepare(examples::study_cloud(400, 1).make<Packing>(), law);
  if (!prepared.verdict.acceptable()) throw std::runtime_error("the packing did not reach 200 kPa");
  std::vector<State> states;
  Packing packing = prepared.packing;
  scarp::TimeStepper<Packing> stepper;
  scarp::Tensor<2> step = scarp::Tensor<2>::Zero();
  step.diagonal() << strain_per_step, -strain_per_step;
  double sheared = 0.0;
  for (double const strain : {0.0, 0.005, 0.02, 0.05}) {
    for (; sheared < strain - strain_per_step / 2.0; sheared += strain_per_step) stepper.step(packing, law, step);
    states.push_back(
        {strain == 0.0 ? "isotropic" : fmt::format("{:g} %", 100.0 * strain), packing, settled(packing), {}});
  }
  return states;
}

double sliding_share(Packing const& packing, double nearness) {
  double sliding = 0.0, all = 0.0;
  scarp::for_each_contact(packing, law, [&](scarp::Contact<2> const& contact) {
    all += 1.0;
    if (scarp::SlidingContacts{.nearness = nearness}.slides(contact, law)) sliding += 1.0;
  });
  return sliding / all;
}

}  // namespace

int main() {
  auto states = make_states();
  fmt::print(
      "| state | -s_xx, -s_yy [kPa] | sliding at rest | the same while moving: nearness 1e-2 | 1e-3 | 1e-9 |\n"
      "|---|---|---|---|---|---|\n");
  for (auto const& state : states) {
    auto const stress = scarp::balance(state.settled, law).stress;
    fmt::print("| {} | {:.0f}, {:.0f} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % |\n", state.name, -stress(0, 0) / 1e3,
               -stress(1, 1) / 1e3, 100.0 * sliding_share(state.settled, 1e-2),
               100.0 * sliding_share(state.moving, 1e-2), 100.0 * sliding_share(state.moving, 1e-3),
               100.0 * sliding_share(state.moving, 1e-9));
  }
  fmt::print(
      "\n| state | strain | C_xxxx | C_xxyy | C_yyxx | C_yyyy | C_xyxy [MPa] | central is off by | settled |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (auto& state : states) {
    for (double const amplitude : amplitudes) {
      scarp::PerturbationTangent const exact{.strain = amplitude,
                                             .strain_steps = std::max(20, static_cast<int>(amplitude / 1e-6)),
                                             .unbalanced_tolerance = 0.1 * amplitude,
                                             .most_steps = 200'000};
      auto const one_sided = exact.differentiate(state.settled, law, onward);
      auto const both_sides = exact.differentiate(state.settled, law);
      Voigt const& c = one_sided.tangent;
      state.answer.push_back(c);
      fmt::print("| {} | {:g} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} % | {} |\n", state.name, amplitude,
                 c(0, 0) / 1e6, c(0, 1) / 1e6, c(1, 0) / 1e6, c(1, 1) / 1e6, c(2, 2) / 1e6,
                 100.0 * (both_sides.tangent - c).norm() / c.norm(),
                 one_sided.verdict.acceptable() && both_sides.verdict.acceptable() ? "yes" : "no");
    }
  }

  using scarp::CondensedTangent;
  auto const policy = [](std::string name, auto const& tangent) {
    return Policy{std::move(name), [tangent](Packing const& packing) { return tangent(packing, law); }};
  };
  std::vector<Policy> const policies{
      policy("eq. 6", scarp::ElasticContactTangent{}),
      policy("condensed, share 1", CondensedTangent{.sliding = {.shear_share = 1.0}}),
      policy("condensed, share 0.5", CondensedTangent{.sliding = {.shear_share = 0.5}}),
      policy("condensed, share 0", CondensedTangent{}),
      policy("condensed, share 0, coupled", CondensedTangent{.sliding = {.coupled = true}}),
      {"mean of eq. 6 and condensed, share 0",
       [](Packing const& packing) -> Voigt {
         return (scarp::ElasticContactTangent{}(packing, law) + CondensedTangent{}(packing, law)) / 2.0;
       }},
      policy("perturbation", scarp::PerturbationTangent{})};

  double const step_time = [&] {
    Packing packing = states.back().moving;
    scarp::TimeStepper<Packing> stepper;
    scarp::Tensor<2> step = scarp::Tensor<2>::Zero();
    step.diagonal() << strain_per_step, -strain_per_step;
    constexpr int steps = 5000;
    return seconds([&] {
             for (int k = 0; k < steps; ++k) stepper.step(packing, law, step);
           }) /
           steps;
  }();
  fmt::print("\nOne DEM step takes {:.1f} us.\n\n| policy | us | DEM steps |\n|---|---|---|\n", 1e6 * step_time);
  std::vector<std::vector<Voigt>> tangents;
  for (auto const& candidate : policies) {
    std::vector<double> times;
    tangents.emplace_back();
    for (auto const& state : states) {
      tangents.back().emplace_back();
      int const calls = candidate.name == "perturbation" ? 1 : 11;
      for (int call = 0; call < calls; ++call) {
        times.push_back(seconds([&] { tangents.back().back() = candidate.tangent(state.settled); }));
      }
    }
    std::sort(times.begin(), times.end());
    double const median = times[times.size() / 2];
    fmt::print("| {} | {:.0f} | {:.0f} |\n", candidate.name, 1e6 * median, median / step_time);
  }
  for (std::size_t size = 0; size < amplitudes.size(); ++size) {
    fmt::print("\n| from the answer to {:g} |", amplitudes[size]);
    for (auto const& state : states) fmt::print(" {} |", state.name);
    fmt::print("\n|---|---|---|---|---|\n");
    for (std::size_t k = 0; k < policies.size(); ++k) {
      fmt::print("| {} |", policies[k].name);
      for (std::size_t n = 0; n < states.size(); ++n) {
        Voigt const& answer = states[n].answer[size];
        Voigt const off = tangents[k][n] - answer;
        fmt::print(" {:.3f} / {:.3f} |", off.norm() / answer.norm(), (off * onward).norm() / (answer * onward).norm());
      }
      fmt::print("\n");
    }
  }
}
