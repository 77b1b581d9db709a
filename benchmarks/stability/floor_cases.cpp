// SPDX-License-Identifier: BSL-1.0
// Ground over a fault whose points become fluid in tension, held by stiffness floors.
#include <fmt/format.h>

#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/observe/floor_share.hpp"
#include "stability/groups.hpp"
#include "stability/measures.hpp"

namespace stability {

namespace {

/// Elastic ground without tension, as a packing: its deviatoric stress is at most its pressure, and beyond that it is
/// fluid until it is as dense as before.
struct Crumbling {
  static constexpr int dim = 2;
  using Elastic = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  struct State {
    Elastic::State own;  ///< as if nothing ever crumbled
  };

  Elastic elastic{};

  State initial_state(scarp::Site<2> const& site) const { return {elastic.initial_state(site)}; }

  static double pressure(State const& state) { return -state.own.stress.head<2>().sum() / 2.0; }
  scarp::VoigtStress<2> stress(State const& state) const {
    double const p = pressure(state);
    if (!(p > 0.0)) return scarp::VoigtStress<2>::Zero();
    scarp::VoigtStress<2> shear = state.own.stress;
    shear.head<2>().array() += p;
    double const size = std::hypot(shear(0), shear(2));
    scarp::VoigtStress<2> all = shear * std::min(1.0, size > 0.0 ? p / size : 1.0);
    all.head<2>().array() -= p;
    return all;
  }
  scarp::VoigtTangent<2> tangent(State const& state) const {
    return (pressure(state) > 0.0 ? 1.0 : 0.0) * elastic.tangent(state.own);
  }
  scarp::Response<2> respond(State const& committed, scarp::Gradient<2> const& increment, State& trial) const {
    trial = committed;
    auto const answer = elastic.respond(committed.own, increment, trial.own);
    if (!answer.verdict.acceptable()) return {stress(committed), answer.verdict};
    if (pressure(trial) > 0.0) return {stress(trial), {}};
    return {stress(trial), {scarp::Status::fluid, scarp::Reason::no_contacts}};
  }
};

using Soil = scarp::StiffnessFloor<Crumbling>;

struct Ran {
  scarp::RunReport run;
  double share = 0.0;
  int fluid = 0;
  int points = 0;
  int attempts = 0;
  bool whole = true;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {
    ++attempts;
  }
  bool wants_stop() const { return attempts >= 1000; }
};

Ran run_with(double share, double throw_over_depth) {
  scarp::FreeFieldFault<Soil> scene;
  scene.ground.layer.size = 5.0;
  scene.fault.dip = std::numbers::pi / 6.0;
  scene.throw_to = throw_over_depth * scene.ground.layer.depth;
  scene.surcharge = 0.0;
  scene.soil.share = share;
  scene.soil.provider.elastic =
      Crumbling::Elastic::from_young_poisson(25e6, 0.25, {scene.surcharge, scene.unit_weight, 0.4});
  scene.solver.tolerance = 1e-4;
  scene.stepping.largest = 2e-2;
  scarp::SerialExecutor serial;
  auto problem = scene.problem(serial);
  Ran ran;
  ran.run = scene.settle(problem, ran);
  if (ran.run.verdict.acceptable()) ran.run = scarp::joined(ran.run, scene.rupture(problem, ran));
  ran.share = floor_share(problem);
  ran.points = problem.materials().point_count();
  for (int point = 0; point < ran.points; ++point) {
    problem.materials().visit(point,
                              [&](auto const& field, int local) { ran.fluid += field.committed(local).fluid ? 1 : 0; });
  }
  for (auto const& stress : problem.committed_stresses()) ran.whole &= stress.allFinite();
  for (auto const& place : problem.discretisation().positions()) ran.whole &= place.allFinite();
  return ran;
}

std::string words(Ran const& ran) {
  return fmt::format("{} (last refusal {}) at throw {:.3g} m, {} of {} points fluid, {} attempts, {} refused",
                     name(ran.run.verdict.reason), name(ran.run.last_failure), ran.run.load, ran.fluid, ran.points,
                     ran.attempts, ran.run.refused);
}

Outcome held_by(double share) {
  auto const ran = run_with(share, 0.004);
  auto outcome = at_most(0.01, ran.share, "share of the floors in all stress", words(ran));
  outcome.as_expected &= ran.run.verdict.acceptable() && ran.fluid > 0 && ran.share > 0.0 && ran.whole;
  return outcome;
}

/// Floors below the round-off of their neighbours, and a throw that tears the ground: the end, or a named status.
Outcome ends_named(double share, double throw_over_depth) {
  auto const ran = run_with(share, throw_over_depth);
  bool const named = ran.run.verdict.acceptable() || ran.run.verdict.reason == scarp::Reason::singular_system ||
                     ran.run.verdict.reason == scarp::Reason::step_too_small;
  return {named && ran.whole && ran.attempts < 1000, ran.share, "share of the floors in all stress", words(ran)};
}

}  // namespace

Cases floor_cases() {
  Cases cases;
  for (double const share : {1e-2, 1e-3, 1e-4}) {
    cases.push_back({"fluid ground", fmt::format("stiffness floor of {:g}", share),
                     "reaches the throw; the floors' share is told and below 1 %",
                     [=](Size) { return held_by(share); }});
  }
  std::string const named = "the end, singular_system or step_too_small within bounded work";
  cases.push_back({"fluid ground", "stiffness floor of 1e-30", named, [](Size) { return ends_named(1e-30, 0.004); }});
  cases.push_back({"fluid ground", "throw of 2 % of the depth", named, [](Size) { return ends_named(1e-4, 0.02); }});
  return cases;
}

}  // namespace stability
