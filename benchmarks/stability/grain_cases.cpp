// SPDX-License-Identifier: BSL-1.0
// Contact laws at the ends of their parameters in packings that are compressed and sheared, and time steps.
#include <fmt/format.h>

#include <cmath>

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/core/nan_max.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "stability/shearing.hpp"

namespace stability {

namespace {

constexpr char const* group = "contacts";
constexpr double study_stiffness = 6e6;  // [N/m]

/// Stiffnesses and frictions that no sand has, through preparation and shear.
Case extreme_law(std::string name, double stiffness_ratio, double friction) {
  auto const run = [=](Size size) {
    scarp::LinearFrictional const law{.normal_stiffness = study_stiffness,
                                      .tangential_stiffness = stiffness_ratio * study_stiffness,
                                      .friction = friction};
    Sheared const end = prepared_and_sheared({.law = law, .grains = size == Size::quick ? 40 : 200});
    Outcome outcome{.worst = end.strength, .measure = "sin of the mobilised friction angle; " + end.words()};
    bool const symmetric = friction > 0.0 || end.skew_share < 1e-12;
    bool const smooth = friction < 1e-6 || stiffness_ratio < 1e-3;
    outcome.as_expected = end.verdict.acceptable() && symmetric && end.strength > (smooth ? 0.0 : 0.2) &&
                          end.strength < (smooth ? 0.2 : 0.8);
    return outcome;
  };
  return {.group = group,
          .name = std::move(name),
          .expected = friction == 0.0 ? "sin of the angle below 0.2, as of smooth grains; stress symmetric to round-off"
                      : friction < 1e-6 || stiffness_ratio < 1e-3 ? "sin of the angle below 0.2, as of smooth grains"
                                                                  : "sin of the angle from 0.2 to 0.8",
          .run = run};
}

/// Two laws that should differ by nothing that counts.
Case same_strength(std::string name, double friction, double other_friction, double within) {
  auto const run = [=](Size size) {
    auto const strength = [&](double coefficient) {
      scarp::LinearFrictional const law{
          .normal_stiffness = study_stiffness, .tangential_stiffness = study_stiffness, .friction = coefficient};
      Sheared const end = prepared_and_sheared({.law = law, .grains = size == Size::quick ? 40 : 200});
      return end.verdict.acceptable() ? end.strength : std::nan("");
    };
    double const difference = std::abs(strength(friction) - strength(other_friction));
    return Outcome{.as_expected = difference <= within,
                   .worst = difference,
                   .measure = "difference of the sins of the mobilised friction angles"};
  };
  return {.group = group, .name = std::move(name), .expected = fmt::format("the same within {}", within), .run = run};
}

/// kappa = k_n / (pressure x thickness): overlaps are about 1/kappa of a grain. One packing, prepared at 1e3 or less
/// and relieved. Springs give way by about 1/kappa, so that strains are counted in that.
template <class Grains = samples::Discs>
Sheared at_stiffness_number(double kappa, int grains) {
  auto const pressure = [](double number) { return study_stiffness / (number * samples::thickness); };
  return prepared_and_sheared<Grains>(
      {.law = {.normal_stiffness = study_stiffness, .tangential_stiffness = study_stiffness, .friction = 0.55},
       .grains = grains,
       .prepared_at = pressure(std::min(kappa, 1e3)),
       .pressure = pressure(kappa),
       .strain_per_step = std::min(1e-5, 1e-2 / kappa),
       .strain = std::min(0.02, 20.0 / kappa)});
}

/// Below, the strength still changes: by softness up to 1e2, in between by contacts that are lost when a packing is
/// relieved.
constexpr double converged = 1e6;

Case stiffness_number(double kappa, double reference, double within) {
  auto const run = [=](Size) {
    constexpr int grains = 200;  // the strength of 60 is an accident of round-off
    Sheared const end = at_stiffness_number(kappa, grains);
    Sheared const stiff = at_stiffness_number(reference, grains);
    Outcome outcome{.worst = std::abs(end.strength - stiff.strength),
                    .measure = fmt::format("change of the sin of the friction angle against kappa = {:.0e}; {}",
                                           reference, end.words())};
    outcome.as_expected = end.verdict.acceptable() && stiff.verdict.acceptable() &&
                          (kappa < converged || (end.held < 0.05 && outcome.worst <= within));
    return outcome;
  };
  return {.group = group,
          .name = fmt::format("stiffness number {:.0e}", kappa),
          .expected = kappa < converged ? "settles; what the softness changes is stated"
                                        : fmt::format("settles; strength within {} of that of stiffer grains", within),
          .run = run};
}

/// Places of single precision are good to 1e-7 of the cell: forces in stiff contacts are round-off then.
Case in_single_precision(double kappa) {
  bool const resolved = kappa < 1e3;
  auto const run = [=](Size size) {
    using FloatDiscs = scarp::Packing<scarp::Disc, scarp::LinearFrictional, float>;
    int const grains = size == Size::quick ? 60 : 200;
    Sheared const end = at_stiffness_number<FloatDiscs>(kappa, grains);
    double const exact = at_stiffness_number(kappa, grains).strength;
    constexpr scarp::Verdict rejected{scarp::Status::not_converged, scarp::Reason::unbalanced};
    Outcome outcome{.worst = std::abs(end.strength - exact),
                    .measure = "change of the sin of the friction angle against double precision; " + end.words()};
    outcome.as_expected = resolved ? end.verdict.acceptable() && outcome.worst < 0.05 : end.verdict == rejected;
    return outcome;
  };
  return {.group = group,
          .name = fmt::format("single precision, stiffness number {:.0e}", kappa),
          .expected = resolved ? "the strength of double precision within 0.05 (another packing)"
                               : "not_converged / unbalanced",
          .run = run};
}

using Law = scarp::HertzMindlin<scarp::HertzRestitution>;
using DampedDiscs = scarp::Packing<scarp::Disc, Law>;
using Rve = scarp::DemRve<DampedDiscs, scarp::SamePacking<DampedDiscs>>;

Law dashpot_law(double restitution) {
  return Law::of({.modulus = 7e9, .poisson = 0.2}, 0.55, {.restitution = restitution});
}

/// At rest under 200 kPa, prepared without dashpots, which need a third of the time step.
scarp::Prepared<DampedDiscs> at_rest(double restitution, int grains) {
  auto prepared = scarp::IsotropicPreparation{.pressure = samples::pressure}.prepare(
      samples::loose_cloud<DampedDiscs>(grains, 3), dashpot_law(1.0));
  scarp::TimeStepper<DampedDiscs> stepper;
  for (int step = 0; step < 5000 && prepared.verdict.acceptable(); ++step) {
    prepared.verdict = stepper.step(prepared.packing, dashpot_law(restitution), scarp::Tensor<2>::Zero());
  }
  return prepared;
}

/// Pure shear to 4 %: the sin of the mobilised friction angle, mean of the accepted responses of the second half.
struct DashpotShear {
  int named = 0;  ///< responses that are not acceptable
  int good = 0;   ///< acceptable ones of the second half
  double of_good = 0.0;
};

/// Continues from rejected responses too, as one who did not look at the verdict would.
DashpotShear shear(Rve const& rve) {
  constexpr int increments = 40;
  scarp::Gradient<2> const increment{{1e-3, 0.0}, {0.0, -1e-3}};
  DashpotShear sheared;
  auto state = rve.initial_state({});
  auto trial = state;
  for (int k = 0; k < increments; ++k) {
    scarp::Verdict const verdict = rve.respond(state, increment, trial).verdict;
    if (!verdict.acceptable()) {
      ++sheared.named;
    }
    if (verdict.status == scarp::Status::failed) break;
    std::swap(state, trial);
    if (2 * k < increments) continue;
    auto const& stress = state.stress;
    double const sine = std::hypot(0.5 * (stress(0) - stress(1)), stress(2)) / (-0.5 * (stress(0) + stress(1)));
    if (!verdict.acceptable()) continue;
    ++sheared.good;
    sheared.of_good += sine;
  }
  sheared.of_good /= std::max(sheared.good, 1);
  return sheared;
}

/// share: of the critical step, which is a lower bound of the packing's own limit
Outcome beyond(double restitution, double share, Size size) {
  auto const [packing, prepared] = at_rest(restitution, size == Size::quick ? 60 : 200);
  if (!prepared.acceptable()) return {.measure = "no rest"};
  Rve rve{.law = dashpot_law(restitution), .source = {packing}};
  rve.time_step_share = 0.25;
  DashpotShear const reference = shear(rve);
  rve.time_step_share = share;
  DashpotShear const sheared = shear(rve);

  Outcome outcome{.measure = "strength of the accepted responses over that at a quarter of the step, less one"};
  outcome.worst = sheared.good > 0 ? relative(sheared.of_good, reference.of_good) : 0.0;
  outcome.measure += fmt::format("; {} responses rejected", sheared.named);
  outcome.as_expected = reference.named == 0 && outcome.worst <= 0.05 && (share > 1.0 || sheared.named == 0);
  return outcome;
}

/// Does the energy of an undamped lattice in balance, nudged by 1e-9 m/s, grow at a share of its critical step?
/// \return its growth in 2000 steps
template <class Law>
double growth(Law const& law, double share) {
  using Grains = scarp::Packing<scarp::Disc, Law>;
  double const radius = 5e-3;
  auto grains = samples::triangular_lattice<Grains>(4, radius, 2.0 * radius * (1.0 - 1e-4));
  scarp::TimeStepper<Grains> stepper;
  stepper.damping = {.factor = 0.0, .drag = 0.0};
  stepper.time_step_share = share;
  scarp::Random random(1);
  for (std::size_t i = 0; i < grains.grain_count(); ++i) {
    for (int a = 0; a < 2; ++a) grains.velocity(i, a) = random.uniform(-1e-9, 1e-9);
  }
  auto const speed = [&] {
    double most = 0.0;
    for (std::size_t i = 0; i < grains.grain_count(); ++i)
      most = scarp::nan_max(most, std::hypot(grains.velocity(i, 0), grains.velocity(i, 1)));
    return most;
  };
  double const before = speed();
  for (int step = 0; step < 2000 && speed() < 1e-3; ++step) {
    if (!stepper.step(grains, law, scarp::Tensor<2>::Zero()).acceptable()) break;
  }
  return speed() / before;
}

/// Steady at the default step, without bound at twenty times it (the bound of Hertz's law holds for deeper overlaps,
/// too): the bound is neither missing nor idle.
template <class Law>
Case default_step(std::string const& name, Law const& law) {
  return {.group = "time step",
          .name = name,
          .expected = "velocities stay below ten times the nudge; at twenty times the default step they grow",
          .run = [law](Size) {
            auto outcome = at_most(10.0, growth(law, scarp::default_time_step_share), "growth of the velocities");
            outcome.as_expected &= growth(law, 20.0 * scarp::default_time_step_share) > 1e3;
            return outcome;
          }};
}

}  // namespace

Cases grain_cases() {
  Cases all;
  for (double const ratio : {0.0, 1e-6, 0.3, 1.0, 10.0}) {
    all.push_back(extreme_law(fmt::format("k_t/k_n = {}", ratio), ratio, 0.55));
  }
  for (double const friction : {0.0, 1e-12, 10.0, 1e6}) {
    all.push_back(extreme_law(fmt::format("friction {}", friction), 1.0, friction));
  }
  all.push_back(same_strength("friction 0 and 1e-12", 0.0, 1e-12, 0.05));
  all.push_back(same_strength("friction 10 and 1e6", 10.0, 1e6, 0.05));
  for (double const kappa : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
    all.push_back(stiffness_number(kappa, 10.0 * kappa, 0.05));
  }
  for (double const kappa : {1e2, 1e3, 1e5}) all.push_back(in_single_precision(kappa));
  for (double const restitution : {0.5, 0.1}) {
    for (double const share : {0.78, 1.5, 3.0, 6.0, 12.0}) {
      all.push_back({.group = "time step",
                     .name = fmt::format("dashpots of restitution {}, {} of the critical step", restitution, share),
                     .expected = share < 1.0 ? "strength within 5 %" : "strength within 5 %, or rejected",
                     .run = [=](Size size) { return beyond(restitution, share, size); }});
    }
  }
  constexpr double endless = 1e6;  // friction
  scarp::LinearFrictional const springs{
      .normal_stiffness = study_stiffness, .tangential_stiffness = study_stiffness, .friction = endless};
  all.push_back(default_step("springs", scarp::Frictionless{.normal_stiffness = study_stiffness}));
  all.push_back(default_step("springs and friction", springs));
  all.push_back(default_step("rolling resistance",
                             scarp::RollingResistance<scarp::LinearFrictional>{
                                 .law = springs, .rolling_stiffness = 6e6 * 25e-6, .rolling_friction = endless}));
  all.push_back(
      default_step("Hertz and Mindlin", scarp::HertzMindlin<>::of({.modulus = 7e9, .poisson = 0.2}, endless)));
  for (double const restitution : {0.9, 0.5, 0.1}) {
    all.push_back(default_step(fmt::format("Hertz and Mindlin, restitution {}", restitution),
                               Law::of({.modulus = 7e9, .poisson = 0.2}, endless, {.restitution = restitution})));
  }
  return all;
}

}  // namespace stability
