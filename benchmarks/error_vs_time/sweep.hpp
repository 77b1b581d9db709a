// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <type_traits>

#include "scarp/run/resources.hpp"
#include "sweep_table.hpp"

namespace error_vs_time {

struct TimedRun {
  Measured measured;
  double seconds = 0.0;       ///< CPU time of one run
  std::size_t baselines = 0;  ///< runs of the base setting before it
};

/// A setting and the function that runs it for a repetition.
struct SweepRun {
  std::string knob;
  std::string setting{};
  double value = not_a_number;
  bool new_sample = false;
  std::function<Measured(int)> measure{};
};

inline double median(std::vector<double> values) {
  if (values.empty()) return not_a_number;
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Collects runs and makes the table of a sweep. Run 0 is the base setting.
class SweepEvaluation {
 public:
  /// samples: repetitions are different samples, each with a reference of its own; exact: the reference took no time
  SweepEvaluation(std::string name, std::vector<SweepRun> const& runs, bool samples, bool exact)
      : name_(std::move(name)), runs_(runs), results_(runs.size()), samples_(samples), exact_(exact) {}

  /// \throws InputError for a reference that failed, is zero, or has other responses than the one before
  void reference(TimedRun run) {
    require_acceptable("reference", run.measured.verdict);
    for (auto const& [name, values] : run.measured.responses) {
      if (values.size() > 0 && values.norm() > 0.0) continue;
      scarp::reject("response '{}' of the reference of sweep '{}' is zero (errors are relative to it): leave it out",
                    name, name_);
    }
    if (!references_.empty()) require_comparable("the reference", run.measured);
    references_.push_back(std::move(run));
  }

  /// The base setting again, before and after some runs: their costs are relative to it.
  /// \throws InputError for a base setting that failed
  void baseline(TimedRun const& run) {
    require_acceptable("base setting", run.measured.verdict);
    baselines_.push_back(run.seconds);
  }

  /// \throws InputError for responses other than the reference's
  void add(std::size_t run, TimedRun result) {
    if (result.measured.verdict.acceptable())
      require_comparable(fmt::format("'{}' {}", runs_[run].knob, runs_[run].setting), result.measured);
    result.baselines = baselines_.size();
    results_[run].push_back(std::move(result));
  }

  SweepTable table() const {
    SweepTable table{.name = name_, .repetitions = static_cast<int>(results_.front().size())};
    for (auto const& [name, values] : references_.front().measured.responses) table.responses.push_back(name);
    if (!exact_) {
      std::vector<double> ratios;
      for (auto const& reference : references_) ratios.push_back(reference.seconds / median(baselines_));
      table.reference_cost = median(ratios);
    }
    table.cost_noise = cost_noise();
    for (std::size_t run = 0; run < runs_.size(); ++run) table.rows.push_back(row(run, table.responses.size()));
    for (std::size_t a = 0; a < table.responses.size(); ++a) {
      table.scatter.push_back(scatter(a));
      add_orders(table, a);
    }
    return table;
  }

 private:
  using Values = Eigen::VectorXd;

  void require_acceptable(char const* what, scarp::Verdict const& verdict) const {
    if (verdict.acceptable()) return;
    scarp::reject("the {} of sweep '{}' ended with {} ({}): choose settings that work", what, name_,
                  scarp::name(verdict.status), scarp::name(verdict.reason));
  }

  void require_comparable(std::string const& run, Measured const& measured) const {
    auto const& wanted = references_.front().measured.responses;
    bool const fits = std::equal(
        wanted.begin(), wanted.end(), measured.responses.begin(), measured.responses.end(),
        [](auto const& a, auto const& b) { return a.first == b.first && a.second.size() == b.second.size(); });
    if (fits) return;
    scarp::reject(
        "{} of sweep '{}' gives responses of other names or lengths than the reference (they cannot be compared): "
        "measure at the same places in all runs",
        run, name_);
  }

  Values const& reference_of(std::size_t repetition, std::size_t response) const {
    return references_[samples_ && !exact_ ? repetition : 0].measured.responses[response].second;
  }
  Values const& values_of(std::size_t run, std::size_t repetition, std::size_t response) const {
    return results_[run][repetition].measured.responses[response].second;
  }

  /// Median of how much the time of the base setting changes from one measurement to the next, as a share.
  double cost_noise() const {
    std::vector<double> changes;
    for (std::size_t k = 1; k < baselines_.size(); ++k)
      changes.push_back(std::abs(std::log(baselines_[k] / baselines_[k - 1])));
    return changes.empty() ? 0.0 : std::expm1(median(changes));
  }

  /// Mean of the base setting's time before and after a run.
  double baseline_of(TimedRun const& run) const {
    return 0.5 * (baselines_[run.baselines - 1] + baselines_[std::min(run.baselines, baselines_.size() - 1)]);
  }

  double error(std::size_t run, std::size_t response) const {
    double squares = 0.0;
    for (std::size_t k = 0; k < results_[run].size(); ++k) {
      Values wanted = reference_of(k, response);
      if (runs_[run].new_sample) {  // the mean over all samples
        wanted.setZero();
        for (auto const& each : references_)
          wanted += each.measured.responses[response].second / static_cast<double>(references_.size());
      }
      squares += (values_of(run, k, response) - wanted).squaredNorm() / wanted.squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(results_[run].size()));
  }

  SweepRow row(std::size_t run, std::size_t responses) const {
    SweepRow row{.knob = runs_[run].knob,
                 .setting = runs_[run].setting,
                 .value = runs_[run].value,
                 .new_sample = runs_[run].new_sample};
    std::vector<double> seconds;
    std::vector<double> ratios;
    for (auto const& result : results_[run]) {
      seconds.push_back(result.seconds);
      ratios.push_back(result.seconds / baseline_of(result));
      row.inner_steps += static_cast<double>(result.measured.inner_steps) / static_cast<double>(results_[run].size());
      if (row.verdict.acceptable()) row.verdict = result.measured.verdict;
    }
    row.seconds = median(seconds);
    row.cost = run == 0 ? 1.0 : median(ratios);
    for (std::size_t a = 0; a < responses; ++a)
      row.errors.push_back(row.verdict.acceptable() ? error(run, a) : not_a_number);
    row.orders.assign(responses, not_a_number);
    return row;
  }

  double scatter(std::size_t response) const {
    auto const& base = results_.front();
    if (!samples_ || base.size() < 2) return not_a_number;
    Values mean = Values::Zero(reference_of(0, response).size());
    for (std::size_t k = 0; k < base.size(); ++k) {
      if (!base[k].measured.verdict.acceptable()) return not_a_number;
      mean += values_of(0, k, response) / static_cast<double>(base.size());
    }
    double squares = 0.0;
    for (std::size_t k = 0; k < base.size(); ++k) squares += (values_of(0, k, response) - mean).squaredNorm();
    return std::sqrt(squares / static_cast<double>(base.size() - 1)) / mean.norm();
  }

  /// For every knob with three values at least, of runs that are acceptable.
  void add_orders(SweepTable& table, std::size_t response) const {
    for (std::size_t first = 0; first < runs_.size(); ++first) {
      if (first > 0 && runs_[first - 1].knob == runs_[first].knob) continue;
      std::vector<std::size_t> series;
      for (std::size_t k = first; k < runs_.size() && runs_[k].knob == runs_[first].knob; ++k) {
        if (std::isfinite(runs_[k].value) && table.rows[k].verdict.acceptable()) series.push_back(k);
      }
      if (series.size() < 3) continue;
      std::sort(series.begin(), series.end(), [&](auto a, auto b) { return runs_[a].value > runs_[b].value; });
      std::vector<double> sizes;
      std::vector<double> errors;
      for (std::size_t const k : series) {
        sizes.push_back(runs_[k].value);
        errors.push_back(table.rows[k].errors[response]);
      }
      double const order = order_of_errors(sizes, errors).value();
      for (std::size_t const k : series) table.rows[k].orders[response] = order;
    }
  }

  std::string name_;
  std::vector<SweepRun> const& runs_;
  std::vector<TimedRun> references_;
  std::vector<double> baselines_;  ///< CPU times of the base setting, in the order of the runs [s]
  std::vector<std::vector<TimedRun>> results_;
  bool samples_;
  bool exact_;
};

/// Error and CPU time of a scene over its settings: one knob at a time away from a base setting, combinations beside.
///
///     Sweep sweep("column", Settings{}, measure);
///     sweep.reference(Settings{.cells = 512});
///     sweep.vary("cells", &Settings::cells, {4, 8, 16, 32});
///     auto const table = sweep.run(3);
///
/// Settings is the user's aggregate; measure(settings), or measure(settings, repetition) where the repetition chooses
/// the sample (the seed). The base setting is measured again between the runs: costs are ratios to it at about the same
/// time, whatever else the machine does.
template <class Settings>
class Sweep {
 public:
  double min_seconds = 0.02;  ///< shorter runs are repeated until so much CPU time [s] is spent; the mean counts
  static constexpr std::size_t runs_per_baseline = 10;  ///< after so many the base setting is measured again

  template <class Measure>
  Sweep(std::string name, Settings base, Measure measure)
      : name_(std::move(name)),
        base_(std::move(base)),
        samples_(std::is_invocable_v<Measure const&, Settings const&, int>),
        measure_([measure = std::move(measure)](Settings const& settings, int repetition) {
          return call(measure, settings, repetition);
        }) {
    runs_.push_back({.knob = "base", .measure = with(base_)});
  }

  /// Settings whose response counts as exact; run once for every sample.
  void reference(Settings const& settings) { reference_ = with(settings); }
  /// The exact response.
  void exact(Measured response) {
    exact_ = true;
    reference_ = [response = std::move(response)](int) { return response; };
  }

  template <class Member>
  void vary(std::string const& knob, Member Settings::*member,
            std::vector<std::type_identity_t<Member>> const& values) {
    for (auto const& value : values) {
      double number = not_a_number;
      if constexpr (std::is_arithmetic_v<Member>) number = static_cast<double>(value);
      add(knob, in_words(value), number, false, [&](Settings& settings) { settings.*member = value; });
    }
  }

  /// change(settings, value)
  template <std::invocable<Settings&, double> Change>
  void vary(std::string const& knob, Change change, std::vector<double> const& values) {
    for (double const value : values)
      add(knob, in_words(value), value, false, [&](Settings& settings) { change(settings, value); });
  }

  /// A knob that makes another sample (the number of grains): errors are those of one sample to the mean of the
  /// references over all repetitions, and the rows stay off the front.
  template <std::invocable<Settings&, double> Change>
  void vary_sample(std::string const& knob, Change change, std::vector<double> const& values) {
    for (double const value : values)
      add(knob, in_words(value), value, true, [&](Settings& settings) { change(settings, value); });
  }

  /// A list of types: measure(Policy{}, settings) or measure(Policy{}, settings, repetition), at the base setting.
  template <class... Policies, class Measure>
  void vary_over(std::string const& knob, std::array<char const*, sizeof...(Policies)> const& names, Measure measure) {
    std::size_t k = 0;
    (runs_.push_back(
         {.knob = knob,
          .setting = names[k++],
          .measure = [measure, base = base_](
                         int repetition) { return call<Measure, Policies>(measure, Policies{}, base, repetition); }}),
     ...);
  }

  /// One setting that differs from the base in several knobs.
  void also(std::string const& name, Settings const& settings) {
    runs_.push_back({.knob = "combined", .setting = name, .measure = with(settings)});
  }

  /// \throws InputError without a reference, or for responses that cannot be compared
  SweepTable run(int repetitions = 1) const {
    if (!reference_) scarp::reject("sweep '{}' has no reference (errors need one): call reference or exact", name_);
    scarp::require_at_least("number of repetitions of a sweep", repetitions, 1);
    SweepEvaluation evaluation(name_, runs_, samples_, exact_);
    for (int k = 0; k < repetitions; ++k) {
      if (k == 0 || samples_) evaluation.reference(timed(reference_, k, 0.0));
    }
    for (int k = 0; k < repetitions; ++k) {
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        if (r % runs_per_baseline == 0) evaluation.baseline(timed(runs_.front().measure, k, min_seconds));
        evaluation.add(r, timed(runs_[r].measure, k, min_seconds));
      }
      if (runs_.size() > 1) evaluation.baseline(timed(runs_.front().measure, k, min_seconds));
    }
    return evaluation.table();
  }

 private:
  /// Runs again until so much CPU time [s] is spent, and takes the mean. Responses that are not finite fail.
  static TimedRun timed(std::function<Measured(int)> const& measure, int repetition, double min_seconds) {
    TimedRun run;
    double sum = 0.0;
    constexpr int most = 1000;  // of runs shorter than the clock can resolve
    for (int count = 1; count == 1 || (sum < min_seconds && count <= most); ++count) {
      scarp::CpuTime const clock;
      run.measured = measure(repetition);
      sum += std::isfinite(run.measured.seconds) ? run.measured.seconds : clock.seconds();
      run.seconds = sum / count;
      if (!run.measured.verdict.acceptable()) return run;
    }
    if (!run.measured.finite()) run.measured.verdict = {scarp::Status::failed, scarp::Reason::not_finite};
    return run;
  }

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
  void add(std::string const& knob, std::string const& setting, double value, bool new_sample, Change const& change) {
    Settings settings = base_;
    change(settings);
    runs_.push_back({knob, setting, value, new_sample, with(settings)});
  }

  std::string name_;
  Settings base_;
  bool samples_;
  bool exact_ = false;
  std::function<Measured(Settings const&, int)> measure_;
  std::function<Measured(int)> reference_;
  std::vector<SweepRun> runs_;
};

}  // namespace error_vs_time
