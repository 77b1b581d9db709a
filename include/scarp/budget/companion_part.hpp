// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "scarp/budget/budget_part.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// Part of an error budget that a run cannot see itself: how far its answer is from that of a companion, the same scene with one
/// choice made otherwise - a mesh of other directions, smaller load steps.
/// own, companion: the same measure of both runs; size: what an error is relative to, in the measure's unit
/// \throws InputError for a size that is not finite and positive
inline BudgetPart companion_part(std::string name, double own, double companion, double size, double bound,
                                 std::string meaning) {
  require_positive("size that a companion's difference is relative to", size);
  return {std::move(name), std::abs(companion - own) / size, bound, std::move(meaning)};
}

}  // namespace scarp
