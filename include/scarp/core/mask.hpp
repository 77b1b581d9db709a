// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <utility>

#include "scarp/core/one_version.hpp"

namespace scarp::lanes {

/// Of one vector register of the instruction set that a source is compiled for.
inline constexpr std::size_t register_bytes = static_cast<std::size_t>(scarp::detail::bytes_of_register());

namespace detail {

template <class Scalar, std::size_t Width>
struct RawVector {
  static_assert(Width > 0 && (Width & (Width - 1)) == 0, "a vector has 1, 2, 4, 8, ... lanes");
  using type [[gnu::vector_size(Width * sizeof(Scalar))]] = Scalar;
};

}  // namespace detail

/// The compiler's own vector: it has arithmetic, comparisons and shuffles.
template <class Scalar, std::size_t Width>
using VectorOf = typename detail::RawVector<Scalar, Width>::type;

/// A yes or no for each lane of a pack: what comparisons of packs give.
template <class Scalar, std::size_t Width>
struct BasicMask {
  /// Integers of the scalar's size: all bits set for yes, none for no.
  using Vector = decltype(std::declval<VectorOf<Scalar, Width>>() < std::declval<VectorOf<Scalar, Width>>());

  Vector vector;

  static constexpr std::size_t size() { return Width; }

  BasicMask() = default;
  [[gnu::always_inline]] explicit BasicMask(Vector const& lanes) : vector(lanes) {}

  [[gnu::always_inline]] bool operator[](std::size_t lane) const { return vector[lane] != 0; }

  [[gnu::always_inline]] BasicMask operator!() const { return BasicMask(~vector); }
  [[gnu::always_inline]] friend BasicMask operator&&(BasicMask const& a, BasicMask const& b) {
    return BasicMask(a.vector & b.vector);
  }
  [[gnu::always_inline]] friend BasicMask operator||(BasicMask const& a, BasicMask const& b) {
    return BasicMask(a.vector | b.vector);
  }
};

template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline bool any_of(BasicMask<Scalar, Width> const& condition) {
  [[maybe_unused]] constexpr std::size_t bytes = Width * sizeof(Scalar);
  // The registers' own instruction collects the lanes' signs; compilers go lane by lane.
#if defined(__AVX__)
  if constexpr (bytes == 64) {
    using Half = typename BasicMask<Scalar, Width / 2>::Vector;
    Half halves[2];
    __builtin_memcpy(halves, &condition.vector, bytes);
    return any_of(BasicMask<Scalar, Width / 2>(halves[0] | halves[1]));
  }
  if constexpr (bytes == 32)
    return __builtin_ia32_movmskps256(reinterpret_cast<VectorOf<float, 8>>(condition.vector)) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (bytes == 16)
    return __builtin_ia32_movmskps(reinterpret_cast<VectorOf<float, 4>>(condition.vector)) != 0;
#endif
  auto found = condition.vector[0];
  for (std::size_t lane = 1; lane < Width; ++lane) found |= condition.vector[lane];
  return found != 0;
}
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline bool none_of(BasicMask<Scalar, Width> const& condition) {
  return !any_of(condition);
}
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline bool all_of(BasicMask<Scalar, Width> const& condition) {
  return !any_of(!condition);
}

// The same for the condition of a single number.
inline bool any_of(bool condition) { return condition; }
inline bool none_of(bool condition) { return !condition; }
inline bool all_of(bool condition) { return condition; }

}  // namespace scarp::lanes
