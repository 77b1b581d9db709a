// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "scarp/budget/budget_part.hpp"
#include "scarp/budget/point_checks.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/nan_max.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/solver/work_balance.hpp"

namespace scarp {

namespace detail {

/// For points without a mesh.
struct NoWorkBalance {
  template <class Problem>
  void attempted(Problem const&, StepReport const&) {}
  static double gap() { return 0.0; }
  template <class Self, class Visit>
  static void members(Self&, Visit&&) {}
};

}  // namespace detail

/// Observer that estimates the errors of a run from cheap checks on the way: balance of the packings, residuals, work,
/// responses with twice the work to single increments (samples) and along the whole paths of a few points. Differences
/// of stress are relative to a point's stress, now or when the budget was made, whichever is larger: soil that has lost
/// its pressure carries nothing that its error could be compared with. It changes nothing.
/// Where points are distributed over processes, those of the first are evaluated.
/// \code
/// ErrorBudget budget(problem, {.residual = 1e-3}, {.pressure_floor = 2e3});
/// ... run ...
/// fmt::print("{}{}", budget_headline(budget.parts()), budget_table(budget.parts()));
/// \endcode
/// \tparam Problem a `Problem`
template <class Problem>
class ErrorBudget : public NeverStops {
 public:
  static constexpr int dim = Problem::dim;  ///< of the problem's space

  /// Begins with the stresses that the points carry now.
  /// \throws InputError for points that the problem does not have, numbers that are negative or not finite
  explicit ErrorBudget(Problem const& problem, ErrorBounds const& bounds = {}, ErrorSampling const& sampling = {})
      : bounds_(bounds),
        sampling_(sampling),
        iterates_equations_(problem.points().means() != nullptr),
        has_field_(has_grid && problem.has_field()),
        adds_up_work_(has_grid && !problem.has_attachment() && !problem.has_field() &&
                      problem.executor().ranks() == 1) {
    bounds.validate();
    sampling.validate();
    int const points = problem.points().size();
    at_rest_.resize(detail::index(points));
    double const least = sampling.pressure_floor * std::sqrt(static_cast<double>(dim));
    for (int point = 0; point < points; ++point) {
      if (!problem.executor().owns(point)) continue;
      seen_.push_back(point);
      at_rest_[detail::index(point)] = std::max(stress_size<dim>(problem.points().committed_stress(point)), least);
    }
    tracked_ = TrackedPoints::choose(problem, seen_, sampling);
  }

  /// Counts the work of an attempt, and after an accepted one checks residual, work, packings, tracked points and
  /// samples.
  void attempted(Problem const& problem, StepReport const& report) {
    for (auto const& record : report.history) {
      work_ += record.inner_steps;
      linear_residual_ = nan_max(linear_residual_, record.linear_residual);
    }
    if (work_ == 0) answers_ += static_cast<long>(report.history.size()) * problem.points().size();
    condition_ = nan_max(condition_, report.condition);
    if (!report.verdict.acceptable()) return;
    if (has_field_) {
      look_at_field(problem, report);
    } else {
      residual_ = nan_max(residual_, report.residual());
    }
    if (adds_up_work_) balance_.attempted(problem, report);
    packings_.look(problem, seen_);
    auto const least = least_stresses(problem);
    tracked_.follow(problem, least);
    auto const affordable = static_cast<long>(sampling_.share * static_cast<double>(all_work()));
    samples_.sample(problem, seen_, least, sampling_, affordable - tracked_.work);
  }

  /// Results so far; parts without data are left out.
  BudgetParts parts() const {
    constexpr double none = std::numeric_limits<double>::infinity();
    BudgetParts parts;
    auto const add = [&](char const* name, double value, double bound, char const* meaning) {
      parts.push_back({name, value, bound, meaning});
    };
    add("residual", residual_, bounds_.residual,
        "largest force residual of an accepted step, over the forces that act");
    if (has_field_) {
      add("water", field_residual_, bounds_.water, "largest residual of the field, over what flows and strains");
      add("time", field_size_ > 0.0 ? time_error_ / field_size_ : 0.0, bounds_.time,
          "largest estimated error of the field in one time step, over its largest value");
    }
    bool const has_path = tracked_.steps != 1;  // the work and the second paths begin with the first accepted step
    if (adds_up_work_ && has_path)
      add("work_gap", balance_.gap(), bounds_.work_gap, "external against internal work of the run");
    add("linear_residual", linear_residual_,
        iterates_equations_ ? bounds_.iterated_linear_residual : bounds_.linear_residual, "largest of a linear system");
    add("condition", condition_, bounds_.condition, "largest estimate for a stiffness");
    if (packings_.looked_at > 0.0) {
      add("unbalanced_mean", packings_.mean_unbalanced(), bounds_.unbalanced_mean,
          "net force of a grain over contact force, mean of all packings and steps");
      add("unbalanced_largest", packings_.unbalanced, bounds_.unbalanced_largest, "of one packing");
      add("kinetic_share", packings_.kinetic_share, bounds_.kinetic_share, "of moving grains in the pressure, largest");
      add("inertial_number", packings_.inertial_number, bounds_.inertial_number, "largest of a response");
    }
    if (!samples_.spread.differences.empty()) {
      add("doubling_median", samples_.spread.quantile(0.5), bounds_.doubling_median,
          "change of a point's stress when one increment takes twice the work, relative");
      add("doubling_95", samples_.spread.quantile(0.95), bounds_.doubling_95, "for 19/20 of the stress of all points");
    }
    if (!samples_.strained.differences.empty()) {
      add("doubling_strained", samples_.strained.quantile(0.95), bounds_.doubling_strained,
          "of the most strained points");
      add("doubling_largest", nan_max(samples_.spread.largest(), samples_.strained.largest()), none, "of one sample");
    }
    if (tracked_.any() && has_path) {
      add("accumulated", tracked_.together(), bounds_.accumulated,
          "the same when all increments take it: what points have in common, root mean square over the steps");
      add("accumulated_apart", tracked_.apart(), none, "the same of single points");
      add("accumulated_largest", tracked_.farthest(), none, "of one tracked point at any time");
    }
    add("work_of_checks", share_of_checks(), none, "what the last ones took, over the points' work of the run");
    return parts;
  }

  DoubledSamples const& samples() const { return samples_; }  ///< repetitions of single increments so far
  TrackedPoints const& tracked() const { return tracked_; }   ///< repetitions of whole paths so far

  /// What evolves; the work only where it is added up, and of a field where there is one.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(bounds_, sampling_, iterates_equations_, has_field_, adds_up_work_, seen_, at_rest_, balance_,
                      packings_, samples_, tracked_, residual_, field_residual_, time_error_, field_size_,
                      linear_residual_, condition_, work_, answers_);
    if (self.adds_up_work_) visit("balance", self.balance_);
    visit("packings", self.packings_);
    visit("samples", self.samples_);
    visit("tracked", self.tracked_);
    visit("residual", self.residual_);
    if (self.has_field_) {
      visit("field_residual", self.field_residual_);
      visit("time_error", self.time_error_);
      visit("field_size", self.field_size_);
    }
    visit("linear_residual", self.linear_residual_);
    visit("condition", self.condition_);
    visit("work", self.work_);
    visit("answers", self.answers_);
  }

 private:
  static constexpr bool has_grid = requires(Problem const& problem) { problem.grid(); };

  /// [Pa], that each point's stress counts as large as: what it was when the run began, and a round-off share of the
  /// largest one now, since a point that carries nothing differs by round-off as much as by an error.
  std::vector<double> least_stresses(Problem const& problem) const {
    constexpr double round_off = 1e-9;
    double largest = 0.0;
    for (int const point : seen_)
      largest = std::max(largest, stress_size<Problem::dim>(problem.points().committed_stress(point)));
    auto least = at_rest_;
    for (double& one : least) one = std::max(one, round_off * largest);
    return least;
  }

  /// The field is the last of the parts.
  void look_at_field(Problem const& problem, StepReport const& report) {
    if constexpr (has_grid) {
      for (std::size_t part = 0; part + 1 < report.parts.size(); ++part)
        residual_ = nan_max(residual_, report.parts[part].value);
      field_residual_ = nan_max(field_residual_, report.parts.back().value);
      auto const error = problem.field()->time_error();
      time_error_ = nan_max(time_error_, error.estimate);
      field_size_ = nan_max(field_size_, error.size);
    }
  }

  long all_work() const { return work_ > 0 ? work_ : answers_; }

  double share_of_checks() const {
    long const checks = samples_.work + tracked_.work;
    return checks == 0 ? 0.0 : static_cast<double>(checks) / static_cast<double>(all_work());
  }

  ErrorBounds bounds_;
  ErrorSampling sampling_;
  bool iterates_equations_;  ///< where points see means: linear systems are not factorised
  bool has_field_;
  bool adds_up_work_;            ///< not of what is attached, nor of points of other processes
  std::vector<int> seen_;        ///< points of this process
  std::vector<double> at_rest_;  ///< [Pa], size of each point's stress when the run began
  std::conditional_t<has_grid, WorkBalance<Problem>, detail::NoWorkBalance> balance_;
  PackingSurvey packings_;
  DoubledSamples samples_;
  TrackedPoints tracked_;
  double residual_ = 0.0;  ///< of all but a field
  double field_residual_ = 0.0;
  double time_error_ = 0.0;  ///< largest of a step, in the unit of the field
  double field_size_ = 0.0;  ///< largest value of the field in any step
  double linear_residual_ = 0.0;
  double condition_ = 0.0;
  long work_ = 0;     ///< of all attempts
  long answers_ = 0;  ///< of points that count no work
};

template <class Problem>
ErrorBudget(Problem const&, ErrorBounds const&, ErrorSampling const&) -> ErrorBudget<Problem>;

}  // namespace scarp
