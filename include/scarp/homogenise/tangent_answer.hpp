// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "scarp/core/status.hpp"
#include "scarp/core/voigt.hpp"

namespace scarp {

/// A tangent that takes work which can fail, and whether it did. `tangent` [Pa] is usable whatever the verdict.
template <int Dim>
struct TangentAnswer {
  VoigtTangent<Dim> tangent;
  Verdict verdict;
};

/// Hears of tangents that a policy had to replace or could not make to its accuracy; may be called by several threads.
using TangentComplaint = void (*)(std::string_view what, Verdict verdict);

/// One line for each on standard error.
inline void complain_of_tangent(std::string_view what, Verdict verdict) {
  fmt::print(stderr, "scarp: {} ({}, {})\n", what, name(verdict.status), name(verdict.reason));
}

}  // namespace scarp
