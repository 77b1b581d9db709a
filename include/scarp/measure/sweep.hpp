// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/measure/cpu_time.hpp"
#include "scarp/measure/detail/sweep_evaluation.hpp"
#include "scarp/measure/measured.hpp"

namespace scarp {

/// measure(settings), or measure(settings, repetition) where the repetition chooses the sample (the seed)
template <class Measure, class Settings>
concept MeasuresSettings = std::is_invocable_r_v<Measured, Measure const&, Settings const&> ||
    std::is_invocable_r_v<Measured, Measure const&, Settings const&, int>;

/// Error and CPU time of a scene over its settings: one knob at a time away from a base setting, any combinations
/// beside.
///
///     Sweep sweep("column", Settings{}, measure);
///     sweep.reference(Settings{.cells = 512});
///     sweep.vary("cells", &Settings::cells, {4, 8, 16, 32});
///     auto const table = sweep.run(3);
///
/// Settings is the user's aggregate. Repetitions of all settings follow each other and the base setting is measured
/// again between them, so that costs are ratios to the base setting at about the same time, whatever else the machine
/// does.
template <class Settings>
class Sweep {
 public:
  double least_seconds = 0.02;  ///< shorter runs are repeated until so much CPU time [s] is spent, and the mean taken
  std::size_t runs_per_baseline = 10;  ///< after so many the base setting is measured again

  template <MeasuresSettings<Settings> Measure>
  Sweep(std::string name, Settings base, Measure measure)
      : name_(std::move(name)),
        base_(std::move(base)),
        samples_(std::is_invocable_v<Measure const&, Settings const&, int>),
        measure_([measure = std::move(measure)](Settings const& settings, int repetition) {
          return call(measure, settings, repetition);
        }) {
    runs_.push_back({.knob = "base", .setting = "", .measure = with(base_)});
  }

  /// Settings whose answer counts as exact; run once for every sample.
  void reference(Settings const& settings) { reference_ = with(settings); }
  /// The exact answer.
  void exact(Measured answer) {
    exact_ = true;
    reference_ = [answer = std::move(answer)](int) { return answer; };
  }

  template <class Member>
  void vary(std::string const& knob, Member Settings::*member,
            std::vector<std::type_identity_t<Member>> const& values) {
    std::vector<Choice> choices;
    for (auto const& value : values) {
      double number = not_a_number;
      if constexpr (std::is_arithmetic_v<Member>) number = static_cast<double>(value);
      choices.push_back({in_words(value), number, [=](Settings& settings) { settings.*member = value; }});
    }
    add(knob, std::move(choices), false);
  }

  /// change(settings, value)
  template <std::invocable<Settings&, double> Change>
  void vary(std::string const& knob, Change change, std::vector<double> const& values) {
    add(knob, numbered(change, values), false);
  }

  /// A knob that makes another sample (the number of grains): errors are those of one sample to the mean of the
  /// references' answers over all repetitions, and the rows stay off the front.
  template <std::invocable<Settings&, double> Change>
  void vary_sample(std::string const& knob, Change change, std::vector<double> const& values) {
    add(knob, numbered(change, values), true);
  }

  /// A list of types: measure(Policy{}, settings) or measure(Policy{}, settings, repetition) for each, at the base
  /// setting.
  template <class... Policies, class Measure>
  void vary_over(std::string const& knob, std::vector<std::string> const& names, Measure measure) {
    if (names.size() != sizeof...(Policies)) {
      refuse("knob '{}' has {} names for {} policies (each needs one): mend the list", knob, names.size(),
             sizeof...(Policies));
    }
    std::size_t k = 0;
    (add_policy<Policies>(knob, names[k++], measure), ...);
  }

  /// One setting that differs from the base in whatever it likes.
  void also(std::string const& name, Settings const& settings) {
    runs_.push_back({.knob = std::string(combined), .setting = name, .measure = with(settings)});
  }

  /// All pairs of values of two knobs that were varied before.
  /// \throws InputError for a knob that was not
  void combine(std::string const& first, std::string const& second) {
    for (auto const& a : choices_of(first)) {
      for (auto const& b : choices_of(second)) {
        Settings settings = base_;
        a.change(settings);
        b.change(settings);
        also(fmt::format("{} {}, {} {}", first, a.setting, second, b.setting), settings);
      }
    }
  }

  /// \throws InputError without a reference, or for answers that cannot be compared
  SweepTable run(int repetitions = 1) const {
    if (!reference_) refuse("sweep '{}' has no reference (errors need one): call reference or exact", name_);
    if (repetitions < 1) refuse("sweep '{}' is to run {} times (once at least): ask for more", name_, repetitions);
    SweepEvaluation evaluation(name_, runs_, samples_, exact_);
    for (int k = 0; k < repetitions; ++k) {
      if (k == 0 || samples_) evaluation.reference(timed(reference_, k, 0.0));
    }
    for (int k = 0; k < repetitions; ++k) {
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        if (r % runs_per_baseline == 0) evaluation.baseline(timed(runs_.front().measure, k, least_seconds));
        evaluation.add(r, timed(runs_[r].measure, k, least_seconds));
      }
      if (runs_.size() > 1) evaluation.baseline(timed(runs_.front().measure, k, least_seconds));
    }
    return evaluation.table();
  }

 private:
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  struct Choice {
    std::string setting;
    double value;
    std::function<void(Settings&)> change;
  };

  template <class Measure, class... First>
  static Measured call(Measure const& measure, First const&... first, Settings const& settings, int repetition) {
    if constexpr (std::is_invocable_v<Measure const&, First const&..., Settings const&, int>) {
      return measure(first..., settings, repetition);
    } else {
      return measure(first..., settings);
    }
  }

  std::function<Measured(int)> with(Settings const& settings) const {
    return [measure = measure_, settings](int repetition) { return measure(settings, repetition); };
  }

  /// Without the last digits, which round-off makes.
  template <class Value>
  static std::string in_words(Value const& value) {
    if constexpr (std::is_floating_point_v<Value>)
      return fmt::format("{:.8g}", value);
    else
      return fmt::format("{}", value);
  }

  template <class Change>
  static std::vector<Choice> numbered(Change change, std::vector<double> const& values) {
    std::vector<Choice> choices;
    for (double const value : values) {
      choices.push_back({in_words(value), value, [=](Settings& settings) { change(settings, value); }});
    }
    return choices;
  }

  void add(std::string const& knob, std::vector<Choice> choices, bool new_sample) {
    for (auto const& choice : choices) {
      Settings settings = base_;
      choice.change(settings);
      runs_.push_back({knob, choice.setting, choice.value, new_sample, with(settings)});
    }
    knobs_.emplace_back(knob, std::move(choices));
  }

  template <class Policy, class Measure>
  void add_policy(std::string const& knob, std::string const& setting, Measure const& measure) {
    runs_.push_back({.knob = knob, .setting = setting, .measure = [measure, base = base_](int repetition) {
                       return call<Measure, Policy>(measure, Policy{}, base, repetition);
                     }});
  }

  std::vector<Choice> const& choices_of(std::string const& knob) const {
    for (auto const& [name, choices] : knobs_) {
      if (name == knob) return choices;
    }
    refuse("sweep '{}' has no knob '{}' with values (combined are knobs that were varied before): vary it first", name_,
           knob);
  }

  std::string name_;
  Settings base_;
  bool samples_;
  bool exact_ = false;
  std::function<Measured(Settings const&, int)> measure_;
  std::function<Measured(int)> reference_;
  std::vector<SweepRun> runs_;
  std::vector<std::pair<std::string, std::vector<Choice>>> knobs_;
};

}  // namespace scarp
