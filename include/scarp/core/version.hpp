// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>

/// The only place that states the version; CMake reads it here. Before 1.0 a new minor number may change names.
#define SCARP_VERSION "0.2.0"

namespace scarp {

/// SCARP_VERSION as a string.
inline constexpr std::string_view version = SCARP_VERSION;

}  // namespace scarp
