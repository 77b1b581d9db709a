// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <typeinfo>
#include <utility>

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

}  // namespace scarp
