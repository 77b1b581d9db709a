// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/simd/pack.hpp"

// Functions of packs with the names of <cmath> and <algorithm>. Found by their arguments: a law writes
// `using std::sqrt;` and calls `sqrt(x)` for packs and numbers alike.
namespace scarp::lanes {

namespace detail {

template <class Function, class Scalar, std::size_t Width, class... Others>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> lane_by_lane(Function function,
                                                                    BasicPack<Scalar, Width> const& first,
                                                                    Others const&... others) {
  BasicPack<Scalar, Width> values;
  for (std::size_t lane = 0; lane < Width; ++lane) {
    values.vector[lane] = function(first.vector[lane], others.vector[lane]...);
  }
  return values;
}

/// Bits of a scalar but its sign.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline auto magnitude_bits() {
  using Bits = typename BasicMask<Scalar, Width>::Vector;
  using Integer = std::remove_cvref_t<decltype(std::declval<Bits>()[0])>;
  return Bits{} + std::numeric_limits<Integer>::max();
}

}  // namespace detail

/// By the register's own instruction, also where the compiler must set errno for single numbers.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> sqrt(BasicPack<Scalar, Width> const& x) {
  using Pack [[maybe_unused]] = BasicPack<Scalar, Width>;
  [[maybe_unused]] constexpr std::size_t bytes = Width * sizeof(Scalar);
  [[maybe_unused]] constexpr bool is_double = sizeof(Scalar) == 8;
#if defined(__AVX512F__)
  if constexpr (bytes == 64 && is_double) return Pack(_mm512_sqrt_pd(x.vector));
  if constexpr (bytes == 64 && !is_double) return Pack(_mm512_sqrt_ps(x.vector));
#endif
#if defined(__AVX__)
  if constexpr (bytes == 32 && is_double) return Pack(_mm256_sqrt_pd(x.vector));
  if constexpr (bytes == 32 && !is_double) return Pack(_mm256_sqrt_ps(x.vector));
#endif
#if defined(__SSE2__)
  if constexpr (bytes == 16 && is_double) return Pack(_mm_sqrt_pd(x.vector));
  if constexpr (bytes == 16 && !is_double) return Pack(_mm_sqrt_ps(x.vector));
#endif
  return detail::lane_by_lane([](Scalar value) { return std::sqrt(value); }, x);
}

/// Magnitude of each lane, by clearing the sign's bit.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> abs(BasicPack<Scalar, Width> const& x) {
  using Pack = BasicPack<Scalar, Width>;
  using Bits = typename Pack::Mask::Vector;
  return Pack(reinterpret_cast<typename Pack::Vector>(reinterpret_cast<Bits>(x.vector) &
                                                      detail::magnitude_bits<Scalar, Width>()));
}

/// Magnitude of one pack with the signs of another, lane by lane.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> copysign(BasicPack<Scalar, Width> const& magnitude,
                                                                BasicPack<Scalar, Width> const& sign) {
  using Pack = BasicPack<Scalar, Width>;
  using Bits = typename Pack::Mask::Vector;
  auto const kept = detail::magnitude_bits<Scalar, Width>();
  return Pack(reinterpret_cast<typename Pack::Vector>((reinterpret_cast<Bits>(magnitude.vector) & kept) |
                                                      (reinterpret_cast<Bits>(sign.vector) & ~kept)));
}

/// Not-a-number in either gives `b`, as the processors' instructions do; use `at_most` where it must stay.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> min(BasicPack<Scalar, Width> const& a,
                                                           BasicPack<Scalar, Width> const& b) {
#if defined(__AVX__)
  using Pack [[maybe_unused]] = BasicPack<Scalar, Width>;
  // g++ compares and chooses where one operand is a constant.
#if defined(__AVX512F__)
  if constexpr (Width * sizeof(Scalar) == 64 && sizeof(Scalar) == 8) return Pack(_mm512_min_pd(a.vector, b.vector));
#endif
  if constexpr (Width * sizeof(Scalar) == 32 && sizeof(Scalar) == 8) return Pack(_mm256_min_pd(a.vector, b.vector));
  if constexpr (Width * sizeof(Scalar) == 32 && sizeof(Scalar) == 4) return Pack(_mm256_min_ps(a.vector, b.vector));
#endif
  return BasicPack<Scalar, Width>(a.vector < b.vector ? a.vector : b.vector);
}
/// Not-a-number in either gives `b`, as the processors' instructions do; use `at_least` where it must stay.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> max(BasicPack<Scalar, Width> const& a,
                                                           BasicPack<Scalar, Width> const& b) {
#if defined(__AVX__)
  using Pack [[maybe_unused]] = BasicPack<Scalar, Width>;
#if defined(__AVX512F__)
  if constexpr (Width * sizeof(Scalar) == 64 && sizeof(Scalar) == 8) return Pack(_mm512_max_pd(a.vector, b.vector));
#endif
  if constexpr (Width * sizeof(Scalar) == 32 && sizeof(Scalar) == 8) return Pack(_mm256_max_pd(a.vector, b.vector));
  if constexpr (Width * sizeof(Scalar) == 32 && sizeof(Scalar) == 4) return Pack(_mm256_max_ps(a.vector, b.vector));
#endif
  return BasicPack<Scalar, Width>(a.vector > b.vector ? a.vector : b.vector);
}

/// The greatest lane. Not-a-number in the first lane is returned, in the others it is passed over.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline Scalar hmax(BasicPack<Scalar, Width> const& x) {
  Scalar greatest = x[0];
  for (std::size_t lane = 1; lane < Width; ++lane) greatest = x[lane] > greatest ? x[lane] : greatest;
  return greatest;
}

/// Lane after lane by std::pow; `positive_power` is faster where bases are positive.
template <class Scalar, std::size_t Width>
BasicPack<Scalar, Width> pow(BasicPack<Scalar, Width> const& base, BasicPack<Scalar, Width> const& exponent) {
  return detail::lane_by_lane([](Scalar b, Scalar e) { return std::pow(b, e); }, base, exponent);
}
/// Angle [rad] of (x, y) from the x axis, lane after lane by std::atan2.
template <class Scalar, std::size_t Width>
BasicPack<Scalar, Width> atan2(BasicPack<Scalar, Width> const& y, BasicPack<Scalar, Width> const& x) {
  return detail::lane_by_lane([](Scalar a, Scalar b) { return std::atan2(a, b); }, y, x);
}
/// Length of (x, y), lane after lane by std::hypot.
template <class Scalar, std::size_t Width>
BasicPack<Scalar, Width> hypot(BasicPack<Scalar, Width> const& x, BasicPack<Scalar, Width> const& y) {
  return detail::lane_by_lane([](Scalar a, Scalar b) { return std::hypot(a, b); }, x, y);
}
/// cbrt, exp, log, tanh, sin, cos, tan, asin, acos, atan, floor and ceil of a pack, lane after lane by the standard
/// functions.
#define SCARP_LANE_BY_LANE(FUNCTION)                                                   \
  template <class Scalar, std::size_t Width>                                           \
  BasicPack<Scalar, Width> FUNCTION(BasicPack<Scalar, Width> const& x) {               \
    return detail::lane_by_lane([](Scalar value) { return std::FUNCTION(value); }, x); \
  }
SCARP_LANE_BY_LANE(cbrt)
SCARP_LANE_BY_LANE(exp)
SCARP_LANE_BY_LANE(log)
SCARP_LANE_BY_LANE(tanh)
SCARP_LANE_BY_LANE(sin)
SCARP_LANE_BY_LANE(cos)
SCARP_LANE_BY_LANE(tan)
SCARP_LANE_BY_LANE(asin)
SCARP_LANE_BY_LANE(acos)
SCARP_LANE_BY_LANE(atan)
SCARP_LANE_BY_LANE(floor)
SCARP_LANE_BY_LANE(ceil)
#undef SCARP_LANE_BY_LANE

}  // namespace scarp::lanes
