// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <experimental/simd>

#include "scarp/core/one_version.hpp"

namespace scarp::lanes {

/// `yes` where the condition holds, `no` elsewhere; both are always computed. Numbers take a bool, packs a mask.
template <class T>
T select(bool condition, T const& yes, T const& no) {
  return condition ? yes : no;
}
template <class Scalar, class Abi>
std::experimental::simd<Scalar, Abi> select(std::experimental::simd_mask<Scalar, Abi> const& condition,
                                            std::experimental::simd<Scalar, Abi> const& yes,
                                            std::experimental::simd<Scalar, Abi> const& no) {
  auto chosen = no;
  where(condition, chosen) = yes;
  return chosen;
}
template <class Scalar, class Abi, std::size_t Size>
auto select(std::experimental::simd_mask<Scalar, Abi> const& condition,
            std::array<std::experimental::simd<Scalar, Abi>, Size> const& yes,
            std::array<std::experimental::simd<Scalar, Abi>, Size> const& no) {
  auto chosen = no;
  for (std::size_t k = 0; k < Size; ++k) where(condition, chosen[k]) = yes[k];
  return chosen;
}

/// The greater one; not-a-number in `value` stays, which `max` does not promise for packs.
template <std::floating_point T>
T at_least(T const& value, T const& floor) {
  return value < floor ? floor : value;
}
template <class Scalar, class Abi>
std::experimental::simd<Scalar, Abi> at_least(std::experimental::simd<Scalar, Abi> const& value,
                                              std::experimental::simd<Scalar, Abi> const& floor) {
  return select(value < floor, floor, value);
}

/// The smaller one; not-a-number in `value` stays, which `min` does not promise for packs.
template <std::floating_point T>
T at_most(T const& value, T const& ceiling) {
  return ceiling < value ? ceiling : value;
}
template <class Scalar, class Abi>
std::experimental::simd<Scalar, Abi> at_most(std::experimental::simd<Scalar, Abi> const& value,
                                             std::experimental::simd<Scalar, Abi> const& ceiling) {
  return select(ceiling < value, ceiling, value);
}

}  // namespace scarp::lanes
