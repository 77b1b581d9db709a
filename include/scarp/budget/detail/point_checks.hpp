// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <vector>

#include "scarp/constitutive/material_field.hpp"
#include "scarp/constitutive/rve_quantities.hpp"
#include "scarp/constitutive/step_doubling.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/worse_of.hpp"
#include "scarp/io/state_bits.hpp"

/// What an error budget asks of a point whose answer has just been committed.
namespace scarp {

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

/// How well all packings of a problem were balanced, and how fast they were strained, over its accepted steps.
struct PackingSurvey {
  double looked_at = 0.0;  ///< packings of all steps
  double unbalanced_sum = 0.0;
  double unbalanced = 0.0;  ///< largest, as the next two
  double kinetic_share = 0.0;
  double inertial_number = 0.0;

  double mean_unbalanced() const { return looked_at > 0.0 ? unbalanced_sum / looked_at : 0.0; }

  /// After an accepted step.
  template <class Problem>
  void look(Problem const& problem, std::vector<int> const& points) {
    for (int const point : points) {
      problem.materials().visit(point, [&](auto const& field, int local) {
        PackingBalance const found = packing_balance(field.provider(), field.committed(local));
        if (!found.has_packing) return;
        looked_at += 1.0;
        unbalanced_sum += found.unbalanced_ratio;
        unbalanced = worse_of(unbalanced, found.unbalanced_ratio);
        kinetic_share = worse_of(kinetic_share, found.kinetic_share);
        inertial_number = worse_of(inertial_number, found.inertial_number);
      });
    }
  }

  SCARP_MEMBERS(looked_at, unbalanced_sum, unbalanced, kinetic_share, inertial_number)
};

}  // namespace scarp
