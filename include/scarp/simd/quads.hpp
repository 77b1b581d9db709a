// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "scarp/simd/pack.hpp"

namespace scarp::lanes {

/// A quad: four scalars that lie side by side, such as half a grain's row.
/// \tparam Scalar float or double
template <class Scalar>
struct FourScalars {
  using Vector = VectorOf<Scalar, 4>;  ///< the compiler's vector of four scalars

  Vector value;  ///< the four scalars in order

  /// From any address of a scalar.
  static FourScalars read(Scalar const* from) {
    FourScalars quad;
    std::memcpy(&quad.value, from, sizeof(Vector));
    return quad;
  }
  void write(Scalar* to) const { std::memcpy(to, &value, sizeof(Vector)); }  ///< To any address of a scalar.
};

namespace detail {

/// Transposes 4 x 4 blocks: entry j of block k of the result's vector i is entry i of block k of the argument's vector
/// j.
template <class Vector>
std::array<Vector, 4> transpose_blocks(std::array<Vector, 4> const& rows) {
  auto const& [a, b, c, d] = rows;
  if constexpr (sizeof(Vector) / sizeof(a[0]) == 4) {
    auto const ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    auto const ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    auto const cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    auto const cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    return {__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5), __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5),
            __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7), __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7)};
  } else {
    auto const ab_even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    auto const ab_odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    auto const cd_even = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    auto const cd_odd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(ab_even, cd_even, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(ab_even, cd_even, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 10, 11, 6, 7, 14, 15)};
  }
}

}  // namespace detail

/// One quad per lane, as four packs: pack c holds entry c of quad_of(lane). Where registers hold four or eight lanes
/// the quads are loaded whole and transposed in registers, with half the loads of a gather.
template <class Scalar, std::size_t Width = lane_count<Scalar>, class QuadOf>
std::array<BasicPack<Scalar, Width>, 4> from_quads(QuadOf const& quad_of) {
  std::array<BasicPack<Scalar, Width>, 4> packs;
  if constexpr (Width == 4 || Width == 8) {
    using Vector = VectorOf<Scalar, Width>;
    std::array<Vector, 4> rows;
    for (std::size_t j = 0; j < 4; ++j) {
      if constexpr (Width == 4) {
        rows[j] = quad_of(j).value;
      } else {
        rows[j] = __builtin_shufflevector(quad_of(j).value, quad_of(j + 4).value, 0, 1, 2, 3, 4, 5, 6, 7);
      }
    }
    auto const columns = detail::transpose_blocks(rows);
    for (std::size_t c = 0; c < 4; ++c) packs[c].vector = columns[c];
  } else {
    for (std::size_t lane = 0; lane < Width; ++lane) {
      auto const quad = quad_of(lane);
      for (std::size_t c = 0; c < 4; ++c) packs[c].vector[lane] = quad.value[c];
    }
  }
  return packs;
}

/// The reverse in registers: quad k holds lane k of the four packs.
template <class Scalar, std::size_t Width = lane_count<Scalar>>
std::array<FourScalars<Scalar>, Width> to_quads(std::array<BasicPack<Scalar, Width>, 4> const& packs) {
  std::array<FourScalars<Scalar>, Width> quads;
  if constexpr (Width == 4 || Width == 8) {
    using Vector = VectorOf<Scalar, Width>;
    std::array<Vector, 4> columns;
    for (std::size_t c = 0; c < 4; ++c) columns[c] = packs[c].vector;
    auto const rows = detail::transpose_blocks(columns);
    for (std::size_t j = 0; j < 4; ++j) {
      if constexpr (Width == 4) {
        quads[j].value = rows[j];
      } else {
        quads[j].value = __builtin_shufflevector(rows[j], rows[j], 0, 1, 2, 3);
        quads[j + 4].value = __builtin_shufflevector(rows[j], rows[j], 4, 5, 6, 7);
      }
    }
  } else {
    for (std::size_t lane = 0; lane < Width; ++lane) {
      for (std::size_t c = 0; c < 4; ++c) quads[lane].value[c] = packs[c][lane];
    }
  }
  return quads;
}

}  // namespace scarp::lanes
