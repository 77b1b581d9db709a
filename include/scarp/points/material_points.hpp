// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/points/detail/shared_values.hpp"
#include "scarp/points/point_states.hpp"
#include "scarp/points/point_survey.hpp"

namespace scarp {

/// A batch of material points of one or several providers: parameters, committed and trial states, plans, and means over neighbours
/// where a region has them. The material side of `Problem`, and of any program that has points of its own:
/// \code
/// MaterialPoints<2> points(soil, sites);
/// points.gradient(0) = increment;             // of all points, since the last commit
/// ResponseReport const report = points.respond(executor);
/// if (report.verdict.acceptable()) points.commit();  // else: another increment, smaller perhaps
/// \endcode
/// Gradients are those of the displacement since the last commit by the positions at that time. Where points are shared out among
/// processes (see Executor), each evaluates its own and all know all responses.
template <int Dim>
class SCARP_EXPORT MaterialPoints : public PointStates<Dim> {
  using States = PointStates<Dim>;
  using States::batch, States::existing, States::local;
  using States::batches_, States::has_trial_, States::is_planned_, States::means_, States::owned_;

 public:
  using Gradients = std::vector<Gradient<Dim>>;  ///< one for each point
  using Responses = std::vector<Response<Dim>>;  ///< one for each point
  using States::size, States::work;
  using typename States::Stresses, typename States::Tangents;

  using States::States;

  /// Displacement gradient of a point since the last commit, for `respond`; to be set anew after each commit.
  Gradient<Dim>& gradient(int point) { return own_[detail::index(existing(point))]; }

  /// Responses to the gradients of all points: DEM steps are planned at the first response after a commit, and anew for gradients that
  /// need half as many again; points that do not converge take more, at most max_refinements times, and keep them until the next commit.
  /// \throws InputError for gradients that are not finite
  ResponseReport respond(Executor const& executor, int max_refinements = 8) {
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

  /// Sets all points' own gradients, and what the points see of them.
  void set_gradients(Gradients own, Executor const& executor) {
    if (std::ssize(own) != size())
      reject("{} displacement gradients are given for {} points: give one to each", own.size(), size());
    own_ = std::move(own);
    seen_ = means_ ? means_->average(own_, executor) : own_;
  }

  /// Fixes every point's number of inner steps from its mean gradient, so that responses are smooth functions of gradients until the next plan.
  void plan() {
    for (int const point : owned_) batch(point).plan(local(point), seen_[detail::index(point)]);
    is_planned_ = true;
  }

  /// All points respond from their committed states to what they see, with the work that is planned, or more where that is far too little.
  ResponseReport evaluate(Executor const& executor) { return evaluate(owned_, executor); }

  /// Points whose last response is not converged take more inner steps, now and until the next plan; one that cannot would only repeat its response.
  ResponseReport refine(Executor const& executor) {
    std::vector<int> unconverged;
    for (int const point : owned_) {
      if (responses_[detail::index(point)].verdict.status == Status::not_converged && batch(point).refine(local(point)))
        unconverged.push_back(point);
    }
    return evaluate(unconverged, executor);
  }

  /// The committed stresses as responses: no point has moved.
  void evaluate_committed(Executor const& executor) {
    auto const committed = committed_stresses(executor);
    for (std::size_t k = 0; k < committed.size(); ++k) responses_[k] = {committed[k], {}};
    set_gradients(Gradients(committed.size(), Gradient<Dim>::Zero()), executor);
  }

  /// Leaves the committed states as they are; the next response plans its work anew, as it should for a smaller step.
  void discard() { is_planned_ = has_trial_ = false; }

  /// The trial states, of the last responses, become the committed ones.
  /// \throws InputError where there is no response since the last commit or discard
  void commit() {
    if (!has_trial_) reject("a commit without a response since the last one (nothing would be kept): respond first");
    if (means_) means_->commit();
    for (auto& one : batches_) one->commit();
    is_planned_ = has_trial_ = false;
  }

  /// Gradients of the points' own displacements, before means.
  Gradients const& own_gradients() const { return own_; }
  /// What the points see: means where there are some.
  Gradients const& gradients() const { return seen_; }
  /// The materials' last responses, without the stabilising stress of means.
  Responses const& responses() const { return responses_; }
  /// Cauchy stress [Pa] of a point's last response, with the stabilising stress of means.
  VoigtStress<Dim> stress(int point) const {
    auto const k = detail::index(existing(point));
    return means_ ? VoigtStress<Dim>(responses_[k].stress + means_->added_stresses()[k]) : responses_[k].stress;
  }
  /// Cauchy stresses [Pa] of the last responses, with the stabilising stress of means.
  Stresses stresses() const {
    Stresses values(detail::index(size()));
    for (int point = 0; point < size(); ++point) values[detail::index(point)] = stress(point);
    return values;
  }
  /// Cauchy stresses [Pa] of all points' committed states, without the stabilising stress of means.
  Stresses committed_stresses(Executor const& executor) const {
    Stresses values(detail::index(size()));
    for (int const point : owned_) values[detail::index(point)] = this->committed_stress(point);
    executor.share(values);
    return values;
  }
  /// Committed stresses with the committed stabilising stress: those that balance the loads.
  Stresses balanced_stresses(Executor const& executor) const {
    Stresses values = committed_stresses(executor);
    if (!means_) return values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += means_->committed_tau(static_cast<int>(k));
    return values;
  }
  /// Tangent [Pa] of a point's trial state.
  VoigtTangent<Dim> tangent(int point) const { return batch(point).trial_tangent(local(point)); }
  /// Tangents [Pa] of all points' committed states for engineering strain.
  Tangents committed_tangents(Executor const& executor) const {
    return all_tangents(executor, [&](int point) { return this->committed_tangent(point); });
  }
  /// Tangents [Pa] of all points' trial states for engineering strain.
  Tangents tangents(Executor const& executor) const {
    return all_tangents(executor, [&](int point) { return tangent(point); });
  }
  /// Right after a commit: the committed response once more from its initial state, with twice the inner steps.
  DoubledResponse<Dim> doubled_response(int point) const {
    return batch(point).doubled_response(local(point), seen_[detail::index(point)]);
  }
  /// Right after a commit: takes a copy of the point's state, in bits, through the committed increment with twice the work; without
  /// bits it begins with the committed state and has no response. Of states that name no members bits stay empty.
  DoubledResponse<Dim> doubled_path(int point, std::string& bits) const {
    return batch(point).doubled_path(local(point), seen_[detail::index(point)], bits);
  }

 private:
  /// selected: points of this process
  ResponseReport evaluate(std::vector<int> selected, Executor const& executor) {
    // The longest responses first: one that begins last would keep the other threads waiting.
    std::ranges::stable_sort(selected, std::ranges::greater{}, [&](int point) { return work(point); });
    std::vector<int> own;
    for (int const point : selected) own.push_back(local(point));
    // Points that work are tasks of their own, others of one batch go together.
    constexpr int max_together = 64;
    std::vector<int> first{0};
    for (int k = 1; k < std::ssize(selected); ++k) {
      int const point = selected[detail::index(k)];
      if (work(point) > 0 || k - first.back() == max_together ||
          &batch(point) != &batch(selected[detail::index(k - 1)]))
        first.push_back(k);
    }
    if (!selected.empty()) first.push_back(detail::count(selected));
    has_trial_ = false;  // until all have responded: one may throw
    executor.together([&] {
      executor.for_each(detail::count(first) - 1, [&](int task) {
        auto const from = detail::index(first[detail::index(task)]);
        auto const count = detail::index(first[detail::index(task + 1)]) - from;
        batch(selected[from]).respond(std::span(own).subspan(from, count), seen_, responses_);
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

  template <class TangentOf>
  Tangents all_tangents(Executor const& executor, TangentOf const& tangent_of) const {
    Tangents values(detail::index(size()));
    executor.together([&] {
      executor.for_each(detail::count(owned_), [&](int task) {
        int const point = owned_[detail::index(task)];
        values[detail::index(point)] = tangent_of(point);
      });
    });
    executor.share(values);
    return values;
  }

  Gradients own_ = Gradients(detail::index(size()), Gradient<Dim>::Zero());
  Gradients seen_ = own_;
  Responses responses_ = Responses(detail::index(size()));
  std::vector<long> works_ = std::vector<long>(detail::index(size()));  ///< inner steps of the points' last responses
};

#ifdef SCARP_PRECOMPILED
extern template class PointStates<2>;
extern template class PointStates<3>;
extern template class MaterialPoints<2>;
extern template class MaterialPoints<3>;
#endif

}  // namespace scarp
