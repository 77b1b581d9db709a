// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "scarp/constitutive/material_field.hpp"
#include "scarp/constitutive/step_doubling.hpp"
#include "scarp/io/state_bits.hpp"

/// What an error budget asks of a point whose answer has just been committed. A material field that hides its providers
/// gives functions of these names itself.
namespace scarp {

/// How well the packing of a point is balanced, and how fast it was strained.
struct PointBalance {
  bool has_packing = false;
  double unbalanced_ratio = 0.0;
  double kinetic_share = 0.0;
  double inertial_number = 0.0;
};

namespace detail {

/// Calls visit(provider, state before, state after, plan) for the packing below adaptors that share its plan.
template <class Provider, class State, class Plan, class Visit>
void visit_packing(Provider const& provider, State const& before, State const& after, Plan const& plan,
                   Visit const& visit) {
  if constexpr (requires { provider.inertial_number_of(before, Gradient<Provider::dim>(), plan); }) {
    visit(provider, before, after, plan);
  } else if constexpr (requires { provider.provider, before.own; }) {
    visit_packing(provider.provider, before.own, after.own, plan, visit);
  }
}

}  // namespace detail

/// increment: that was answered. Packings at less than the provider's loose pressure count by their share of it.
template <class Provider>
PointBalance point_balance(ProviderField<Provider> const& field, int local, Gradient<Provider::dim> const& increment) {
  PointBalance balance;
  detail::visit_packing(field.provider(), field.replaced(local), field.committed(local), field.planned(local),
                        [&](auto const& provider, auto const& before, auto const& after, auto const& plan) {
                          if (after.verdict.status == Status::fluid) return;
                          double const weight = provider.weight_of(after);
                          balance = {.has_packing = true,
                                     .unbalanced_ratio = weight * after.unbalanced_ratio,
                                     .kinetic_share = weight * after.kinetic_share,
                                     .inertial_number = provider.inertial_number_of(before, increment, plan)};
                        });
  return balance;
}

/// The committed answer's increment from the state that it began with, with twice the work.
template <class Provider>
DoubledAnswer<Provider::dim> doubled_answer(ProviderField<Provider> const& field, int local,
                                            Gradient<Provider::dim> const& increment) {
  auto trial = field.replaced(local);
  return answer_with_double_work(field.provider(), field.replaced(local), increment, field.planned(local), trial);
}

/// Takes a copy of a point's state, in bits, through the increment with twice the work of the point; without bits it begins
/// with the point's committed state and answers nothing. States that name no members cannot be followed: bits stay empty.
template <class Provider>
DoubledAnswer<Provider::dim> followed_answer(ProviderField<Provider> const& field, int local,
                                             Gradient<Provider::dim> const& increment, std::string& bits) {
  using State = typename Provider::State;
  DoubledAnswer<Provider::dim> answer{{field.provider().stress(field.committed(local)), {}}, 0};
  if constexpr (Described<State>) {
    State state = field.committed(local);
    if (!bits.empty()) {
      State from = state;
      StateReader reader(bits);
      reader("state", from);
      answer = answer_with_double_work(field.provider(), from, increment, field.planned(local), state);
    }
    StateWriter writer;
    writer("state", state);
    bits = std::move(writer.bits());
  }
  return answer;
}

}  // namespace scarp
