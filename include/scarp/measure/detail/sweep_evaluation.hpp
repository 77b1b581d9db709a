// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/measure/detail/sweep_table.hpp"
#include "scarp/measure/measured.hpp"

namespace scarp {

/// A setting and the function that runs it for a repetition.
struct SweepRun {
  std::string knob;
  std::string setting{};
  double value = std::numeric_limits<double>::quiet_NaN();
  bool new_sample = false;
  std::function<Measured(int)> measure{};
};

struct TimedRun {
  Measured measured;
  double seconds = 0.0;       ///< CPU time of one run
  std::size_t baselines = 0;  ///< how many runs of the base setting came before
};

/// Runs again until so much CPU time [s] is spent, and takes the mean. Answers of numbers that are none fail.
inline TimedRun timed(std::function<Measured(int)> const& measure, int repetition, double least_seconds) {
  TimedRun run;
  double sum = 0.0;
  constexpr int most = 1000;  // of runs shorter than the clock can tell
  for (int count = 1; count == 1 || (sum < least_seconds && count <= most); ++count) {
    CpuTime const clock;
    run.measured = measure(repetition);
    sum += std::isfinite(run.measured.seconds) ? run.measured.seconds : clock.seconds();
    run.seconds = sum / count;
    if (!run.measured.verdict.acceptable()) break;
  }
  if (run.measured.verdict.acceptable() && !run.measured.finite()) {
    run.measured.verdict = {Status::failed, Reason::not_finite};
  }
  return run;
}

inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Collects runs and makes the table of a sweep. Run 0 is the base setting.
class SweepEvaluation {
 public:
  /// samples: repetitions are different samples, each with a reference of its own; exact: the reference took no time
  SweepEvaluation(std::string name, std::vector<SweepRun> const& runs, bool samples, bool exact)
      : name_(std::move(name)), runs_(runs), results_(runs.size()), samples_(samples), exact_(exact) {}

  /// \throws InputError for a reference that failed, is zero, or has other answers than the one before
  void reference(TimedRun run) {
    auto const& verdict = run.measured.verdict;
    if (!verdict.acceptable()) {
      refuse("the reference of sweep '{}' ended with {} ({}): choose settings that can be answered", name_,
             scarp::name(verdict.status), scarp::name(verdict.reason));
    }
    for (auto const& [name, values] : run.measured.answers) {
      if (values.size() > 0 && values.norm() > 0.0) continue;
      refuse("answer '{}' of the reference of sweep '{}' is zero (errors are relative to it): leave it out", name,
             name_);
    }
    if (!references_.empty()) require_comparable("the reference", run.measured);
    references_.push_back(std::move(run));
  }

  /// The base setting again, before and after some runs: what their costs are relative to.
  /// \throws InputError for a base setting that failed
  void baseline(TimedRun const& run) {
    auto const& verdict = run.measured.verdict;
    if (!verdict.acceptable()) {
      refuse("the base setting of sweep '{}' ended with {} ({}; costs are relative to its time): choose one that works",
             name_, scarp::name(verdict.status), scarp::name(verdict.reason));
    }
    baselines_.push_back(run.seconds);
  }

  /// \throws InputError for answers other than the reference's
  void add(std::size_t run, TimedRun result) {
    if (result.measured.verdict.acceptable())
      require_comparable(fmt::format("'{}' {}", runs_[run].knob, runs_[run].setting), result.measured);
    result.baselines = baselines_.size();
    results_[run].push_back(std::move(result));
  }

  SweepTable table() const {
    SweepTable table{.name = name_, .repetitions = detail::count(results_.front())};
    for (auto const& [name, values] : references_.front().measured.answers) table.answers.push_back(name);
    if (!exact_) {
      std::vector<double> ratios;
      for (auto const& reference : references_) ratios.push_back(reference.seconds / median(baselines_));
      table.reference_cost = median(ratios);
    }
    table.cost_noise = cost_noise();
    for (std::size_t run = 0; run < runs_.size(); ++run) table.rows.push_back(row(run, table.answers.size()));
    for (std::size_t a = 0; a < table.answers.size(); ++a) {
      table.scatter.push_back(scatter(a));
      add_orders(table, a);
    }
    return table;
  }

 private:
  using Values = Eigen::VectorXd;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  Values const& reference_of(std::size_t repetition, std::size_t answer) const {
    return references_[samples_ && !exact_ ? repetition : 0].measured.answers[answer].second;
  }

  /// Median of how much the time of the base setting changes from one measurement to the next, as a share.
  double cost_noise() const {
    std::vector<double> changes;
    for (std::size_t k = 1; k < baselines_.size(); ++k) {
      changes.push_back(std::abs(std::log(baselines_[k] / baselines_[k - 1])));
    }
    return changes.empty() ? 0.0 : std::expm1(median(changes));
  }

  /// Mean of the base setting's time before and after a run.
  double baseline_of(TimedRun const& run) const {
    return 0.5 * (baselines_[run.baselines - 1] + baselines_[std::min(run.baselines, baselines_.size() - 1)]);
  }

  void require_comparable(std::string const& run, Measured const& measured) const {
    auto const& wanted = references_.front().measured.answers;
    bool fits = measured.answers.size() == wanted.size();
    for (std::size_t a = 0; fits && a < wanted.size(); ++a) {
      fits =
          measured.answers[a].first == wanted[a].first && measured.answers[a].second.size() == wanted[a].second.size();
    }
    if (fits) return;
    refuse(
        "{} of sweep '{}' gives answers of other names or lengths than the reference (they cannot be compared): "
        "answer at the same places in all runs",
        run, name_);
  }

  /// Mean of the references' answers, over all samples.
  Values mean_reference(std::size_t answer) const {
    Values sum = Values::Zero(reference_of(0, answer).size());
    for (auto const& reference : references_) sum += reference.measured.answers[answer].second;
    return sum / static_cast<double>(references_.size());
  }

  double error(std::size_t run, std::size_t answer) const {
    double squares = 0.0;
    for (std::size_t k = 0; k < results_[run].size(); ++k) {
      Values const wanted = runs_[run].new_sample ? mean_reference(answer) : reference_of(k, answer);
      squares += (results_[run][k].measured.answers[answer].second - wanted).squaredNorm() / wanted.squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(results_[run].size()));
  }

  SweepRow row(std::size_t run, std::size_t answers) const {
    SweepRow row{.knob = runs_[run].knob,
                 .setting = runs_[run].setting,
                 .value = runs_[run].value,
                 .new_sample = runs_[run].new_sample};
    std::vector<double> seconds;
    std::vector<double> ratios;
    for (std::size_t k = 0; k < results_[run].size(); ++k) {
      auto const& result = results_[run][k];
      seconds.push_back(result.seconds);
      ratios.push_back(result.seconds / baseline_of(result));
      row.inner_steps += static_cast<double>(result.measured.inner_steps) / static_cast<double>(results_[run].size());
      if (row.verdict.acceptable() && !result.measured.verdict.acceptable()) row.verdict = result.measured.verdict;
    }
    row.seconds = median(seconds);
    row.cost = run == 0 ? 1.0 : median(ratios);
    for (std::size_t a = 0; a < answers; ++a) {
      row.errors.push_back(row.verdict.acceptable() ? error(run, a) : not_a_number);
    }
    return row;
  }

  double scatter(std::size_t answer) const {
    auto const& base = results_.front();
    if (!samples_ || base.size() < 2) return not_a_number;
    Values mean = Values::Zero(reference_of(0, answer).size());
    for (auto const& result : base) {
      if (!result.measured.verdict.acceptable()) return not_a_number;
      mean += result.measured.answers[answer].second / static_cast<double>(base.size());
    }
    double squares = 0.0;
    for (auto const& result : base) squares += (result.measured.answers[answer].second - mean).squaredNorm();
    return std::sqrt(squares / static_cast<double>(base.size() - 1)) / mean.norm();
  }

  /// Root mean square over the repetitions of the distance between two runs' answers, relative to the reference.
  double difference(std::size_t run, std::size_t other, std::size_t answer) const {
    double squares = 0.0;
    for (std::size_t k = 0; k < results_[run].size(); ++k) {
      auto const& values = results_[run][k].measured.answers[answer].second;
      squares += (values - results_[other][k].measured.answers[answer].second).squaredNorm() /
                 reference_of(k, answer).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(results_[run].size()));
  }

  /// For every knob with three values at least, of runs that were answered.
  void add_orders(SweepTable& table, std::size_t answer) const {
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
      std::vector<double> differences;
      for (std::size_t k = 0; k < series.size(); ++k) {
        sizes.push_back(runs_[series[k]].value);
        errors.push_back(table.rows[series[k]].errors[answer]);
        if (k > 0) differences.push_back(difference(series[k - 1], series[k], answer));
      }
      bool const sampled = runs_[first].new_sample;
      table.orders.push_back({runs_[first].knob, table.answers[answer], order_of_errors(sizes, errors),
                              sampled ? ObservedOrder{} : order_of_differences(sizes, differences)});
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

}  // namespace scarp
