// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

namespace scarp {

/// The larger of two errors; one that is no number is worse than any. (std::max passes over it in one of its places.)
inline double nan_max(double one, double other) { return std::isnan(one) || one >= other ? one : other; }

}  // namespace scarp
