// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "scarp/simd/pack.hpp"

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
  static constexpr std::size_t log_terms = sizeof(Scalar) == 8 ? 8 : 4;
  static constexpr std::size_t exp_terms = sizeof(Scalar) == 8 ? 12 : 7;
};

/// A power series cut off so that what is left errs evenly from `low` to `high`: the highest powers are removed with
/// the multiples of Chebyshev's polynomials that hold them (Lanczos's economisation).
template <class Scalar, std::size_t Terms, std::size_t More>
consteval std::array<Scalar, Terms> economised(std::array<long double, More> series, long double low,
                                               long double high) {
  for (std::size_t degree = More - 1; degree >= Terms; --degree) {
    std::array<long double, More> before{1.0L};
    std::array<long double, More> chebyshev{-(high + low) / (high - low), 2.0L / (high - low)};
    for (std::size_t n = 1; n < degree; ++n) {
      std::array<long double, More> next{};
      for (std::size_t k = 0; k <= n + 1; ++k) {
        next[k] = -before[k] - 2.0L * (high + low) / (high - low) * chebyshev[k];
        if (k > 0) next[k] += 4.0L / (high - low) * chebyshev[k - 1];
      }
      before = chebyshev;
      chebyshev = next;
    }
    long double const share = series[degree] / chebyshev[degree];
    for (std::size_t k = 0; k <= degree; ++k) series[k] -= share * chebyshev[k];
  }
  std::array<Scalar, Terms> cut{};
  for (std::size_t n = 0; n < Terms; ++n) cut[n] = static_cast<Scalar>(series[n]);
  return cut;
}

/// log2((1 + t) / (1 - t)) / t in powers of t^2, for arguments of the logarithm from sqrt(1/2) to sqrt(2). Errors
/// relative to 1: 1e-18 in double, 1e-9 in float.
template <class Scalar>
consteval auto log_coefficients() {
  std::array<long double, 14> series{};
  for (std::size_t n = 0; n < series.size(); ++n)
    series[n] = 2.0L * std::numbers::log2e_v<long double> / static_cast<long double>(2 * n + 1);
  constexpr long double largest = 3.0L - 2.0L * std::numbers::sqrt2_v<long double>;  // t
  return economised<Scalar, FloatBits<Scalar>::log_terms>(series, 0.0L, largest * largest);
}

/// factor 2^x, x from -1/2 to 1/2. Errors relative to 1: 3e-18 in double, 2e-9 in float.
template <class Scalar>
consteval auto exp_coefficients(long double factor) {
  std::array<long double, 18> series{};
  for (std::size_t n = 0; n < series.size(); ++n) {
    series[n] = factor;
    factor *= std::numbers::ln2_v<long double> / static_cast<long double>(n + 1);
  }
  return economised<Scalar, FloatBits<Scalar>::exp_terms>(series, -0.5L, 0.5L);
}

/// Several packs that go through the same long chain of steps are evaluated side by side: the processor works on one
/// while another waits.
template <class Scalar, std::size_t Width, std::size_t Count>
using Packs = std::array<BasicPack<Scalar, Width>, Count>;

/// Sum of coefficient[n] x^n; even and odd powers side by side as well.
template <class Scalar, std::size_t Width, std::size_t Count, std::size_t Terms>
[[gnu::always_inline]] inline Packs<Scalar, Width, Count> power_series(Packs<Scalar, Width, Count> const& x,
                                                                       std::array<Scalar, Terms> const& coefficient) {
  using Pack = BasicPack<Scalar, Width>;
  constexpr std::size_t even_top = (Terms - 1) / 2 * 2;
  constexpr std::size_t odd_top = (Terms - 2) / 2 * 2 + 1;
  Packs<Scalar, Width, Count> squared;
  Packs<Scalar, Width, Count> even;
  Packs<Scalar, Width, Count> odd;
  for (std::size_t k = 0; k < Count; ++k) {
    squared[k] = x[k] * x[k];
    even[k] = Pack(coefficient[even_top]);
    odd[k] = Pack(coefficient[odd_top]);
  }
  for (std::size_t n = even_top; n >= 2; n -= 2) {
    for (std::size_t k = 0; k < Count; ++k) even[k] = even[k] * squared[k] + Pack(coefficient[n - 2]);
    if (n - 1 == odd_top) continue;
    for (std::size_t k = 0; k < Count; ++k) odd[k] = odd[k] * squared[k] + Pack(coefficient[n - 1]);
  }
  for (std::size_t k = 0; k < Count; ++k) even[k] = even[k] + x[k] * odd[k];
  return even;
}

/// above / below; below far from the ends of the range. One division serves all.
template <class Scalar, std::size_t Width, std::size_t Count>
[[gnu::always_inline]] inline Packs<Scalar, Width, Count> quotients(Packs<Scalar, Width, Count> const& above,
                                                                    Packs<Scalar, Width, Count> const& below) {
  static_assert(Count == 1 || Count == 2);
  if constexpr (Count == 1) {
    return {above[0] / below[0]};
  } else {
    auto const inverse = BasicPack<Scalar, Width>(Scalar(1)) / (below[0] * below[1]);
    return {above[0] * (inverse * below[1]), above[1] * (inverse * below[0])};
  }
}

/// Base-2 logarithm of (1 + t) / (1 - t) from sqrt(1/2) to sqrt(2), plus `whole`.
template <class Scalar, std::size_t Width, std::size_t Count>
[[gnu::always_inline]] inline Packs<Scalar, Width, Count> log2_of_quotient(Packs<Scalar, Width, Count> const& t,
                                                                           Packs<Scalar, Width, Count> const& whole) {
  constexpr auto coefficients = log_coefficients<Scalar>();
  Packs<Scalar, Width, Count> squared;
  for (std::size_t k = 0; k < Count; ++k) squared[k] = t[k] * t[k];
  auto sum = power_series(squared, coefficients);
  for (std::size_t k = 0; k < Count; ++k) sum[k] = whole[k] + t[k] * sum[k];
  return sum;
}

/// Base-2 logarithm of positive normal numbers 2^k m, m from sqrt(1/2) to sqrt(2).
template <class Scalar, std::size_t Width, std::size_t Count>
[[gnu::always_inline]] inline Packs<Scalar, Width, Count> log2_of_positive(Packs<Scalar, Width, Count> const& x) {
  using Pack = BasicPack<Scalar, Width>;
  using Layout = FloatBits<Scalar>;
  using Unsigned = typename Layout::Unsigned;
  using Bits = VectorOf<Unsigned, Width>;
  constexpr Unsigned min_mantissa = std::bit_cast<Unsigned>(static_cast<Scalar>(1.0 / std::numbers::sqrt2));
  constexpr Unsigned shift = Unsigned(1) << (std::numeric_limits<Unsigned>::digits - Layout::mantissa - 2);
  constexpr Unsigned one = std::bit_cast<Unsigned>(static_cast<Scalar>(Unsigned(1) << Layout::mantissa));
  Packs<Scalar, Width, Count> whole;
  Packs<Scalar, Width, Count> above;
  Packs<Scalar, Width, Count> below;
  for (std::size_t k = 0; k < Count; ++k) {
    Bits const bits = reinterpret_cast<Bits>(x[k].vector);
    Bits const shifted = (bits - min_mantissa + (shift << Layout::mantissa)) >> Layout::mantissa;  // k + shift
    Pack const m(reinterpret_cast<typename Pack::Vector>(bits - ((shifted - shift) << Layout::mantissa)));
    whole[k] = Pack(reinterpret_cast<typename Pack::Vector>(shifted | one)) -
               Pack(static_cast<Scalar>(Unsigned(1) << Layout::mantissa) + static_cast<Scalar>(shift));
    above[k] = m - Pack(Scalar(1));
    below[k] = m + Pack(Scalar(1));
  }
  return log2_of_quotient(quotients(above, below), whole);
}

/// 2^x by a polynomial in the distance of x from a whole number.
template <class Scalar, std::size_t Width, std::size_t Count>
[[gnu::always_inline]] inline Packs<Scalar, Width, Count> exp2(Packs<Scalar, Width, Count> const& x) {
  using Pack = BasicPack<Scalar, Width>;
  using Layout = FloatBits<Scalar>;
  using Unsigned = typename Layout::Unsigned;
  using Bits = VectorOf<Unsigned, Width>;
  constexpr auto coefficients = exp_coefficients<Scalar>(1.0L);
  Packs<Scalar, Width, Count> shifted;
  Packs<Scalar, Width, Count> part;
  for (std::size_t k = 0; k < Count; ++k) {
    Pack const bounded =
        max(min(x[k], Pack(static_cast<Scalar>(Layout::largest))), Pack(static_cast<Scalar>(-Layout::largest)));
    shifted[k] = bounded + Pack(Layout::to_whole);
    part[k] = bounded - (shifted[k] - Pack(Layout::to_whole));
  }
  auto sum = power_series(part, coefficients);
  for (std::size_t k = 0; k < Count; ++k) {
    Bits const whole = reinterpret_cast<Bits>(shifted[k].vector) - std::bit_cast<Unsigned>(Layout::to_whole);
    sum[k] = Pack(
        reinterpret_cast<typename Pack::Vector>(reinterpret_cast<Bits>(sum[k].vector) + (whole << Layout::mantissa)));
  }
  return sum;
}

}  // namespace detail

/// base^exponent of positive normal numbers, all lanes at once; of other bases, not-a-number too, any number. The
/// relative error is below 5e-16 (1 + |ln result|) in double, 3e-7 (1 + |ln result|) in float; results below 2^-1021 or
/// above 2^1021 become these (2^-125, 2^125 in float). Two packs side by side cost little more than one.
template <class Scalar, std::size_t Width, std::size_t Count>
[[gnu::always_inline]] inline std::array<BasicPack<Scalar, Width>, Count> positive_powers(
    std::array<BasicPack<Scalar, Width>, Count> const& base,
    std::array<BasicPack<Scalar, Width>, Count> const& exponent) {
  auto logarithm = detail::log2_of_positive(base);
  for (std::size_t k = 0; k < Count; ++k) logarithm[k] *= exponent[k];
  return detail::exp2(logarithm);
}

/// The same of bases from 1 to 2 and exponents from 0 to 1, which have no whole powers of two to part off.
template <class Scalar, std::size_t Width, std::size_t Count>
[[gnu::always_inline]] inline std::array<BasicPack<Scalar, Width>, Count> small_powers(
    std::array<BasicPack<Scalar, Width>, Count> const& base,
    std::array<BasicPack<Scalar, Width>, Count> const& exponent) {
  using Pack = BasicPack<Scalar, Width>;
  constexpr auto coefficients = detail::exp_coefficients<Scalar>(std::numbers::sqrt2_v<long double>);
  Pack const half(static_cast<Scalar>(0.5));
  Pack const middle(static_cast<Scalar>(std::numbers::sqrt2));
  detail::Packs<Scalar, Width, Count> whole;
  detail::Packs<Scalar, Width, Count> above;
  detail::Packs<Scalar, Width, Count> below;
  for (std::size_t k = 0; k < Count; ++k) {
    whole[k] = half;
    above[k] = base[k] - middle;
    below[k] = base[k] + middle;
  }
  auto logarithm = detail::log2_of_quotient(detail::quotients(above, below), whole);
  for (std::size_t k = 0; k < Count; ++k) logarithm[k] = logarithm[k] * exponent[k] - half;
  return detail::power_series(logarithm, coefficients);
}

/// base^exponent of positive normal numbers, with the errors of `positive_powers`.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> positive_power(BasicPack<Scalar, Width> const& base,
                                                                      BasicPack<Scalar, Width> const& exponent) {
  return positive_powers<Scalar, Width, 1>({base}, {exponent})[0];
}

/// base^exponent of a single number by std::pow.
template <class Scalar>
  requires std::is_floating_point_v<Scalar>
constexpr Scalar positive_power(Scalar base, Scalar exponent) { return std::pow(base, exponent); }
/// base^exponent of single numbers by std::pow, one after another.
template <class Scalar, std::size_t Count>
  requires std::is_floating_point_v<Scalar>
constexpr std::array<Scalar, Count> positive_powers(std::array<Scalar, Count> const& base,
                                                    std::array<Scalar, Count> const& exponent) {
  std::array<Scalar, Count> powers;
  for (std::size_t k = 0; k < Count; ++k) powers[k] = std::pow(base[k], exponent[k]);
  return powers;
}
/// base^exponent of single numbers by std::pow, one after another; the narrow range that packs need is not used.
template <class Scalar, std::size_t Count>
  requires std::is_floating_point_v<Scalar>
constexpr std::array<Scalar, Count> small_powers(std::array<Scalar, Count> const& base,
                                                 std::array<Scalar, Count> const& exponent) {
  return positive_powers(base, exponent);
}

}  // namespace scarp::lanes
