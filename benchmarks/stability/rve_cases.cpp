// SPDX-License-Identifier: BSL-1.0
// A packing as constitutive law where it is loose, pulled, barely confined, sheared far, driven in leaps
// or shaken.
#include <fmt/format.h>

#include <cmath>

#include "scarp/core/nan_max.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "stability/shearing.hpp"
#include "support/packings.hpp"

namespace stability {

namespace {

using samples::Ellipses;
using scarp::Gradient;
using scarp::Status;
using scarp::Tensor;
using scarp::Verdict;
using scarp::VoigtStress;
using Rve = scarp::DemRve<Ellipses, scarp::SamePacking<Ellipses>>;

constexpr char const* group = "packings as constitutive law";

std::string words(Verdict const& verdict) {
  return verdict.acceptable() ? fmt::format("{}", name(verdict.status))
                              : fmt::format("{} / {}", name(verdict.status), name(verdict.reason));
}

Rve rve(Ellipses const& packing) { return {.law = samples::study_law(), .source = {packing}}; }
Rve rve(Size size) { return rve(samples::consolidated<Ellipses>(size == Size::quick ? 40 : 200).packing); }

double mean_pressure(VoigtStress<2> const& stress) { return -0.5 * (stress(0) + stress(1)); }
double max_shear(VoigtStress<2> const& stress) { return std::hypot(0.5 * (stress(0) - stress(1)), stress(2)); }

/// Of the mobilised friction angle.
double sine(VoigtStress<2> const& stress) { return max_shear(stress) / mean_pressure(stress); }

/// Largest principal stress [Pa], positive where it pulls.
double pull(VoigtStress<2> const& stress) { return max_shear(stress) - mean_pressure(stress); }

/// Responses to increments one after the other. One that is not balanced is evaluated again with twice the steps, as a
/// solver does, up to the provider's most steps; then it is taken as it is and counted.
struct Path {
  Rve provider;
  Rve::State state{};
  Verdict verdict{};
  int unbalanced = 0;
  double tension = 0.0;        ///< largest of balanced responses, over the pressure at the start
  double tension_share = 0.0;  ///< the same, over their own pressure

  explicit Path(Rve const& given)
      : provider(given), state(given.initial_state({})), start_(mean_pressure(state.stress)) {}

  bool go(Gradient<2> const& increment) {
    Rve::State trial;
    int plan = provider.plan(state, increment);
    verdict = provider.respond(state, increment, trial, plan).verdict;
    while (verdict.status == Status::not_converged && plan < provider.max_steps) {
      plan = provider.refined(plan);
      verdict = provider.respond(state, increment, trial, plan).verdict;
    }
    if (verdict.status == Status::failed) return false;
    state = trial;
    if (!verdict.acceptable()) {
      ++unbalanced;
    } else {
      tension = scarp::nan_max(tension, pull(state.stress) / start_);
      tension_share = scarp::nan_max(tension_share, pull(state.stress) / mean_pressure(state.stress));
    }
    return true;
  }

 private:
  double start_;
};

Gradient<2> isotropic(double strain) { return strain * Gradient<2>::Identity(); }
Gradient<2> simple_shear(double strain) {
  Gradient<2> gradient = Gradient<2>::Zero();
  gradient(0, 1) = strain;
  return gradient;
}

Outcome loose_and_back(Size size) {
  Path path(rve(size));
  double const before = mean_pressure(path.state.stress);
  Outcome outcome{.measure = "pressure after loosening by 5 % and back, over the one before"};
  for (int k = 0; k < 10; ++k) {
    if (!path.go(isotropic(5e-3))) return {.measure = "nothing", .remark = words(path.verdict)};
  }
  bool const empty = path.state.stress.isZero(0.0) && path.verdict.status == Status::fluid &&
                     path.provider.tangent(path.state).isZero(0.0);
  for (int k = 0; k < 10; ++k) {
    if (!path.go(isotropic(1.0 / 1.005 - 1.0))) return {.measure = "nothing", .remark = words(path.verdict)};
  }
  outcome.worst = mean_pressure(path.state.stress) / before;
  outcome.remark =
      fmt::format("{} while loose, then {}, {} unbalanced responses",
                  empty ? "stress and tangent exactly zero, fluid" : "not empty", words(path.verdict), path.unbalanced);
  outcome.as_expected = empty && path.verdict.status == Status::ok && outcome.worst > 0.5 && outcome.worst < 2.0;
  return outcome;
}

Outcome pulled(Size size) {
  Path path(rve(size));
  Gradient<2> along = Gradient<2>::Zero();
  along(1, 1) = 1e-3;
  constexpr int increments = 40;
  for (int k = 0; k < increments; ++k) {
    if (!path.go(along)) return {.measure = "nothing", .remark = words(path.verdict)};
  }
  return {.as_expected = path.tension < 1e-3 && path.unbalanced < increments,
          .worst = path.tension,
          .measure = "largest tension on the way over the pressure at the start",
          .remark = fmt::format("{} at the end, {} unbalanced responses", words(path.verdict), path.unbalanced)};
}

/// Pressure [Pa] below which the round-off of places, 1e-18 m times the stiffness, is a thousandth of the forces: a
/// packing may then report that it does not balance.
constexpr double nameable = 1e-5;

/// Packings that were brought to little pressure, then sheared a little.
Outcome barely_confined(double pressure, Size size) {
  auto packing = samples::consolidated<Ellipses>(size == Size::quick ? 40 : 200).packing;
  // More grains take longer to come to rest.
  long const max_steps = size == Size::quick ? 50'000 : 400'000;
  Verdict const reached = relieve(packing, samples::study_law(), samples::pressure, pressure, max_steps);
  Outcome outcome{.measure = "largest tension over the pressure",
                  .remark = fmt::format("brought there: {}", words(reached))};
  if (!reached.acceptable()) {
    outcome.as_expected = pressure < nameable;
    return outcome;
  }
  Path path(rve(packing));
  constexpr int increments = 10;
  for (int k = 0; k < increments; ++k) {
    if (!path.go(simple_shear(1e-5))) return {.measure = "nothing", .remark = words(path.verdict)};
  }
  if (path.unbalanced == increments) {
    outcome.as_expected = path.verdict == Verdict{Status::not_converged, scarp::Reason::unbalanced};
    outcome.worst = path.unbalanced;
    outcome.measure = "responses of ten that are named as unbalanced";
    return outcome;
  }
  outcome.worst = path.tension_share;
  outcome.remark += fmt::format(", sheared: {}, {} of 10 responses unbalanced", words(path.verdict), path.unbalanced);
  // The stress of one contact pulls by 1/cos - 1 of its own pressure, of the angle between force and branch: at most
  // Coulomb's and that by which an ellipse's arm may lean away from the normal.
  double lean = 0.0;
  auto const& population = *packing.population;
  for (std::size_t grain = 0; grain < population.count(); ++grain) {
    auto const [major, minor] = population.size(grain);
    lean = std::max(lean, std::atan((major * major - minor * minor) / (2.0 * major * minor)));
  }
  outcome.as_expected = path.tension_share < 1.0 / std::cos(std::atan(samples::study_law().friction) + lean) - 1.0;
  return outcome;
}

/// The cell's lattice is reduced again and again; a copy that is taken half-way continues with the same bits.
Outcome sheared_far(double strain, Size size) {
  Path path(rve(size));
  int const increments = static_cast<int>(std::lround(strain / 0.005));
  Outcome outcome{.measure = "largest sine of the mobilised friction angle"};
  Rve::State half_way;
  for (int k = 0; k < increments; ++k) {
    if (k == increments / 2) half_way = path.state;
    if (!path.go(simple_shear(0.005))) return {.measure = "nothing", .remark = words(path.verdict)};
    outcome.worst = scarp::nan_max(outcome.worst, sine(path.state.stress));
  }
  Path again(path.provider);
  again.state = half_way;
  for (int k = increments / 2; k < increments; ++k) {
    if (!again.go(simple_shear(0.005))) return {.measure = "nothing", .remark = words(again.verdict)};
  }
  bool const same = again.state.packing == path.state.packing;
  outcome.remark = fmt::format("{} unbalanced responses, {} bits when taken up half-way", path.unbalanced,
                               same ? "the same" : "other");
  outcome.as_expected = same && path.tension < 1e-3 && outcome.worst < 0.8;
  return outcome;
}

/// One increment against the same motion in many. The packing's own plan spreads it over DEM steps.
Outcome leap(double strain, double within, Size size) {
  Gradient<2> gradient = Gradient<2>::Zero();
  gradient(0, 0) = strain;
  gradient(1, 1) = 1.0 / (1.0 + strain) - 1.0;
  Path at_once(rve(size));
  bool const acceptable = at_once.go(gradient);
  Outcome outcome{.measure = "difference of the sine of the friction angle from that of 50 increments",
                  .remark = words(at_once.verdict)};
  if (!acceptable) return outcome;
  Path slowly(rve(size));
  // 50 equal stretches of the same constant rate.
  Gradient<2> small = Gradient<2>::Zero();
  small(0, 0) = std::pow(1.0 + strain, 0.02) - 1.0;
  small(1, 1) = std::pow(1.0 + strain, -0.02) - 1.0;
  for (int k = 0; k < 50; ++k) {
    if (!slowly.go(small)) return {.measure = "nothing", .remark = words(slowly.verdict)};
  }
  outcome.worst = std::abs(sine(at_once.state.stress) - sine(slowly.state.stress));
  // A response that is not balanced makes the solver cut the step: that is a result too.
  outcome.as_expected = !at_once.verdict.acceptable() || outcome.worst <= within;
  return outcome;
}

/// Strains so small that hardly any contact slides.
Outcome cycles(Size size) {
  Path path(rve(size));
  auto const start = path.state.stress;
  constexpr int count = 1000;
  constexpr double amplitude = 1e-7;
  int const shown = count / 10;
  double drift_of_first = 0.0;
  for (int k = 0; k < count; ++k) {
    for (double const strain : {amplitude, -2.0 * amplitude, amplitude}) {
      if (!path.go(simple_shear(strain))) return {.measure = "nothing", .remark = words(path.verdict)};
    }
    if (k + 1 == shown) drift_of_first = (path.state.stress - start).norm() / mean_pressure(start);
  }
  double const drift = (path.state.stress - start).norm() / mean_pressure(start);
  return {.as_expected = drift <= 1e-3,
          .worst = drift,
          .measure = "change of stress over the pressure after 1000 cycles of 1e-7",
          .remark = fmt::format("{:.2g} after 100, {} unbalanced responses", drift_of_first, path.unbalanced)};
}

}  // namespace

Cases rve_cases() {
  Cases all;
  auto const add = [&](std::string name, std::string expected, std::function<Outcome(Size)> run) {
    all.push_back({.group = group, .name = std::move(name), .expected = std::move(expected), .run = std::move(run)});
  };
  add("loosened until nothing touches, then compressed", "exactly zero and fluid; then a pressure again",
      loose_and_back);
  add("pulled along one axis by 4 %", "no tension", pulled);
  for (double const pressure : {1.0, 1e-2, 1e-4, 1e-6}) {
    add(fmt::format("confined by {} Pa", pressure),
        fmt::format("{}; sheared, no more tension than of one sliding contact, or named as unbalanced",
                    pressure < nameable ? "gets there, or reports the reason" : "gets there"),
        [pressure](Size size) { return barely_confined(pressure, size); });
  }
  for (double const strain : {0.25, 0.5, 1.0}) {
    add(fmt::format("simple shear of {} %", 100.0 * strain),
        "a sand's friction angle; the same bits when taken up half-way",
        [strain](Size size) { return sheared_far(strain, size); });
  }
  for (double const strain : {0.01, 0.05, 0.2}) {
    add(fmt::format("{} % in one increment", 100.0 * strain), "within 0.1 of the path in 50 increments, or unbalanced",
        [strain](Size size) { return leap(strain, 0.1, size); });
  }
  add("1000 tiny cycles", "stress within 1e-3 of the pressure", cycles);
  return all;
}

}  // namespace stability
