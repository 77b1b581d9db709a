// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "scarp/dem/block/block_state.hpp"

namespace scarp {

/// Columns of equal length in the memory that a team shares.
template <class T, class Memory>
struct Columns {
  [[no_unique_address]] Memory memory;  ///< in which they lie
  int offset = 0;                       ///< [bytes]
  int stride = 0;                       ///< length of a column

  /// A number of a column.
  template <class K>
  SCARP_HOST_DEVICE constexpr T& operator()(K column, int row) const {
    return memory.template at<T>(offset)[static_cast<int>(column) * stride + row];
  }
  /// A number of the first column.
  SCARP_HOST_DEVICE constexpr T& operator[](int row) const { return memory.template at<T>(offset)[row]; }
};

/// Memory that the threads of a block share while they work. What a list is made with lies where the pairs' forces lie
/// afterwards.
/// \tparam Types a `BlockTypes`
/// \tparam Memory at<T>(offset [bytes]): where the arrays are
template <class Types, class Memory>
struct BlockBench {
  using Scalar = typename Types::Scalar;  ///< of coordinates and velocities
  template <class T>
  using Array = Columns<T, Memory>;  ///< numbers of grains or pairs

  int grains;                       ///< room for so many
  int pairs;                        ///< room for so many
  Array<Scalar> position{};         ///< of grains [m]
  Array<Scalar> velocity{};         ///< of grains [m/s]
  Array<Scalar> spin{};             ///< of grains [rad/s]
  Array<Scalar> pose{};             ///< of parts of grains
  Array<Scalar> normal{};           ///< of pairs
  Array<Scalar> memory{};           ///< of pairs
  Array<Scalar> offset{};           ///< of images: where they lie [m]
  Array<std::uint16_t> first{};     ///< of pairs
  Array<std::uint16_t> second{};    ///< of pairs
  Array<std::uint8_t> shift{};      ///< of pairs
  Array<std::uint16_t> incident{};  ///< pairs of a grain, twice their number, and one more where it is the second grain
  Array<int> begin{};               ///< of a grain's pairs in `incident`
  Array<int> count{};               ///< of each grain's pairs
  Array<int> unconverged{};         ///< touches whose normal was not found
  Array<Scalar> force{};            ///< of pairs: force, torque on the first, torque on the second
  Array<int> moved{};               ///< cells that a grain is moved by; before the new list
  Array<Scalar> new_normal{};       ///< of the new list's pairs
  Array<Scalar> new_memory{};       ///< of the new list's pairs
  Array<std::uint16_t> new_first{};   ///< of the new list's pairs
  Array<std::uint16_t> new_second{};  ///< of the new list's pairs
  Array<std::uint8_t> new_shift{};    ///< of the new list's pairs
  Array<std::uint16_t> bin{};         ///< of each grain
  Array<std::uint16_t> order{};       ///< grains by bins

  /// Arrays for so many grains and pairs.
  SCARP_HOST_DEVICE constexpr BlockBench(Memory shared, BlockSize size) : grains(size.grains), pairs(size.pairs) {
    int at = 0;
    auto const place = [&]<class T>(Array<T>& array, int columns, int stride) {
      array = {shared, at, stride};
      at += static_cast<int>(
          detail::laid_out_bytes(static_cast<std::size_t>(columns) * static_cast<std::size_t>(stride), sizeof(T)));
      end_ = at > end_ ? at : end_;
    };
    place(position, Types::dim, grains);
    place(velocity, Types::dim, grains);
    place(spin, Types::turns, grains);
    place(pose, Types::poses, grains * Types::parts);
    place(normal, Types::normals, pairs);
    place(memory, Types::memories, pairs);
    place(offset, Types::dim, Types::shifts);
    place(first, 1, pairs);
    place(second, 1, pairs);
    place(shift, 1, pairs);
    place(incident, 1, 2 * pairs);
    place(begin, 1, grains + 1);
    place(count, 1, grains + 1);
    place(unconverged, 1, 1);
    int const scratch = at;
    place(force, Types::forces, pairs);
    at = scratch;
    place(moved, Types::dim, grains);
    int const behind_moved = at;
    at = scratch;
    place(new_normal, Types::normals, pairs);
    place(new_memory, Types::memories, pairs);
    place(new_first, 1, pairs);
    place(new_second, 1, pairs);
    place(new_shift, 1, pairs);
    if (at < behind_moved) at = behind_moved;  // bins are written while others read where grains were moved
    place(bin, 1, grains);
    place(order, 1, grains);
  }

  /// Bytes of the memory that a team shares.
  static SCARP_HOST_DEVICE constexpr std::size_t bytes(BlockSize size) {
    return static_cast<std::size_t>(BlockBench(Memory{}, size).end_);
  }

 private:
  int end_ = 0;
};

}  // namespace scarp
