// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

namespace samples {

/// Relative to what is expected. doctest::Approx(x).epsilon(e) allows e (1 + |x|) instead: for numbers far below one, such as
/// overlaps in metres, that is no test at all.
inline double relative_error(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

}  // namespace samples
