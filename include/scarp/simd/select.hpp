// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "scarp/simd/pack.hpp"

namespace scarp::lanes {

/// `yes` where the condition holds, `no` elsewhere; both are always computed. The condition of numbers is a bool, of
/// packs a mask.
template <class T>
constexpr T select(bool condition, T const& yes, T const& no) {
  return condition ? yes : no;
}
/// Lane by lane; both alternatives are always computed.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> select(BasicMask<Scalar, Width> const& condition,
                                                              BasicPack<Scalar, Width> const& yes,
                                                              BasicPack<Scalar, Width> const& no) {
  return BasicPack<Scalar, Width>(condition.vector ? yes.vector : no.vector);
}
/// Lane by lane for each number of an array.
template <class Scalar, std::size_t Width, std::size_t Size>
std::array<BasicPack<Scalar, Width>, Size> select(BasicMask<Scalar, Width> const& condition,
                                                  std::array<BasicPack<Scalar, Width>, Size> const& yes,
                                                  std::array<BasicPack<Scalar, Width>, Size> const& no) {
  auto chosen = no;
  for (std::size_t k = 0; k < Size; ++k) chosen[k] = select(condition, yes[k], no[k]);
  return chosen;
}

/// The greater one; not-a-number in `value` stays: of packs it is the second operand of `max`.
template <std::floating_point T>
constexpr T at_least(T const& value, T const& floor) {
  return value < floor ? floor : value;
}
/// The greater one in each lane; not-a-number in `value` stays.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> at_least(BasicPack<Scalar, Width> const& value,
                                                                BasicPack<Scalar, Width> const& floor) {
  return max(floor, value);
}

/// The smaller one; not-a-number in `value` stays: of packs it is the second operand of `min`.
template <std::floating_point T>
constexpr T at_most(T const& value, T const& ceiling) {
  return ceiling < value ? ceiling : value;
}
/// The smaller one in each lane; not-a-number in `value` stays.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> at_most(BasicPack<Scalar, Width> const& value,
                                                               BasicPack<Scalar, Width> const& ceiling) {
  return min(ceiling, value);
}

}  // namespace scarp::lanes
