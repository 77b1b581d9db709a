// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <any>
#include <concepts>
#include <memory>
#include <optional>
#include <type_traits>
#include <typeinfo>
#include <utility>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/rve_quantities.hpp"
#include "scarp/constitutive/step_doubling.hpp"
#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/state_bits.hpp"

namespace scarp {

namespace detail {

/// A state whose type nobody sees.
template <int Dim>
class HiddenState {
 public:
  virtual ~HiddenState() = default;
  virtual std::unique_ptr<HiddenState> copy() const = 0;
  /// other: of the same type
  virtual void take(HiddenState const& other) = 0;
  virtual bool is_described() const = 0;
  virtual void write(StateWriter& writer) const = 0;
  virtual void read(StateReader& reader) = 0;
  virtual VoigtStress<Dim> floor_stress_inside() const = 0;
};

template <int Dim, class State>
class HiddenStateOf final : public HiddenState<Dim> {
 public:
  HiddenStateOf() = default;
  explicit HiddenStateOf(State from) : state(std::move(from)) {}

  std::unique_ptr<HiddenState<Dim>> copy() const override { return std::make_unique<HiddenStateOf>(state); }
  void take(HiddenState<Dim> const& other) override { state = static_cast<HiddenStateOf const&>(other).state; }
  bool is_described() const override { return Described<State>; }
  void write(StateWriter& writer) const override { described(writer, state); }
  void read(StateReader& reader) override { described(reader, state); }
  VoigtStress<Dim> floor_stress_inside() const override { return floor_stress_in<Dim>(state); }

  State state;

 private:
  template <class Visit, class Visited>
  static void described(Visit& visit, Visited& visited) {
    if constexpr (Described<State>) {
      visit("state", visited);
    } else {
      refuse(
          "states of the provider in an AnyProvider cannot be saved or sent (they name no members): give them a "
          "function members");
    }
  }
};

}  // namespace detail

/// A state of an `AnyProvider`; empty when it is made without one.
template <int Dim>
class AnyState {
 public:
  AnyState() = default;
  explicit AnyState(std::unique_ptr<detail::HiddenState<Dim>> held) : held_(std::move(held)) {}
  AnyState(AnyState const& other) : held_(other.held_ ? other.held_->copy() : nullptr) {}
  AnyState(AnyState&&) noexcept = default;
  AnyState& operator=(AnyState const& other) {
    if (this == &other) return *this;
    if (is_like(other)) {
      held_->take(*other.held_);
    } else {
      held_ = other.held_ ? other.held_->copy() : nullptr;
    }
    return *this;
  }
  AnyState& operator=(AnyState&&) noexcept = default;
  ~AnyState() = default;

  /// Whether both hold states of one type.
  bool is_like(AnyState const& other) const { return held_ && other.held_ && typeid(*held_) == typeid(*other.held_); }
  bool is_described() const { return held_ && held_->is_described(); }
  VoigtStress<Dim> floor_stress_inside() const {
    return held_ ? held_->floor_stress_inside() : VoigtStress<Dim>(VoigtStress<Dim>::Zero());
  }

  /// The state of a provider of this type. \throws std::bad_cast for another one's
  template <class State>
  State const& as() const {
    if (!held_) throw std::bad_cast();
    return dynamic_cast<detail::HiddenStateOf<Dim, State> const&>(*held_).state;
  }

  detail::HiddenState<Dim>& held() { return *held_; }
  detail::HiddenState<Dim> const& held() const { return *held_; }

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    using Visitor = std::remove_cvref_t<Visit>;
    if (!self.held_) return;
    if constexpr (std::same_as<Visitor, StateWriter>) {
      self.held_->write(visit);
    } else if constexpr (std::same_as<Visitor, StateReader>) {
      self.held_->read(visit);
    }
  }

 private:
  std::unique_ptr<detail::HiddenState<Dim>> held_;
};

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
  long work(std::any const& plan) const override { return static_cast<long>(own(plan)); }
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial,
                        std::any const& plan) const override {
    return respond_as_planned(provider_, own(committed), increment, own(trial), own(plan));
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
