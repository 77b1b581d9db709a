// SPDX-License-Identifier: BSL-1.0
/// \file
/// How material points respond: in tasks of an executor, with a report.
#pragma once

#include "scarp/points/material_points.hpp"

namespace scarp {

template <int Dim>
ResponseReport MaterialPoints<Dim>::respond(Executor const& executor, int max_refinements) {
  for (int point = 0; point < size(); ++point) {
    if (!own_[detail::index(point)].allFinite())
      reject("the displacement gradient of point {} is not finite: take a smaller step", point);
  }
  set_gradients(own_, executor);
  if (!is_planned_) plan();
  ResponseReport report = evaluate(executor);
  for (int k = 0; k < max_refinements && report.verdict.status == Status::not_converged; ++k) {
    long const before = report.inner_steps;
    report = refine(executor);
    report.inner_steps += before;
  }
  return report;
}

template <int Dim>
void MaterialPoints<Dim>::set_gradients(Gradients own, Executor const& executor) {
  if (std::ssize(own) != size())
    reject("{} displacement gradients are given for {} points: give one to each", own.size(), size());
  own_ = std::move(own);
  has_trial_ = false;  // trial states belong to other gradients
  seen_ = means_ ? means_->average(own_, executor) : own_;
}

template <int Dim>
ResponseReport MaterialPoints<Dim>::refine(Executor const& executor) {
  if (!has_trial_)
    reject("points are refined without a response since the last commit or discard: let them respond first");
  std::vector<int> unconverged;
  for (int const point : owned_) {
    if (responses_[detail::index(point)].verdict.status == Status::not_converged && batch(point).refine(local(point)))
      unconverged.push_back(point);
  }
  return evaluate(unconverged, executor);
}

template <int Dim>
void MaterialPoints<Dim>::evaluate_committed(Executor const& executor) {
  auto const committed = committed_stresses(executor);
  for (std::size_t k = 0; k < committed.size(); ++k) responses_[k] = {committed[k], {}};
  set_gradients(Gradients(committed.size(), Gradient<Dim>::Zero()), executor);
}

template <int Dim>
ResponseReport MaterialPoints<Dim>::evaluate(std::vector<int> selected, Executor const& executor) {
  // The longest responses first: one that begins last would keep the other threads waiting.
  std::ranges::stable_sort(selected, std::ranges::greater{}, [&](int point) { return work(point); });
  // Points that work are tasks of their own, others of one batch go together, and so do all of a batch that takes many.
  constexpr std::size_t max_together = 64;
  std::vector<std::pair<detail::PointBatch<Dim>*, std::vector<int>>> tasks;
  for (auto& one : materials_) {
    if (one.batch_->takes_many()) tasks.push_back({one.batch_.get(), {}});
  }
  auto const many = tasks.size();
  for (int const point : selected) {
    auto* const of = &batch(point);
    auto const whole = std::ranges::find(tasks.begin(), tasks.begin() + static_cast<std::ptrdiff_t>(many), of,
                                         [](auto const& task) { return task.first; });
    if (whole != tasks.begin() + static_cast<std::ptrdiff_t>(many)) {
      whole->second.push_back(local(point));
      continue;
    }
    if (tasks.size() == many || work(point) > 0 || tasks.back().second.size() == max_together ||
        tasks.back().first != of)
      tasks.push_back({of, {}});
    tasks.back().second.push_back(local(point));
  }
  has_trial_ = false;  // until all have responded: one may throw
  executor.together([&] {
    executor.for_each(detail::count(tasks), [&](int k) {
      auto const& [of, points] = tasks[detail::index(k)];
      of->respond(points, seen_, responses_);
    });
  });
  constexpr long not_evaluated = -1;
  std::vector<long> worked(detail::index(size()), not_evaluated);
  for (int const point : selected) {
    auto& response = responses_[detail::index(point)];
    // Prescribed nodes would hide a NaN from the residual of the free ones.
    if (!response.stress.allFinite()) response.verdict = {Status::failed, Reason::not_finite};
    worked[detail::index(point)] = work(point);
  }
  executor.share(responses_);
  executor.share(worked);
  has_trial_ = true;
  ResponseReport report;
  for (int point = 0; point < size(); ++point) {
    auto const k = detail::index(point);
    if (worked[k] != not_evaluated) {
      works_[k] = worked[k];
      report.inner_steps += worked[k];
    }
    Verdict const verdict = responses_[k].verdict;
    report.points.add(point, verdict.status, works_[k]);
    if (!verdict.acceptable() && (report.worst_point < 0 || verdict.status > report.verdict.status)) {
      report.verdict = verdict;
      report.worst_point = point;
    }
  }
  return report;
}

template <int Dim>
auto MaterialPoints<Dim>::all_tangents(Executor const& executor,
                                       VoigtTangent<Dim> (MaterialPoints::*of)(int) const) const -> Tangents {
  Tangents values(detail::index(size()));
  executor.together([&] {
    executor.for_each(detail::count(owned_), [&](int task) {
      int const point = owned_[detail::index(task)];
      values[detail::index(point)] = (this->*of)(point);
    });
  });
  executor.share(values);
  return values;
}

}  // namespace scarp
