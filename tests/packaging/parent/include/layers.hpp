// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/version.hpp"

namespace layers {

inline bool stands_on_scarp() { return !scarp::version.empty(); }

}  // namespace layers
