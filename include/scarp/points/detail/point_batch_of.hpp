// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <any>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/unwrap.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/points/detail/point_batch.hpp"
#include "scarp/points/mirrored_state.hpp"
#include "scarp/points/step_doubling.hpp"

namespace scarp::detail {

/// A `PointBatch` of a provider.
template <CheckedProvider Provider>
class PointBatchOf final : public PointBatch<Provider::dim> {
 public:
  static constexpr int dim = Provider::dim;
  using State = typename Provider::State;

  explicit PointBatchOf(std::shared_ptr<Provider const> provider) : provider_(std::move(provider)) {}

  std::unique_ptr<PointBatch<dim>> copy() const override { return std::make_unique<PointBatchOf>(*this); }
  std::unique_ptr<PointBatch<dim>> alone(int k) const override {
    auto one = std::make_unique<PointBatchOf>(provider_);
    one->add(sites_[index(k)], 0, false);
    return one;
  }

  int add(Site<dim> const& site, int number, bool here) override {
    sites_.push_back(site);
    numbers_.push_back(number);
    here_.push_back(here);
    committed_.push_back(here ? provider_->initial_state(site) : no_state());
    trial_.push_back(committed_.back());
    plans_.emplace_back();
    return count(sites_) - 1;
  }
  void release(int k) override {
    committed_[index(k)] = trial_[index(k)] = no_state();
    here_[index(k)] = false;
  }

  void plan(int k, Gradient<dim> const& increment) override {
    if constexpr (HasPlan<Provider>) plans_[index(k)] = provider_->plan(committed_[index(k)], increment);
  }
  bool refine(int k) override {
    if constexpr (HasPlan<Provider>) {
      long const before = work(k);
      plans_[index(k)] = provider_->refined(plans_[index(k)]);
      return work(k) != before;
    } else {
      return false;
    }
  }
  long work(int k) const override { return static_cast<long>(plans_[index(k)]); }
  bool has_exact_tangent() const override { return scarp::has_exact_tangent<Provider>(); }
  bool takes_many() const override {
    if constexpr (has_own_parameters<State>()) return false;
    auto const present = std::ranges::find(here_, true);
    if (present == here_.end()) return false;
    return unwrap(*provider_, committed_[static_cast<std::size_t>(present - here_.begin())],
                  [](auto const& inner, auto const&) {
                    if constexpr (requires { inner.takes_many(); }) return inner.takes_many();
                    return false;
                  });
  }

  void respond(std::span<int const> own, std::vector<Gradient<dim>> const& increments,
               std::vector<Response<dim>>& responses) override {
    for (int const one : own) {
      std::size_t const k = index(one);
      if constexpr (HasPlan<Provider>) {
        auto needed = provider_->plan(committed_[k], increments[index(numbers_[k])]);
        if (static_cast<double>(static_cast<long>(needed)) > plan_slack * static_cast<double>(work(one)))
          plans_[k] = std::move(needed);
      }
    }
    if constexpr (!has_own_parameters<State>())
      if (own.size() > 1) respond_together(own, increments);
    for (int const one : own) {
      std::size_t const k = index(one);
      std::size_t const number = index(numbers_[k]);
      responses[number] = respond_as_planned(*provider_, committed_[k], increments[number], trial_[k], plans_[k]);
    }
  }
  VoigtStress<dim> stress(int k) const override { return provider_->stress(present(k)); }
  VoigtTangent<dim> tangent(int k) const override { return provider_->tangent(present(k)); }
  VoigtTangent<dim> trial_tangent(int k) const override { return provider_->tangent(present(k, trial_)); }
  VoigtTangent<dim> initial_tangent(int k) const override {
    return provider_->tangent(provider_->initial_state(sites_[index(k)]));
  }
  void commit() override { committed_.swap(trial_); }

  void write(int k, StateWriter& writer) const override { described(writer, present(k)); }
  std::any read(int k, StateReader& reader) const override {
    State state = own_state(k);
    described(reader, state);
    require_fitting(state);
    return state;
  }
  void put(int k, std::any state) override {
    trial_[index(k)] = committed_[index(k)] = std::any_cast<State&&>(std::move(state));
    here_[index(k)] = true;
  }
  std::any state_from(int k, PointBatch<dim> const& other, int from,
                      std::optional<Mirror<dim>> const& mirror) const override {
    auto const* const same = dynamic_cast<PointBatchOf const*>(&other);
    if (!same) reject("a point is to be copied from one of another type of provider: copy points of one provider");
    State state = same->present(from);
    keep_place(state, own_state(k));
    if (same->provider_ != provider_) require_fitting(state);
    if (!mirror) return state;
    described(*mirror, state);
    // A strain in Voigt's notation, for example, has the type of a stress and another mirror image.
    VoigtStress<dim> const expected = mirrored_stress<dim>(same->stress(from), mirror->normal);
    constexpr double round_off = 1e-6;
    if (!((provider_->stress(state) - expected).norm() <= round_off * expected.norm()))
      reject(
          "the state of point {} cannot be mirrored (the stress of its image is not the image of its stress): copy it "
          "as it is, or store tensors in it",
          same->numbers_[index(from)]);
    return state;
  }

  std::any shown(int k, std::type_info const& type) const override {
    if (type == typeid(State const*)) return static_cast<State const*>(&committed_[index(k)]);
    return unwrap(*provider_, present(k), [&](auto const& inner, auto const& own) -> std::any {
      if constexpr (requires { inner.quantities(own); })
        if (type == typeid(Quantities)) return inner.quantities(own);
      if constexpr (requires { inner.balance(own); })
        if (type == typeid(PackingBalance)) return inner.balance(own);
      if constexpr (requires { inner.picture(own); })
        if (type == typeid(decltype(inner.picture(own)))) return inner.picture(own);
      return {};
    });
  }
  VoigtStress<dim> floor_stress(int k) const override { return floor_stress_in<dim>(present(k)); }

  DoubledResponse<dim> doubled(int k, Gradient<dim> const& increment, std::string* path) const override {
    State end = committed_[index(k)];
    if (!path) return respond_with_double_work(*provider_, trial_[index(k)], increment, plans_[index(k)], end);
    DoubledResponse<dim> response{{stress(k), {}}, 0};
    if constexpr (Described<State>) {
      if (!path->empty()) {
        State from = end;
        StateReader reader(*path);
        reader("state", from);
        response = respond_with_double_work(*provider_, from, increment, plans_[index(k)], end);
      }
      StateWriter writer;
      writer("state", end);
      *path = std::move(writer.bits());
    }
    return response;
  }

 private:
  /// \throws InputError for a point whose state is on another process
  State const& present(int k) const { return present(k, committed_); }
  State const& present(int k, std::vector<State> const& states) const {
    if (!here_[index(k)])
      reject("the state of point {} is requested where another process owns it: request it from that process",
             numbers_[index(k)]);
    return states[index(k)];
  }
  /// What is not saved of it follows from the provider and the site.
  State own_state(int k) const {
    return here_[index(k)] ? committed_[index(k)] : scarp::empty_state(*provider_, sites_[index(k)]);
  }

  /// \throws InputError for a state that another law has made, where the provider finds that out
  void require_fitting(State const& state) const {
    unwrap(*provider_, state, [](auto const& inner, auto const& own) {
      if constexpr (requires { inner.require_fitting(own); }) inner.require_fitting(own);
    });
  }

  /// Lets the provider within the adaptors respond for all points, where it has a function for that; each point then
  /// finds its own.
  void respond_together(std::span<int const> own, std::vector<Gradient<dim>> const& increments) {
    unwrap(*provider_, trial_[index(own.front())], [&]<class Inner>(Inner const&, auto const&) {
      if constexpr (requires { typename Inner::Request; }) {
        std::vector<typename Inner::Request> requests;
        for (int const one : own) {
          std::size_t const k = index(one);
          auto const* const from =
              unwrap(*provider_, committed_[k], [](auto const&, auto const& state) { return &state; });
          unwrap(*provider_, trial_[k], [&](Inner const& inner, auto& trial) {
            requests.push_back({&inner, from, &increments[index(numbers_[k])], inner_plan(plans_[k]), &trial});
          });
        }
        Inner::respond_together(requests);
      }
    });
  }
  /// Whether every state has a provider of its own, which is no part of one call.
  template <class Inner>
  static constexpr bool has_own_parameters() {
    if constexpr (requires(Inner const& state) { *state.provider; }) {
      return true;
    } else if constexpr (requires(Inner const& state) { state.own; }) {
      return has_own_parameters<std::remove_cvref_t<decltype(std::declval<Inner const&>().own)>>();
    } else {
      return false;
    }
  }
  /// The plan of the provider within adaptors.
  static auto const& inner_plan(auto const& plan) {
    if constexpr (requires { plan.own; }) {
      return inner_plan(plan.own);
    } else {
      return plan;
    }
  }

  /// The state of a point that another process owns.
  static State no_state() {
    if constexpr (std::default_initializable<State>) {
      return {};
    } else {
      reject(
          "points are shared out among processes, but their state cannot be left empty (it has no default "
          "constructor): give it one");
    }
  }

  template <class Visit, class Visited>
  static void described(Visit&& visit, Visited&& visited) {
    if constexpr (Described<State>) {
      visit("state", visited);
    } else {
      reject(
          "states of a provider cannot be saved, sent or mirrored (they name no members): give them a function "
          "members");
    }
  }

  std::shared_ptr<Provider const> provider_;
  std::vector<Site<dim>> sites_;
  std::vector<int> numbers_;  ///< among all points
  std::vector<bool> here_;    ///< whether this process has the point's state
  std::vector<State> committed_;
  std::vector<State> trial_;
  std::vector<scarp::PlanOf<Provider>> plans_;
};

}  // namespace scarp::detail
