// SPDX-License-Identifier: BSL-1.0
/// \file
/// What judges a run's errors while it goes on, and compares them with bounds.
/// `error_budget.hpp` is an observer: residuals, doubled time steps, followed points, unbalanced and unfed packings.
/// `error_bounds.hpp` has the usual bounds, `error_sampling.hpp` says how many points are looked at.
/// `companion_part.hpp`: what a run cannot see itself, by the same scene once more.
/// A part is relative; NaN is outside every bound.
/// docs/error-budget.md says how well it predicts.
#pragma once

#include "scarp/budget/budget_part.hpp"
#include "scarp/budget/companion_part.hpp"
#include "scarp/budget/error_bounds.hpp"
#include "scarp/budget/error_budget.hpp"
#include "scarp/budget/error_sampling.hpp"
