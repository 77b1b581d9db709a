// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/constitutive/constitutive_provider.hpp"

namespace scarp {

/// Displacement gradient H of half an increment at constant velocity gradient, \f$ (I + H)^2 = I + G \f$; for
/// increments below one half, to round-off.
template <int Dim>
Gradient<Dim> half_increment(Gradient<Dim> const& gradient) {
  Gradient<Dim> half = gradient / 2.0;
  for (int k = 0; k < 60; ++k) half = ((gradient - half * half) / 2.0).eval();
  return half;
}

/// A response with twice the work, and that work in a provider's own steps (one for each response of a
/// provider that counts none).
template <int Dim>
struct DoubledResponse {
  Response<Dim> response;  ///< stress [Pa] and verdict
  long work = 0;           ///< inner steps, or the number of responses
};

/// Response to an increment with twice the work: by the refined plan where that has more inner steps, else in two
/// halves.
/// trial: overwritten with the state that belongs to the response
template <CheckedProvider Provider>
DoubledResponse<Provider::dim> respond_with_double_work(Provider const& provider, typename Provider::State const& from,
                                                        Gradient<Provider::dim> const& increment,
                                                        PlanOf<Provider> const& plan, typename Provider::State& trial) {
  auto const in_halves = [&](auto const&... work) {
    Gradient<Provider::dim> const half = half_increment<Provider::dim>(increment);
    typename Provider::State middle = from;
    if (auto const first = provider.respond(from, half, middle, work...); first.verdict.status == Status::failed)
      return first;
    return provider.respond(middle, half, trial, work...);
  };
  if constexpr (HasPlan<Provider>) {
    auto const refined = provider.refined(plan);
    if (static_cast<long>(refined) > static_cast<long>(plan))
      return {provider.respond(from, increment, trial, refined), static_cast<long>(refined)};
    return {in_halves(plan), 2 * static_cast<long>(plan)};
  } else {
    return {in_halves(), 2};
  }
}

/// Frobenius norm of a stress [Pa].
template <int Dim>
double stress_size(VoigtStress<Dim> const& stress) {
  return from_voigt_stress<Dim, double>(stress).norm();
}

/// Size of the difference of two stresses over that of the first one, which counts as `least` [Pa] where it is below
/// it. Infinite for a response that failed.
template <int Dim>
double stress_difference(VoigtStress<Dim> const& stress, Response<Dim> const& other, double least) {
  double const apart = stress_size<Dim>(other.stress - stress);
  if (other.verdict.status == Status::failed || !std::isfinite(apart)) return std::numeric_limits<double>::infinity();
  return apart == 0.0 ? 0.0 : apart / std::max(stress_size<Dim>(stress), least);
}

}  // namespace scarp
