// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>

#include "scarp/simd/pack.hpp"

namespace scarp::lanes {

/// A square root and its inverse.
/// \tparam T a floating-point number or a `BasicPack`
template <class T>
struct SquareRoot {
  T value;    ///< \f$ \sqrt{x} \f$
  T inverse;  ///< \f$ 1/\sqrt{x} \f$
};

/// Square roots of two positive numbers, or of packs of them; infinities and zeros are not among them. They share a
/// division.
template <class T>
[[gnu::always_inline]] inline constexpr std::array<SquareRoot<T>, 2> square_roots(T const& a, T const& b) {
#if defined(__CUDA_ARCH__) && !defined(SCARP_DEVICE_IEEE)
  // By the device's own inverse root, whose error is an epsilon: a root or a division would take as long again.
  if constexpr (std::is_floating_point_v<T>) {
    T const inverse_a = ::rsqrt(a);
    T const inverse_b = ::rsqrt(b);
    return {SquareRoot<T>{a * inverse_a, inverse_a}, SquareRoot<T>{b * inverse_b, inverse_b}};
  }
#endif
  using std::sqrt;
  T const root_a = sqrt(a);
  T const root_b = sqrt(b);
  T const inverse = broadcast<T>(1) / (root_a * root_b);
  return {SquareRoot<T>{root_a, inverse * root_b}, SquareRoot<T>{root_b, inverse * root_a}};
}

#if defined(__AVX512VL__)
/// The same without roots and divisions, whose unit would be what others wait for: from the processor's own estimate of
/// the inverse, which errs by 2^-14 at most, by a series in \f$ e = 1 - x y^2 \f$. Relative errors are below two
/// epsilons.
template <class Scalar>
[[gnu::always_inline]] inline std::array<SquareRoot<BasicPack<Scalar, 8>>, 2> square_roots(
    BasicPack<Scalar, 8> const& a, BasicPack<Scalar, 8> const& b) {
  using T = BasicPack<Scalar, 8>;
  constexpr bool is_double = sizeof(Scalar) == 8;
  auto const root = [](T const& x) {
    T estimate;
    if constexpr (is_double) {
      estimate.vector = _mm512_rsqrt14_pd(x.vector);
    } else {
      estimate.vector = _mm256_rsqrt14_ps(x.vector);
    }
    T const product = x * estimate;
    T const e = broadcast<T>(1) - product * estimate;
    T series = broadcast<T>(0.5);
    if constexpr (is_double) series = series + e * (broadcast<T>(0.375) + e * broadcast<T>(0.3125));
    return SquareRoot<T>{product + product * (e * series), estimate + estimate * (e * series)};
  };
  return {root(a), root(b)};
}
#endif

}  // namespace scarp::lanes
