// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <any>
#include <concepts>
#include <memory>
#include <optional>
#include <utility>

#include "scarp/constitutive/any_state.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/rve_quantities.hpp"
#include "scarp/constitutive/step_doubling.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

namespace detail {

template <int Dim>
class HiddenProvider {
 public:
  using State = AnyState<Dim>;

  virtual ~HiddenProvider() = default;
  virtual State initial_state(Site<Dim> const& site) const = 0;
  virtual State blank_state(Site<Dim> const& site) const = 0;
  virtual std::any plan(State const& committed, Gradient<Dim> const& increment) const = 0;
  virtual std::any refined(std::any const& plan) const = 0;
  virtual long work(std::any const& plan) const = 0;
  virtual Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial,
                                std::any const& plan) const = 0;
  virtual DoubledAnswer<Dim> answer_with_double_work(State const& from, Gradient<Dim> const& increment,
                                                     std::any const& plan, State& trial) const = 0;
  virtual VoigtStress<Dim> stress(State const& state) const = 0;
  virtual VoigtTangent<Dim> tangent(State const& state) const = 0;
  virtual Quantities quantities(State const& state) const = 0;
  virtual std::optional<PackingPicture> packing_in(State const& state) const = 0;
  virtual PackingBalance packing_balance(State const& state) const = 0;
};

template <ConstitutiveProvider Provider>
class HiddenProviderOf final : public HiddenProvider<Provider::dim> {
 public:
  static constexpr int dim = Provider::dim;
  using State = AnyState<dim>;

  explicit HiddenProviderOf(Provider provider) : provider_(std::move(provider)) {}

  State initial_state(Site<dim> const& site) const override {
    return State(std::make_unique<Hidden>(provider_.initial_state(site)));
  }
  State blank_state(Site<dim> const& site) const override {
    return State(std::make_unique<Hidden>(scarp::blank_state(provider_, site)));
  }
  std::any plan(State const& committed, Gradient<dim> const& increment) const override {
    if constexpr (PlansWork<Provider>) {
      return provider_.plan(own(committed), increment);
    } else {
      return {};
    }
  }
  std::any refined(std::any const& plan) const override {
    if constexpr (PlansWork<Provider>) {
      return provider_.refined(own(plan));
    } else {
      return plan;
    }
  }
  long work(std::any const& plan) const override {
    if constexpr (PlansWork<Provider>) {
      return static_cast<long>(own(plan));
    } else {
      return 0;
    }
  }
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        std::any const& plan) const override {
    if constexpr (PlansWork<Provider>) {
      return provider_.respond(own(committed), increment, own(trial), own(plan));
    } else {
      return provider_.respond(own(committed), increment, own(trial));
    }
  }
  DoubledAnswer<dim> answer_with_double_work(State const& from, Gradient<dim> const& increment, std::any const& plan,
                                             State& trial) const override {
    return scarp::answer_with_double_work(provider_, own(from), increment, own(plan), own(trial));
  }
  VoigtStress<dim> stress(State const& state) const override { return provider_.stress(own(state)); }
  VoigtTangent<dim> tangent(State const& state) const override { return provider_.tangent(own(state)); }
  Quantities quantities(State const& state) const override { return RveQuantities{}(provider_, own(state)); }
  std::optional<PackingPicture> packing_in(State const& state) const override {
    return scarp::packing_in(provider_, own(state));
  }
  PackingBalance packing_balance(State const& state) const override {
    return scarp::packing_balance(provider_, own(state));
  }

 private:
  using Hidden = HiddenStateOf<dim, typename Provider::State>;

  static typename Provider::State const& own(State const& state) {
    return static_cast<Hidden const&>(state.held()).state;
  }
  static typename Provider::State& own(State& state) { return static_cast<Hidden&>(state.held()).state; }
  static scarp::PlanOf<Provider> own(std::any const& plan) {
    if (auto const* own = std::any_cast<scarp::PlanOf<Provider>>(&plan)) return *own;
    return {};
  }

  Provider provider_;
};

}  // namespace detail

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
  PackingBalance packing_balance(State const& state) const { return held_->packing_balance(state); }

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
