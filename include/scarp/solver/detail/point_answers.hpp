// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "scarp/constitutive/material_field.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/solver/executor.hpp"
#include "scarp/solver/step_report.hpp"

namespace scarp {

/// The material points of a problem: the gradients that they see, their answers, and who computes these. Where points are
/// shared out among processes, each asks its own and all know all answers.
template <MaterialField Materials, class Executor>
class SCARP_EXPORT PointAnswers {
 public:
  static constexpr int dim = Materials::dim;
  static constexpr bool averages = AveragesGradients<Materials>;
  using Gradients = std::vector<Gradient<dim>>;
  using Stresses = std::vector<VoigtStress<dim>>;
  using Tangents = std::vector<VoigtTangent<dim>>;
  using Strains = std::vector<EngineeringStrain<dim>>;

  PointAnswers(Materials materials, Executor& executor)
      : materials_(std::move(materials)),
        executor_(executor),
        gradients_(count()),
        responses_(count()),
        works_(count()) {
    for (int point = 0; point < materials_.point_count(); ++point) {
      if (owns_point(executor_, point)) owned_.push_back(point);
    }
  }

  Materials const& materials() const { return materials_; }
  Materials& materials() { return materials_; }
  Executor& executor() const { return executor_; }
  Gradients const& gradients() const { return gradients_; }
  std::vector<Response<dim>> const& responses() const { return responses_; }

  /// What the points see from now on, from their own displacement gradients.
  void see(Gradients gradients) {
    gradients_ = std::move(gradients);
    if constexpr (averages) materials_.average(gradients_, executor_);
  }

  /// What the elements have shown them.
  Gradients const& own_gradients() const {
    if constexpr (averages) {
      return materials_.own_gradients();
    } else {
      return gradients_;
    }
  }

  /// What the points see of their own strains, as a function that refers to this object; none where that is the same.
  std::function<Strains(Strains const&)> means() const {
    if constexpr (averages) {
      if (!materials_.mean().is_local())
        return [this](Strains const& strains) { return materials_.mean().means(strains, executor_); };
    }
    return {};
  }

  /// Fixes every point's work from what it sees.
  void plan() {
    for (int const point : owned_) materials_.plan(point, gradients_[detail::index(point)]);
  }

  /// All points respond from their committed states to what they see.
  void respond(Evaluation& evaluation) { ask(owned_, evaluation); }

  /// Points whose last answer is not converged work harder, now and for the rest of the load step.
  void refine(Evaluation& evaluation) { ask(refined(), evaluation); }

  /// The committed stresses take the place of answers.
  void take_committed() {
    auto const committed = committed_stresses();
    for (std::size_t k = 0; k < count(); ++k) responses_[k] = {committed[k], {}};
    see(Gradients(count(), Gradient<dim>::Zero()));
  }

  /// Of the last answers, with what a mean's field adds.
  Stresses stresses() const {
    Stresses values(count());
    for (std::size_t k = 0; k < count(); ++k) values[k] = responses_[k].stress;
    return with_added(std::move(values));
  }
  /// The same of the states that have been committed last.
  Stresses balanced_stresses() const { return with_added(committed_stresses()); }

  Stresses committed_stresses() const {
    Stresses values(count());
    for (int const point : owned_) values[detail::index(point)] = materials_.committed_stress(point);
    share(values);
    return values;
  }

  Tangents committed_tangents() const {
    return all_tangents([&](int point) { return materials_.committed_tangent(point); });
  }

  /// Of the trial states, which belong to the last answers.
  Tangents trial_tangents() const {
    return all_tangents([&](int point) { return materials_.trial_tangent(point); });
  }

 private:
  Stresses with_added(Stresses values) const {
    if constexpr (averages) {
      if (materials_.mean().is_local()) return values;
      for (std::size_t k = 0; k < count(); ++k) values[k] += materials_.added_stresses()[k];
    }
    return values;
  }

  std::size_t count() const { return detail::index(materials_.point_count()); }

  /// The tasks of this process.
  template <class Task>
  void for_each(int count, Task const& task) const {
    together(executor_, [&] { executor_.for_each(count, task); });
  }

  /// Completes an array over all points by what other processes know.
  template <class Value>
  void share(std::vector<Value>& values) const {
    if constexpr (SharesPoints<Executor>) executor_.share(values);
  }

  /// Points of this process that have not converged and now have a plan of more work: one that cannot work harder would only
  /// repeat its answer.
  std::vector<int> refined() {
    std::vector<int> harder;
    for (int const point : owned_) {
      if (responses_[detail::index(point)].verdict.status != Status::not_converged) continue;
      long const before = materials_.work(point);
      materials_.refine_plan(point);
      if (materials_.work(point) != before) harder.push_back(point);
    }
    return harder;
  }

  /// selected: points of this process
  void ask(std::vector<int> const& selected, Evaluation& evaluation) {
    constexpr long not_asked = -1;
    std::vector<long> worked(count(), not_asked);
    // The longest answers first: one that begins last would keep the other threads waiting.
    std::vector<int> order = selected;
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](int point) { return materials_.work(point); });
    for_each(detail::count(order), [&](int task) {
      int const point = order[detail::index(task)];
      auto const k = detail::index(point);
      responses_[k] = materials_.respond(point, gradients_[k]);
      // Prescribed nodes would hide a NaN from the residual of the free ones.
      if (!responses_[k].stress.allFinite()) responses_[k].verdict = {Status::failed, Reason::not_finite};
      worked[k] = materials_.work(point);
    });
    share(responses_);
    share(worked);
    for (int point = 0; point < materials_.point_count(); ++point) {
      auto const k = detail::index(point);
      if (worked[k] != not_asked) {
        works_[k] = worked[k];
        evaluation.inner_steps += worked[k];
      }
      Verdict const verdict = responses_[k].verdict;
      evaluation.points.add(point, verdict.status, works_[k]);
      if (!verdict.acceptable() && (evaluation.worst_point < 0 || verdict.status > evaluation.verdict.status)) {
        evaluation.verdict = verdict;
        evaluation.worst_point = point;
      }
    }
  }

  template <class TangentOf>
  Tangents all_tangents(TangentOf const& tangent_of) const {
    Tangents values(count());
    for_each(detail::count(owned_), [&](int task) {
      int const point = owned_[detail::index(task)];
      values[detail::index(point)] = tangent_of(point);
    });
    share(values);
    return values;
  }

  Materials materials_;
  Executor& executor_;
  Gradients gradients_;
  std::vector<Response<dim>> responses_;
  std::vector<long> works_;  ///< inner steps of the points' last answers
  std::vector<int> owned_;   ///< points of this process
};

}  // namespace scarp
