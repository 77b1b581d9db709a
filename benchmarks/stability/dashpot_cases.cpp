// SPDX-License-Identifier: BSL-1.0
// Time steps beyond the limit of a packing with strong dashpots: grains jitter at their contacts, and the stress follows a
// plausible curve of too little strength. Is that ever taken for an answer?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scarp/constitutive/dem_rve.hpp"
#include "scarp/constitutive/packings_by_depth.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "stability/groups.hpp"
#include "stability/measures.hpp"
#include "support/packings.hpp"

namespace stability {

namespace {

using Law = scarp::HertzMindlin<scarp::HertzRestitution>;
using Discs = scarp::Packing<scarp::Disc, Law>;
using Rve = scarp::DemRve<Discs, scarp::SamePacking<Discs>>;

Law law(double restitution) { return Law::of(7e9, 0.2, 0.55, {.restitution = restitution}); }

/// At rest under 200 kPa. It is prepared without dashpots, which take a third of the time step.
scarp::Prepared<Discs> at_rest(double restitution, int grains) {
  auto prepared = scarp::IsotropicPreparation{.pressure = samples::pressure}.prepare(
      samples::loose_cloud<Discs>(grains, 3), law(1.0));
  scarp::TimeStepper<Discs> stepper;
  for (int step = 0; step < 5000 && prepared.verdict.acceptable(); ++step) {
    prepared.verdict = stepper.step(prepared.packing, law(restitution), scarp::Tensor<2>::Zero());
  }
  return prepared;
}

/// Pure shear to 4 %. Means over the second half: the sin of the mobilised friction angle, of all and of good answers.
struct Sheared {
  int named = 0;    ///< answers that are not acceptable
  int answers = 0;  ///< of the second half
  int good = 0;     ///< of these
  double all = 0.0;
  double of_good = 0.0;
  scarp::Verdict last_named{};
};

/// Goes on from answers that are refused too, as one who did not look at the verdict would.
Sheared shear(Rve const& rve) {
  constexpr int increments = 40;
  scarp::Gradient<2> const increment{{1e-3, 0.0}, {0.0, -1e-3}};
  Sheared sheared;
  auto state = rve.initial_state({});
  auto trial = state;
  for (int k = 0; k < increments; ++k) {
    scarp::Verdict const verdict = rve.respond(state, increment, trial).verdict;
    if (!verdict.acceptable()) {
      ++sheared.named;
      sheared.last_named = verdict;
    }
    if (verdict.status == scarp::Status::failed) break;
    std::swap(state, trial);
    if (2 * k < increments) continue;
    auto const& stress = state.stress;
    double const sine = std::hypot(0.5 * (stress(0) - stress(1)), stress(2)) / (-0.5 * (stress(0) + stress(1)));
    ++sheared.answers;
    sheared.all += sine;
    if (!verdict.acceptable()) continue;
    ++sheared.good;
    sheared.of_good += sine;
  }
  sheared.all /= std::max(sheared.answers, 1);
  sheared.of_good /= std::max(sheared.good, 1);
  return sheared;
}

/// times_limit: time step over the packing's own limit
Outcome beyond(double restitution, double times_limit, Size size) {
  auto const [packing, prepared] = at_rest(restitution, size == Size::quick ? 60 : 200);
  if (!prepared.acceptable()) return {.measure = "nothing", .remark = "no rest"};
  Rve rve{.law = law(restitution), .source = {packing}};
  rve.time_step_share = 0.25;
  Sheared const reference = shear(rve);
  rve.time_step_share = times_limit;
  Sheared const sheared = shear(rve);

  Outcome outcome{.measure = "strength of the answers that were taken over that at a quarter of the limit, less one"};
  outcome.worst = sheared.good > 0 ? relative(sheared.of_good, reference.of_good) : 0.0;
  outcome.remark = fmt::format("{} answers named{}{}", sheared.named, sheared.named > 0 ? ", the last one " : "",
                               sheared.named > 0 ? name(sheared.last_named.reason) : "");
  if (sheared.answers > 0) {
    outcome.remark +=
        fmt::format("; all answers together would give {:+.1f} %", 100.0 * (sheared.all / reference.all - 1.0));
  }
  bool const all_taken = sheared.named == 0;
  outcome.as_expected = reference.named == 0 && outcome.worst <= 0.05 && (times_limit > 1.0 || all_taken);
  return outcome;
}

}  // namespace

Cases dashpot_cases() {
  Cases all;
  for (double const restitution : {0.5, 0.1}) {
    for (double const times_limit : {0.5, 0.8, 1.2, 1.5, 2.0, 3.0, 6.0}) {
      all.push_back({.group = "Dashpots beyond the limit",
                     .name = fmt::format("restitution {}, {} of the limit", restitution, times_limit),
                     .expected = times_limit < 1.0 ? "strength within 5 %" : "strength within 5 %, or named",
                     .run = [=](Size size) { return beyond(restitution, times_limit, size); }});
    }
  }
  return all;
}

}  // namespace stability
