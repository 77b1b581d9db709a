// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "scarp/core/pack.hpp"

namespace scarp::lanes {

namespace detail {

/// How the bits of a floating-point number are shared out.
template <class Scalar>
struct FloatBits {
  using Unsigned = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;
  static constexpr int mantissa = std::numeric_limits<Scalar>::digits - 1;
  static constexpr int largest = std::numeric_limits<Scalar>::max_exponent - 3;  ///< power of two that stays normal
  /// Adding it leaves a whole number in the last bits.
  static constexpr Scalar to_whole = Scalar(1.5) * static_cast<Scalar>(Unsigned(1) << mantissa);
  static constexpr std::size_t log_terms = sizeof(Scalar) == 8 ? 12 : 6;
  static constexpr std::size_t exp_terms = sizeof(Scalar) == 8 ? 14 : 8;
};

/// Sum of coefficient(n) x^n below the given number of terms, an even one: even and odd powers side by side, since one chain of
/// products would wait for itself.
template <std::size_t Terms, class Pack, class Coefficient>
[[gnu::always_inline]] inline Pack power_series(Pack const& x, Coefficient coefficient) {
  static_assert(Terms % 2 == 0 && Terms >= 4);
  Pack const squared = x * x;
  Pack even = coefficient(Terms - 2);
  Pack odd = coefficient(Terms - 1);
  for (std::size_t n = Terms - 2; n >= 2; n -= 2) {
    even = even * squared + coefficient(n - 2);
    odd = odd * squared + coefficient(n - 1);
  }
  return even + x * odd;
}

template <class Scalar, std::size_t Count>
consteval std::array<Scalar, Count> inverse_odd_numbers() {
  std::array<Scalar, Count> values{};
  for (std::size_t n = 0; n < Count; ++n) values[n] = static_cast<Scalar>(1.0 / static_cast<double>(2 * n + 1));
  return values;
}

template <class Scalar, std::size_t Count>
consteval std::array<Scalar, Count> inverse_factorials() {
  std::array<Scalar, Count> values{};
  double value = 1.0;
  for (std::size_t n = 0; n < Count; ++n) {
    values[n] = static_cast<Scalar>(value);
    value /= static_cast<double>(n + 1);
  }
  return values;
}

/// Base-2 logarithm of positive normal numbers. With x = 2^k m, m from sqrt(1/2) to sqrt(2), and t = (m - 1) / (m + 1):
/// ln m = 2 (t + t^3 / 3 + t^5 / 5 + ...).
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> log2_of_positive(BasicPack<Scalar, Width> const& x) {
  using Pack = BasicPack<Scalar, Width>;
  using Layout = FloatBits<Scalar>;
  using Unsigned = typename Layout::Unsigned;
  using Bits = VectorOf<Unsigned, Width>;
  constexpr Unsigned least_mantissa = std::bit_cast<Unsigned>(static_cast<Scalar>(1.0 / std::numbers::sqrt2));
  constexpr Unsigned shift = Unsigned(1) << (std::numeric_limits<Unsigned>::digits - Layout::mantissa - 2);
  constexpr Unsigned whole = std::bit_cast<Unsigned>(static_cast<Scalar>(Unsigned(1) << Layout::mantissa));
  Bits const bits = reinterpret_cast<Bits>(x.vector);
  Bits const shifted = (bits - least_mantissa + (shift << Layout::mantissa)) >> Layout::mantissa;  // k + shift
  Pack const m(reinterpret_cast<typename Pack::Vector>(bits - ((shifted - shift) << Layout::mantissa)));
  Pack const k = Pack(reinterpret_cast<typename Pack::Vector>(shifted | whole)) -
                 Pack(static_cast<Scalar>(Unsigned(1) << Layout::mantissa) + static_cast<Scalar>(shift));
  Pack const t = (m - Pack(Scalar(1))) / (m + Pack(Scalar(1)));
  Pack const squared = t * t;
  constexpr auto coefficients = inverse_odd_numbers<Scalar, Layout::log_terms>();
  Pack const sum = power_series<Layout::log_terms>(squared, [&](std::size_t n) { return Pack(coefficients[n]); });
  return k + t * sum * Pack(static_cast<Scalar>(2.0 * std::numbers::log2e));
}

/// 2^x by the exponential series of what is left of x beside a whole number.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> exp2(BasicPack<Scalar, Width> const& x) {
  using Pack = BasicPack<Scalar, Width>;
  using Layout = FloatBits<Scalar>;
  using Unsigned = typename Layout::Unsigned;
  using Bits = VectorOf<Unsigned, Width>;
  Pack const bounded =
      max(min(x, Pack(static_cast<Scalar>(Layout::largest))), Pack(static_cast<Scalar>(-Layout::largest)));
  Pack const shifted = bounded + Pack(Layout::to_whole);
  Pack const part = (bounded - (shifted - Pack(Layout::to_whole))) * Pack(static_cast<Scalar>(std::numbers::ln2));
  constexpr auto coefficients = inverse_factorials<Scalar, Layout::exp_terms>();
  Pack const sum = power_series<Layout::exp_terms>(part, [&](std::size_t n) { return Pack(coefficients[n]); });
  Bits const whole = reinterpret_cast<Bits>(shifted.vector) - std::bit_cast<Unsigned>(Layout::to_whole);
  return Pack(
      reinterpret_cast<typename Pack::Vector>(reinterpret_cast<Bits>(sum.vector) + (whole << Layout::mantissa)));
}

}  // namespace detail

/// base^exponent of positive normal numbers, all lanes at once. The relative error is below 5e-16 (1 + |ln result|) in double,
/// 3e-7 (1 + |ln result|) in float; results below 2^-1021 or above 2^1021 become these (2^-125, 2^125 in float).
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> positive_power(BasicPack<Scalar, Width> const& base,
                                                                      BasicPack<Scalar, Width> const& exponent) {
  return detail::exp2(exponent * detail::log2_of_positive(base));
}

template <class Scalar>
  requires std::is_floating_point_v<Scalar> Scalar positive_power(Scalar base, Scalar exponent) {
    return std::pow(base, exponent);
  }

}  // namespace scarp::lanes
