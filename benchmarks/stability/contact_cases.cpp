// SPDX-License-Identifier: BSL-1.0
// Contact laws at the ends of their parameters, alone and in packings that are compressed and sheared.
#include <fmt/format.h>

#include <cmath>

#include "scarp/core/worse_of.hpp"
#include "stability/groups.hpp"
#include "stability/shearing.hpp"

namespace stability {

namespace {

constexpr char const* group = "Contacts";
constexpr double study_stiffness = 6e6;  // [N/m]

/// A contact that opens and closes by round-off while it is dragged to and fro.
Outcome chatter(Size size) {
  scarp::LinearFrictional const law{
      .normal_stiffness = study_stiffness, .tangential_stiffness = study_stiffness, .friction = 0.55};
  scarp::ContactMemory<2, double> memory;
  Outcome outcome{.as_expected = true, .measure = "largest shear over friction times normal force"};
  long closed = 0;
  long const steps = size == Size::quick ? 100'000 : 10'000'000;
  for (long step = 0; step < steps; ++step) {
    double const overlap = (step % 2 == 0 ? 1e-18 : -1e-18) * static_cast<double>(step % 7);
    auto const force = law.respond<2, double>({.overlap = overlap, .slip = step % 3 == 0 ? 1e-6 : -1e-6}, memory);
    if (overlap <= 0.0 && (force.normal != 0.0 || force.shear != 0.0)) outcome.as_expected = false;
    if (force.normal == 0.0) continue;
    ++closed;
    outcome.worst = scarp::worse_of(outcome.worst, std::abs(force.shear / (law.friction * force.normal)));
  }
  outcome.remark = fmt::format("a force in {} of {} steps", closed, steps);
  outcome.as_expected = outcome.as_expected && closed > steps / 3 && outcome.worst <= 1.0;
  return outcome;
}

/// Stiffnesses and frictions that no sand has, through preparation and shear.
Case extreme_law(std::string name, double stiffness_ratio, double friction) {
  auto const run = [=](Size size) {
    scarp::LinearFrictional const law{.normal_stiffness = study_stiffness,
                                      .tangential_stiffness = stiffness_ratio * study_stiffness,
                                      .friction = friction};
    Sheared const end = prepared_and_sheared({.law = law, .grains = size == Size::quick ? 40 : 200});
    Outcome outcome{.worst = end.strength, .measure = "sin of the mobilised friction angle", .remark = end.words()};
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
  auto const run = [=](Size size) {
    int const grains = size == Size::quick ? 60 : 200;
    Sheared const end = at_stiffness_number(kappa, grains);
    Sheared const stiff = at_stiffness_number(reference, grains);
    Outcome outcome{.worst = std::abs(end.strength - stiff.strength),
                    .measure = fmt::format("change of the sin of the friction angle against kappa = {:.0e}", reference),
                    .remark = end.words()};
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
    constexpr scarp::Verdict refused{scarp::Status::not_converged, scarp::Reason::unbalanced};
    Outcome outcome{.worst = std::abs(end.strength - exact),
                    .measure = "change of the sin of the friction angle against double precision",
                    .remark = end.words()};
    outcome.as_expected = resolved ? end.verdict.acceptable() && outcome.worst < 0.05 : end.verdict == refused;
    return outcome;
  };
  return {.group = group,
          .name = fmt::format("single precision, stiffness number {:.0e}", kappa),
          .expected = resolved ? "the strength of double precision within 0.05 (another packing)"
                               : "not_converged / unbalanced",
          .run = run};
}

}  // namespace

Cases contact_cases() {
  Cases all{{.group = group,
             .name = "one contact that chatters at zero overlap",
             .expected = "no force while open, shear within Coulomb's limit while closed",
             .run = chatter}};
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
  return all;
}

}  // namespace stability
