// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "scarp/core/mask.hpp"

namespace scarp::lanes {

/// Types whose every value a pack of such scalars holds unchanged; plain integers are let in for the sake of `2 * pack`.
template <class Number, class Scalar>
concept FitsInto = std::same_as<Number, int> || std::same_as<Number, Scalar> ||
    (std::same_as<Number, float>&& std::same_as<Scalar, double>);

/// Scalars side by side in the compiler's own vector; laws and shapes accept it in place of one. The width is part of the
/// type, because sources for different instruction sets may be linked together.
template <class Scalar, std::size_t Width>
struct BasicPack {
  using value_type = Scalar;
  using Vector = VectorOf<Scalar, Width>;
  using Mask = BasicMask<Scalar, Width>;

  Vector vector;

  /// One scalar of a pack that may be assigned to.
  class Lane {
   public:
    [[gnu::always_inline]] Lane(BasicPack& pack, std::size_t lane) : pack_(pack), lane_(lane) {}
    Lane(Lane const&) = default;
    [[gnu::always_inline]] operator Scalar() const { return pack_.vector[lane_]; }
    [[gnu::always_inline]] Lane& operator=(Scalar value) {
      pack_.vector[lane_] = value;
      return *this;
    }
    [[gnu::always_inline]] Lane& operator=(Lane const& other) { return *this = Scalar(other); }

   private:
    BasicPack& pack_;
    std::size_t lane_;
  };

  static constexpr std::size_t size() { return Width; }

  BasicPack() = default;
  [[gnu::always_inline]] explicit BasicPack(Vector const& lanes) : vector(lanes) {}
  /// The same number in every lane.
  template <FitsInto<Scalar> Number>
  [[gnu::always_inline]] BasicPack(Number number)
      : vector(filled(static_cast<Scalar>(number), std::make_index_sequence<Width>())) {}
  /// generator(lane) in each lane, whose number is a constant that converts to std::size_t.
  template <class Generator>
    requires std::is_invocable_r_v<Scalar, Generator&, std::integral_constant<std::size_t, 0>>
  [[gnu::always_inline]] explicit BasicPack(Generator&& generator)
      : vector(generated(generator, std::make_index_sequence<Width>())) {}

  [[gnu::always_inline]] Scalar operator[](std::size_t lane) const { return vector[lane]; }
  [[gnu::always_inline]] Lane operator[](std::size_t lane) { return {*this, lane}; }

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
  template <class Generator, std::size_t... Lanes>
  [[gnu::always_inline]] static Vector generated(Generator& generator, std::index_sequence<Lanes...>) {
    return Vector{static_cast<Scalar>(generator(std::integral_constant<std::size_t, Lanes>()))...};
  }
};

/// As many scalars as one vector register of the target holds, at most eight: rows of more lanes cannot be read as quads.
template <class Scalar>
inline constexpr std::size_t lane_count = register_bytes / sizeof(Scalar) < 8 ? register_bytes / sizeof(Scalar) : 8;

template <class Scalar>
using Pack = BasicPack<Scalar, lane_count<Scalar>>;

/// From and to any address of a scalar.
template <class Scalar, std::size_t Width = lane_count<Scalar>>
[[gnu::always_inline]] inline BasicPack<Scalar, Width> load(Scalar const* from) {
  BasicPack<Scalar, Width> values;
  std::memcpy(&values.vector, from, sizeof(values.vector));
  return values;
}
template <class Scalar, std::size_t Width>
[[gnu::always_inline]] inline void store(BasicPack<Scalar, Width> const& values, Scalar* to) {
  std::memcpy(to, &values.vector, sizeof(values.vector));
}

}  // namespace scarp::lanes

#include "scarp/core/pack_math.hpp"
