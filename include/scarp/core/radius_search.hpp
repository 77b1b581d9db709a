// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <nanoflann.hpp>
#include <utility>

#include "scarp/core/one_version.hpp"

/// Types of nanoflann's search within a radius and of its results: 1.5 has given both other names.
namespace scarp::detail {

#if NANOFLANN_VERSION >= 0x150
using RadiusSearchParameters = nanoflann::SearchParameters;
using RadiusSearchHit = nanoflann::ResultItem<std::uint32_t, double>;
#else
using RadiusSearchParameters = nanoflann::SearchParams;
using RadiusSearchHit = std::pair<std::uint32_t, double>;
#endif

/// Hits in any order.
inline RadiusSearchParameters unsorted_search() {
  RadiusSearchParameters parameters;
  parameters.sorted = false;
  return parameters;
}

}  // namespace scarp::detail
