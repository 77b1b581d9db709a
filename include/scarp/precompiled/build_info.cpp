// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/build_info.hpp"

#include "scarp/core/one_version.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/tensor/tensor.hpp"

SCARP_EXPORT scarp::BuildInfo scarp::library_build() { return build_info(); }

SCARP_EXPORT int scarp::detail::version_of_library() { return version_number(); }

SCARP_EXPORT int scarp::detail::container_of_library() { return bytes_of_container(); }

SCARP_EXPORT int scarp::detail::alignment_of_library() { return own_alignment(); }
