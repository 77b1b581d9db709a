// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/build_info.hpp"

#include "scarp/core/precompiled.hpp"

SCARP_EXPORT scarp::BuildInfo scarp::library_build() { return build_info(); }
