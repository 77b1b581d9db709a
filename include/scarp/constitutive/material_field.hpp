// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"

namespace scarp {

/// What a solver asks of the material side of a model, point by point; points are numbered as in the discretisation.
/// Calls for different points may run at the same time.
template <class Field>
concept MaterialField = requires {
  requires Field::dim == 2 || Field::dim == 3;
}
&&requires(Field& field, Field const& constant, int point, Gradient<Field::dim> const& increment) {
  { constant.point_count() } -> std::same_as<int>;
  {field.plan(point, increment)};
  {field.refine_plan(point)};
  { field.respond(point, increment) } -> std::same_as<Response<Field::dim>>;
  { constant.work(point) } -> std::same_as<long>;
  { constant.committed_stress(point) } -> std::same_as<VoigtStress<Field::dim>>;
  { constant.committed_tangent(point) } -> std::same_as<VoigtTangent<Field::dim>>;
  { constant.trial_tangent(point) } -> std::same_as<VoigtTangent<Field::dim>>;
  {field.commit()};
};

namespace detail {
/// Stands for any executor.
struct AnyExecutor {
  template <class Task>
  void for_each(int count, Task&& task) {
    for (int i = 0; i < count; ++i) task(i);
  }
};
}  // namespace detail

/// Tangents [Pa] of points whose stress follows from their own strain and from a mean around them.
template <int Dim>
struct SplitTangents {
  std::vector<VoigtTangent<Dim>> by_own;
  std::vector<VoigtTangent<Dim>> by_mean;
};

/// A field whose points see means of their own and their neighbours' gradients: average(gradients, executor) replaces them
/// and fixes stresses [Pa] that add to the answers; split(tangents) tells what the whole stresses follow from. All belong to
/// the last call, as own_gradients() do, those before it. mean().is_local(): every mean is the value itself. The executor has
/// for_each(count, task).
template <class Field>
concept AveragesGradients = MaterialField<Field> &&
    requires(Field& field, Field const& constant, std::vector<Gradient<Field::dim>>& gradients,
             detail::AnyExecutor& executor) {
  {field.average(gradients, executor)};
  { constant.own_gradients() } -> std::same_as<std::vector<Gradient<Field::dim>> const&>;
  { constant.mean().is_local() } -> std::same_as<bool>;
  { constant.added_stresses() } -> std::same_as<std::vector<VoigtStress<Field::dim>> const&>;
  { constant.split(std::vector<VoigtTangent<Field::dim>>{}) } -> std::same_as<SplitTangents<Field::dim>>;
};

/// Committed and trial states of one provider at a set of points.
template <CheckedProvider Provider>
class SCARP_EXPORT ProviderField {
 public:
  static_assert(
      !requires { typename Provider::LocalProvider; },
      "a Nonlocal provider needs its neighbours: make NonlocalMaterials around the field of its local one");
  static constexpr int dim = Provider::dim;
  using State = typename Provider::State;

  ProviderField(Provider provider, std::span<Site<dim> const> sites)
      : ProviderField(std::move(provider), sites, [](int) { return true; }) {}

  /// owned(number of a point in its mesh): points that are asked here; the others have no state.
  template <std::predicate<int> Owned>
  ProviderField(Provider provider, std::span<Site<dim> const> sites, Owned const& owned)
      : provider_(std::move(provider)), sites_(sites.begin(), sites.end()) {
    committed_.reserve(sites.size());
    for (auto const& site : sites) {
      here_.push_back(owned(site.index));
      committed_.push_back(here_.back() ? provider_.initial_state(site) : no_state());
    }
    trial_ = committed_;
    plans_.resize(sites.size());
  }

  Provider const& provider() const { return provider_; }
  int point_count() const { return detail::count(committed_); }
  State const& committed(int point) const { return committed_[detail::index(point)]; }
  State const& trial(int point) const { return trial_[detail::index(point)]; }
  /// The state that the last commit replaced, until the point is asked again.
  State const& replaced(int point) const { return trial_[detail::index(point)]; }
  /// Work that is fixed for the present load step.
  PlanOf<Provider> const& planned(int point) const { return plans_[detail::index(point)]; }

  /// visit(field, local point), as fields that are composed of several do.
  template <class Visit>
  void visit(int point, Visit&& visit) const {
    visit(*this, point);
  }
  template <class Visit>
  void visit(int point, Visit&& visit) {
    visit(*this, point);
  }

  /// Fixes the work of a point for the load step that begins; nothing to do for providers without plan.
  void plan(int point, Gradient<dim> const& predicted) {
    if constexpr (PlansWork<Provider>)
      plans_[detail::index(point)] = provider_.plan(committed_[detail::index(point)], predicted);
  }

  /// Lets a point whose answer is `not_converged` work harder in this load step.
  void refine_plan(int point) {
    if constexpr (PlansWork<Provider>) plans_[detail::index(point)] = provider_.refined(plans_[detail::index(point)]);
  }

  Response<dim> respond(int point, Gradient<dim> const& increment) {
    std::size_t const k = detail::index(point);
    return respond_as_planned(provider_, committed_[k], increment, trial_[k], plans_[k]);
  }

  /// Steps of inner work that one response of this point takes.
  long work(int point) const { return static_cast<long>(plans_[detail::index(point)]); }

  VoigtStress<dim> committed_stress(int point) const { return provider_.stress(committed_[detail::index(point)]); }
  VoigtTangent<dim> committed_tangent(int point) const { return provider_.tangent(committed_[detail::index(point)]); }
  VoigtTangent<dim> trial_tangent(int point) const { return provider_.tangent(trial_[detail::index(point)]); }

  /// The trial states become the committed ones.
  void commit() { committed_.swap(trial_); }

  /// Another committed state for a point, between load steps.
  void put(int point, State state) {
    committed_[detail::index(point)] = std::move(state);
    here_[detail::index(point)] = true;
  }
  /// Leaves a point without state, since another process answers for it.
  void forget(int point) {
    committed_[detail::index(point)] = trial_[detail::index(point)] = no_state();
    here_[detail::index(point)] = false;
  }

  /// A state of a point that a saved one can be read into: with what is not saved, since it follows from the provider and the site.
  /// \throws InputError for states that cannot be made so
  State blank_state(int point) const { return scarp::blank_state(provider_, sites_[detail::index(point)]); }

  /// What evolves: the committed states. Read in, those of all points are here.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(provider_, sites_, here_, committed_, trial_, plans_);
    if constexpr (!std::is_const_v<Self>) {
      for (int point = 0; point < self.point_count(); ++point) {
        if (!self.here_[detail::index(point)]) self.put(point, self.blank_state(point));
      }
    }
    visit("states", std::span(self.committed_));
  }
  void after_loading() { trial_ = committed_; }

 private:
  /// Of a point that another process answers for.
  static State no_state() {
    if constexpr (std::default_initializable<State>) {
      return {};
    } else {
      refuse(
          "points are shared out among processes, but their state cannot be left empty (it has no default "
          "constructor): give it one");
    }
  }

  Provider provider_;
  std::vector<Site<dim>> sites_;
  std::vector<bool> here_;  ///< whether this process has the point's state
  std::vector<State> committed_;
  std::vector<State> trial_;
  std::vector<PlanOf<Provider>> plans_;
};

}  // namespace scarp
