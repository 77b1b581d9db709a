// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <cstddef>

#include "scarp/core/one_version.hpp"

namespace scarp::detail {

/// A node, element, point, grain or row number as an index into a standard container; the number is not negative.
constexpr std::size_t index(std::signed_integral auto number) { return static_cast<std::size_t>(number); }

/// The number of entries of a container as the signed integer that numbers them.
template <class Container>
constexpr int count(Container const& container) {
  return static_cast<int>(container.size());
}

}  // namespace scarp::detail
