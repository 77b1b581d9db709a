// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <any>
#include <concepts>
#include <memory>
#include <optional>
#include <utility>

#include "scarp/constitutive/detail/hidden_provider.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// Any provider, chosen while a program runs, its type hidden from scenes, solvers and observers: they are compiled once for
/// all materials. A virtual call stands before an answer, none within it. The answers are the provider's own, bit for bit.
/// \code
/// scarp::AnyProvider<2> soil = stiff ? scarp::AnyProvider<2>(elastic) : scarp::AnyProvider<2>(packings);
/// \endcode
/// `RveQuantities`, `packing_in`, checkpoints, ranks and error budgets see through it; what else an observer wants of a state it asks by
/// `state.as<State>()`.
template <int Dim>
class AnyProvider {
 public:
  static constexpr int dim = Dim;
  using State = AnyState<Dim>;

  /// Work that the provider has fixed for a load step.
  struct Plan {
    std::any own;
    long steps = 0;

    explicit operator long() const { return steps; }
  };

  /// Of no use until another one is assigned.
  AnyProvider() = default;

  template <ConstitutiveProvider Provider>
    requires(!std::same_as<Provider, AnyProvider> && Provider::dim == Dim)
  AnyProvider(Provider provider)  // NOLINT: any provider is one
      : held_(std::make_shared<detail::HiddenProviderOf<Provider>>(std::move(provider))) {}

  /// \throws InputError where there is no provider
  State initial_state(Site<Dim> const& site) const { return held().initial_state(site); }
  State blank_state(Site<Dim> const& site) const { return held().blank_state(site); }

  Plan plan(State const& committed, Gradient<Dim> const& increment) const {
    return counted(held_->plan(committed, increment));
  }
  Plan refined(Plan const& plan) const { return counted(held_->refined(plan.own)); }

  Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }
  Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial, Plan const& plan) const {
    if (!trial.is_like(committed)) trial = committed;
    return held_->respond(committed, increment, trial, plan.own);
  }
  DoubledAnswer<Dim> answer_with_double_work(State const& from, Gradient<Dim> const& increment, Plan const& plan,
                                             State& trial) const {
    if (!trial.is_like(from)) trial = from;
    return held_->answer_with_double_work(from, increment, plan.own, trial);
  }

  VoigtStress<Dim> stress(State const& state) const { return held_->stress(state); }
  VoigtTangent<Dim> tangent(State const& state) const { return held_->tangent(state); }

  Quantities quantities(State const& state) const { return held_->quantities(state); }
  std::optional<PackingPicture> packing_in(State const& state) const { return held_->packing_in(state); }
  PackingBalance packing_balance(State const& before, State const& after, Gradient<Dim> const& increment,
                                 Plan const& plan) const {
    return held_->packing_balance(before, after, increment, plan.own);
  }

 private:
  Plan counted(std::any own) const {
    long const steps = held_->work(own);
    return {std::move(own), steps};
  }

  detail::HiddenProvider<Dim> const& held() const {
    if (!held_) refuse("an AnyProvider is asked that holds no provider: assign one to it first");
    return *held_;
  }

  std::shared_ptr<detail::HiddenProvider<Dim> const> held_;
};

static_assert(PlansWork<AnyProvider<2>> && PlansWork<AnyProvider<3>>);

}  // namespace scarp
