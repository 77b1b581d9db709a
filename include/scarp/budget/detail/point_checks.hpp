// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "scarp/constitutive/material_field.hpp"
#include "scarp/constitutive/packing_balance.hpp"
#include "scarp/constitutive/step_doubling.hpp"
#include "scarp/io/state_bits.hpp"

/// What an error budget asks of a point whose answer has just been committed.
namespace scarp {

/// increment: that was answered
template <class Provider>
PackingBalance point_balance(ProviderField<Provider> const& field, int local,
                             Gradient<Provider::dim> const& increment) {
  return packing_balance(field.provider(), field.replaced(local), field.committed(local), increment,
                         field.planned(local));
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
    if constexpr (requires { state.is_described(); }) {
      if (!state.is_described()) return answer;
    }
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
