// SPDX-License-Identifier: BSL-1.0
#pragma once

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <concepts>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "scarp/core/one_version.hpp"

namespace scarp {

/// The scalar that a pack has many of, or the scalar itself.
/// \tparam T a floating-point number or a `BasicPack`
template <class T>
struct ScalarOf {
  using type = T;  ///< a single number is its own scalar
};
/// Number type of a lane of a pack.
template <class T>
  requires requires { typename T::value_type; }
struct ScalarOf<T> {
  using type = typename T::value_type;  ///< of a pack's lane
};

/// A number as scalar type T; a pack gets it in every lane, rounded to the pack's precision.
template <class T>
constexpr T broadcast(double value) {
  return T(static_cast<typename ScalarOf<T>::type>(value));
}

/// The smallest normal number: as a floor of divisors it prevents 0/0 in any system of units.
template <class T>
constexpr T smallest_normal() {
  return T(std::numeric_limits<typename ScalarOf<T>::type>::min());
}

}  // namespace scarp

namespace scarp::lanes {

/// Size of one vector register of the instruction set that a source is compiled for.
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
/// \tparam Scalar float or double, of which comparisons are made
/// \tparam Width number of lanes, a power of two
template <class Scalar, std::size_t Width>
struct BasicMask {
  /// Integers of the scalar's size: all bits set for yes, none for no.
  using Vector = decltype(std::declval<VectorOf<Scalar, Width>>() < std::declval<VectorOf<Scalar, Width>>());

  Vector vector;  ///< one integer for each lane

  static constexpr std::size_t size() { return Width; }  ///< Number of lanes.

  BasicMask() = default;
  /// From integers that have all bits set for yes, none for no.
  [[gnu::always_inline]] explicit BasicMask(Vector const& lanes) : vector(lanes) {}

  /// Whether the condition holds in one lane.
  [[gnu::always_inline]] bool operator[](std::size_t lane) const { return vector[lane] != 0; }

  [[gnu::always_inline]] BasicMask operator!() const { return BasicMask(~vector); }
  [[gnu::always_inline]] friend BasicMask operator&&(BasicMask const& a, BasicMask const& b) {
    return BasicMask(a.vector & b.vector);
  }
  [[gnu::always_inline]] friend BasicMask operator||(BasicMask const& a, BasicMask const& b) {
    return BasicMask(a.vector | b.vector);
  }
};

/// Whether the condition holds in at least one lane.
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
  if constexpr (bytes == 32) return _mm256_movemask_ps(__builtin_bit_cast(__m256, condition.vector)) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (bytes == 16) return _mm_movemask_ps(__builtin_bit_cast(__m128, condition.vector)) != 0;
#endif
  auto found = condition.vector[0];
  for (std::size_t lane = 1; lane < Width; ++lane) found |= condition.vector[lane];
  return found != 0;
}
/// Whether the condition holds in no lane.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline bool none_of(BasicMask<Scalar, Width> const& condition) {
  return !any_of(condition);
}
/// Whether the condition holds in every lane.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline bool all_of(BasicMask<Scalar, Width> const& condition) {
  return !any_of(!condition);
}

constexpr bool any_of(bool condition) { return condition; }    ///< The condition of a single number.
constexpr bool none_of(bool condition) { return !condition; }  ///< Whether the condition of a single number fails.
constexpr bool all_of(bool condition) { return condition; }    ///< The condition of a single number.

/// Types whose every value a pack of such scalars holds unchanged; plain integers are let in for the sake of
/// `2 * pack`.
template <class Number, class Scalar>
concept FitsInto = std::same_as<Number, int> || std::same_as<Number, Scalar> ||
    (std::same_as<Number, float>&& std::same_as<Scalar, double>);

/// Scalars side by side in the compiler's own vector; laws and shapes accept it in place of one. The width is part of
/// the type, because sources for different instruction sets may be linked together.
/// \tparam Scalar float or double
/// \tparam Width number of lanes, a power of two
template <class Scalar, std::size_t Width>
struct BasicPack {
  using value_type = Scalar;               ///< of one lane
  using Vector = VectorOf<Scalar, Width>;  ///< the compiler's vector behind a pack
  using Mask = BasicMask<Scalar, Width>;   ///< result of a comparison

  Vector vector;  ///< one scalar for each lane

  static constexpr std::size_t size() { return Width; }  ///< Number of lanes.

  BasicPack() = default;
  [[gnu::always_inline]] explicit BasicPack(Vector const& lanes) : vector(lanes) {}  ///< From the compiler's vector.
  /// The same number in every lane; a double is rounded to lanes of single precision where that is requested, by
  /// `T(0.1)`.
  template <class Number>
    requires(FitsInto<Number, Scalar> || std::same_as<Number, double>)
  [[gnu::always_inline]] explicit(!FitsInto<Number, Scalar>) BasicPack(Number number)
      : vector(filled(static_cast<Scalar>(number), std::make_index_sequence<Width>())) {}
  /// Value of one lane, counted from zero; `vector[lane]` may be assigned to.
  [[gnu::always_inline]] Scalar operator[](std::size_t lane) const { return vector[lane]; }

  [[gnu::always_inline]] BasicPack operator+() const { return *this; }
  [[gnu::always_inline]] BasicPack operator-() const { return BasicPack(-vector); }

  [[gnu::always_inline]] friend BasicPack operator+(BasicPack const& a, BasicPack const& b) {
    return BasicPack(a.vector + b.vector);
  }
  [[gnu::always_inline]] friend BasicPack operator-(BasicPack const& a, BasicPack const& b) {
    return BasicPack(a.vector - b.vector);
  }
  [[gnu::always_inline]] friend BasicPack operator*(BasicPack const& a, BasicPack const& b) {
    return BasicPack(a.vector * b.vector);
  }
  [[gnu::always_inline]] friend BasicPack operator/(BasicPack const& a, BasicPack const& b) {
    return BasicPack(a.vector / b.vector);
  }
  [[gnu::always_inline]] BasicPack& operator+=(BasicPack const& other) { return *this = *this + other; }
  [[gnu::always_inline]] BasicPack& operator-=(BasicPack const& other) { return *this = *this - other; }
  [[gnu::always_inline]] BasicPack& operator*=(BasicPack const& other) { return *this = *this * other; }
  [[gnu::always_inline]] BasicPack& operator/=(BasicPack const& other) { return *this = *this / other; }

  [[gnu::always_inline]] friend Mask operator==(BasicPack const& a, BasicPack const& b) {
    return Mask(a.vector == b.vector);
  }
  [[gnu::always_inline]] friend Mask operator!=(BasicPack const& a, BasicPack const& b) {
    return Mask(a.vector != b.vector);
  }
  [[gnu::always_inline]] friend Mask operator<(BasicPack const& a, BasicPack const& b) {
    return Mask(a.vector < b.vector);
  }
  [[gnu::always_inline]] friend Mask operator<=(BasicPack const& a, BasicPack const& b) {
    return Mask(a.vector <= b.vector);
  }
  [[gnu::always_inline]] friend Mask operator>(BasicPack const& a, BasicPack const& b) {
    return Mask(a.vector > b.vector);
  }
  [[gnu::always_inline]] friend Mask operator>=(BasicPack const& a, BasicPack const& b) {
    return Mask(a.vector >= b.vector);
  }

 private:
  template <std::size_t... Lanes>
  [[gnu::always_inline]] static Vector filled(Scalar value, std::index_sequence<Lanes...>) {
    return Vector{(static_cast<void>(Lanes), value)...};
  }
};

/// As many scalars as one vector register of the target holds, at most eight: rows of more lanes cannot be read as
/// quads.
template <class Scalar>
inline constexpr std::size_t lane_count = register_bytes / sizeof(Scalar) < 8 ? register_bytes / sizeof(Scalar) : 8;

template <class Scalar>
using Pack = BasicPack<Scalar, lane_count<Scalar>>;  ///< Pack that fills one vector register, eight lanes at most.

/// From and to any address of a scalar.
template <class Scalar, std::size_t Width = lane_count<Scalar>>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> load(Scalar const* from) {
  BasicPack<Scalar, Width> values;
  std::memcpy(&values.vector, from, sizeof(values.vector));
  return values;
}
/// To any address of a scalar: lanes side by side, without alignment.
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline void store(BasicPack<Scalar, Width> const& values, Scalar* to) {
  std::memcpy(to, &values.vector, sizeof(values.vector));
}

}  // namespace scarp::lanes

#include "scarp/simd/pack_math.hpp"
