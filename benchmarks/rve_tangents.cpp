// SPDX-License-Identifier: BSL-1.0
// How far is each tangent policy from the derivative of a packing's stress, and what does it cost? 400 ellipses at
// 200 kPa and after pure shear; writes tangents.csv.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../examples/shared/study/study_sand.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/perturbation_tangent.hpp"
#include "shared/condensed_tangent.hpp"
#include "shared/data_file.hpp"

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
  Packing moving;               ///< as the shearing left it
  Packing settled;              ///< the base of all tangents
  std::vector<Voigt> response;  ///< for each amplitude
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
    auto const verdict = stepper.step<scarp::Observe::balance>(packing, law, scarp::Tensor<2>::Zero(), &seen);
    if (!verdict.acceptable()) throw std::runtime_error("a packing does not settle");
    if (step % 100 == 0 && seen.unbalanced_ratio < 1e-7) break;
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
    for (; sheared < strain - strain_per_step / 2.0; sheared += strain_per_step) {
      if (!stepper.step(packing, law, step).acceptable()) throw std::runtime_error("a step of the shear failed");
    }
    states.push_back(
        {strain == 0.0 ? "isotropic" : fmt::format("{:g} %", 100.0 * strain), packing, settled(packing), {}});
  }
  return states;
}

}  // namespace

/// --quick: the first two states
int main(int argc, char** argv) {
  auto states = make_states();
  if (benchmarks::is_quick(argc, argv)) states.resize(2);
  for (auto& state : states) {
    for (double const amplitude : amplitudes) {
      scarp::PerturbationTangent<> const exact{.strain = amplitude,
                                               .strain_steps = std::max(20, static_cast<int>(amplitude / 1e-6)),
                                               .unbalanced_tolerance = 0.1 * amplitude,
                                               .max_steps = 200'000};
      auto const one_sided = exact.differentiate(state.settled, law, onward);
      if (!one_sided.verdict.acceptable()) fmt::print(stderr, "{}, {:g}: not settled\n", state.name, amplitude);
      state.response.push_back(one_sided.tangent);
    }
  }

  using benchmarks::CondensedTangent;
  auto const policy = [](std::string name, auto const& tangent) {
    return Policy{std::move(name), [tangent](Packing const& packing) { return tangent(packing, law); }};
  };
  std::vector<Policy> const policies{
      policy("elastic contacts, affine motion", scarp::AffineTangent{}),
      policy("condensed, share 1", CondensedTangent{.sliding = {.shear_share = 1.0}}),
      policy("condensed, share 0.5", CondensedTangent{.sliding = {.shear_share = 0.5}}),
      policy("condensed, share 0", CondensedTangent{}),
      policy("condensed, share 0, coupled", CondensedTangent{.sliding = {.coupled = true}}),
      policy("perturbation", scarp::PerturbationTangent{})};

  double const step_time = [&] {
    Packing packing = states.back().moving;
    scarp::TimeStepper<Packing> stepper;
    scarp::Tensor<2> step = scarp::Tensor<2>::Zero();
    step.diagonal() << strain_per_step, -strain_per_step;
    constexpr int steps = 5000;
    return seconds([&] {
             for (int k = 0; k < steps; ++k) static_cast<void>(stepper.step(packing, law, step));
           }) /
           steps;
  }();
  scarp::CsvTable table({"tangent", "state", "strain of the reference", "error [%]", "error along the path [%]",
                         "time [us]", "time in DEM steps"});
  for (auto const& candidate : policies) {
    for (auto const& state : states) {
      std::vector<double> times;
      Voigt tangent;
      int const calls = candidate.name == "perturbation" ? 1 : 11;
      for (int call = 0; call < calls; ++call)
        times.push_back(seconds([&] { tangent = candidate.tangent(state.settled); }));
      std::nth_element(times.begin(), times.begin() + calls / 2, times.end());
      double const median = times[static_cast<std::size_t>(calls / 2)];
      for (std::size_t size = 0; size < amplitudes.size(); ++size) {
        Voigt const& response = state.response[size];
        Voigt const off = tangent - response;
        table.add(candidate.name, state.name, amplitudes[size], 100.0 * off.norm() / response.norm(),
                  100.0 * (off * onward).norm() / (response * onward).norm(), 1e6 * median, median / step_time);
      }
    }
  }
  benchmarks::write_data("tangents", table.text());
}
