// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "scarp/solver/analysis.hpp"

namespace scarp {

/// When ground has failed. A load step that becomes too small is no failure by itself: one packing or one bad element
/// can cause it. Ground that has moved and then has no stiffness left has failed.
struct CollapseSettings {
  double failed = 100.0;  ///< largest displacement gradient per load, over that of the first step: the ground fails
  double failing = 10.0;  ///< the same where no equilibrium follows: less means that something else stopped it

  /// \throws InputError for ratios below 1
  void validate() const {
    require_at_least("ratio of displacement gradients per load of ground that fails", failing, 1.0);
    require_at_least("ratio of displacement gradients per load of ground that has failed", failed, failing);
  }
};

/// How `reduce_strength` looks for a factor of safety.
struct StrengthReduction {
  double from = 1.0;            ///< factor that is tried first
  double to = 3.0;              ///< largest factor that is tried
  double tolerance = 0.01;      ///< of the factor, relative
  double load = 1.0;            ///< load factor that is to be carried, beyond all knots of loads
  CollapseSettings collapse{};  ///< when ground has failed
  /// Settings of each analysis: a floor of the stiffness lets ground flow.
  AnalysisSettings analysis{
      .solver = {.tolerance = 1e-4, .max_iterations = 40, .rule = {.exact = {.floor = 1e-4}}},
      .stepping = {.first = 0.05, .smallest = 1e-4, .largest = 0.05, .max_displacement_gradient = 0.1}};

  /// \throws InputError for factors that are not positive or not increasing, and a tolerance outside of 1e-6 to 1
  void validate() const {
    require_positive("least factor of safety", from);
    require_at_least("largest factor of safety", to, from);
    require_between("tolerance of a factor of safety", tolerance, 1e-6, 1.0);
    detail::validated(collapse);
  }
};

/// Observer of the largest displacement gradient of a step per load, and of how it grows since the last knot of loads
/// and motions. Stops a run when the ground has failed.
class CollapseWatch {
 public:
  /// failed: ratio at which it stops a run
  explicit CollapseWatch(double failed) : failed_(failed) {}

  /// Measures a step in which the load has grown, or in which no equilibrium was found although all points responded.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!(report.load_increment > 0.0) || report.history.empty()) return;
    constexpr double round_off = 1e-9;  // of a load, and of a gradient: ground at rest does not move
    double const begin = report.load - report.load_increment;
    if (begin >= next_knot_ - round_off) first_ = 0.0;  // other loads grow: another stage
    double const compliance = problem.max_displacement_gradient() / report.load_increment;
    bool const accepted = report.verdict.acceptable();
    if (first_ == 0.0) {
      next_knot_ = std::numeric_limits<double>::infinity();
      if constexpr (requires { problem.next_knot(begin); }) next_knot_ = problem.next_knot(begin + round_off);
      if (accepted && problem.max_displacement_gradient() > round_off) first_ = compliance;
    }
    double const ratio = first_ > 0.0 ? compliance / first_ : 1.0;
    if (accepted) {
      ratio_ = beyond_ = ratio;
    } else {
      beyond_ = report.worst_point < 0 ? std::max(ratio_, ratio) : ratio_;
    }
  }
  bool wants_stop() const { return ratio_ >= failed_; }  ///< Whether the ground has failed.
  bool has_moved() const { return first_ > 0.0; }        ///< Whether a step of this stage was accepted that moved.
  /// Gradient per load of the last attempt over that of the first step that moved; of the last step where a point has
  /// stopped it.
  double ratio() const { return beyond_; }

 private:
  double failed_;
  double first_ = 0.0;  ///< gradient per load of the first step of a stage that moved; 0 before it
  double next_knot_ = std::numeric_limits<double>::infinity();  ///< load factor at which the stage ends
  double ratio_ = 1.0;
  double beyond_ = 1.0;
};

/// How a load ended.
struct [[nodiscard]] Collapse {
  bool failed = false;  ///< the ground has failed, at the load factor after this one
  double load = 0.0;    ///< last load factor in equilibrium
  double ratio = 1.0;   ///< displacement gradient per load of the last attempt over that of the first step
  RunReport run{};      ///< all that is known of the run
  std::string why{};    ///< in words

  bool stands() const { return run.verdict.acceptable() && !failed; }  ///< Whether the load was carried.
};

/// Raises the load factor of an analysis to `to`, or until the ground fails. The first step that moves, of this call
/// and after each knot of loads and motions, is what later ones are compared with: begin where the ground is still
/// stiff. Ground with friction fails slowly: compare the load with that of a larger `failed`. An observer watches too;
/// what it ends has not failed.
/// \throws InputError for settings outside of their range
template <int Dim, class Observer>
Collapse find_collapse(Analysis<Dim>& analysis, double to, CollapseSettings const& settings, Observer& observer) {
  detail::validated(settings);
  CollapseWatch watch(settings.failed);
  struct {
    CollapseWatch& watch;
    Observer& observer;
    void attempted(Problem<Dim> const& problem, StepReport const& report) {
      watch.attempted(problem, report);
      observer.attempted(problem, report);
    }
    bool wants_stop() const { return watch.wants_stop() || observer.wants_stop(); }
  } both{watch, observer};
  Collapse end;
  end.run = analysis.to(to, both);
  end.load = end.run.load;
  end.ratio = watch.ratio();
  bool const is_stuck = end.run.verdict.reason == Reason::step_too_small;
  bool const is_singular = end.run.verdict.reason == Reason::singular_system ||
                           (is_stuck && end.run.last_failure == Reason::singular_system);
  bool const is_out_of_balance = (is_singular && watch.has_moved()) || (is_stuck && end.ratio >= settings.failing);
  end.failed = watch.wants_stop() || is_out_of_balance;  // also in the step that comes to the end
  if (!end.failed) {
    end.why = analysis.why(end.run);
  } else if (end.ratio < settings.failing) {
    end.why = fmt::format("the ground fails beyond the load factor {:.6g}: it has no stiffness left", end.load);
    if (end.run.weak_dof >= 0) end.why += ", nothing holds " + analysis.problem().describe_dof(end.run.weak_dof);
  } else {
    end.why = fmt::format(
        "the ground fails beyond the load factor {:.6g}: displacement gradients per load are {:.3g} times "
        "those of the first step",
        end.load, end.ratio);
  }
  return end;
}
/// Without an observer. \throws InputError for settings outside of their range
template <int Dim>
Collapse find_collapse(Analysis<Dim>& analysis, double to, CollapseSettings const& settings = {}) {
  NoObserver nobody;
  return find_collapse(analysis, to, settings, nobody);
}

/// Factor by which a strength can be divided.
struct [[nodiscard]] SafetyFactor {
  double stands = 0.0;  ///< largest factor in equilibrium
  double fails = 0.0;   ///< smallest factor at which the ground fails; 0 where none was found
  std::string why{};    ///< how the last factor ended that was not carried

  bool is_found() const { return stands > 0.0 && fails > 0.0; }  ///< Whether both are known.
};

/// Strength reduction: make_model(factor) returns a `Model` whose strengths, c and tan(phi), are divided by the factor.
/// The interval between a factor that stands and one that fails is halved until it is within the tolerance. Use small
/// strain: in large strain ground may stiffen by its new shape.
/// A larger factor that the initial stress does not bear is too large, but no failure.
/// \return stands 0 where `from` fails, fails 0 where `to` stands, no factor was found that fails, or a run is stopped
/// by something else than failure
/// \throws InputError for settings outside of their range, and for a model with loads that change beyond the load
/// factor
template <class MakeModel>
SafetyFactor reduce_strength(MakeModel const& make_model, StrengthReduction const& settings = {}) {
  detail::validated(settings);
  SafetyFactor found;
  double high = settings.to;  // no larger factor is tried
  auto const is_known = [&](double factor) {
    auto const model = make_model(factor);
    std::optional<Analysis<std::remove_cvref_t<decltype(model)>::dim>> analysis;
    try {
      analysis.emplace(model, settings.analysis);
    } catch (InputError const& error) {  // the stress at rest was within the strength at a smaller factor
      if (factor == settings.from) throw;
      found.why = fmt::format("factor {:.4g}: {}", factor, error.what());
      high = factor;
      return true;
    }
    if (double const knot = analysis->problem().next_knot(settings.load); std::isfinite(knot)) {
      reject("a factor of safety is requested at the load factor {} (loads change at {}): give it a larger load factor",
             settings.load, knot);
    }
    Collapse const end = find_collapse(*analysis, settings.load, settings.collapse);
    if (!end.stands()) found.why = fmt::format("factor {:.4g}: {}", factor, end.why);
    if (end.stands()) found.stands = factor;
    if (end.failed) found.fails = high = factor;
    return end.stands() || end.failed;
  };
  if (!is_known(settings.from) || found.fails > 0.0 || !is_known(settings.to) || found.stands == settings.to)
    return found;
  while (high > found.stands * (1.0 + settings.tolerance)) {
    if (!is_known((found.stands + high) / 2.0)) {
      found.fails = 0.0;
      return found;
    }
  }
  return found;
}
}  // namespace scarp
