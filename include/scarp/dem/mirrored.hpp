// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <utility>

#include "scarp/dem/packing.hpp"

namespace scarp {

/// A packing in the mirror x -> -x, with all that its contacts remember. It answers a mirrored strain with the mirrored stress, bit
/// by bit until lists of pairs are made anew, whose order is another, or a grain that stood still is met, whose +0 damping takes
/// for forwards. Where a packing is stiffer by accident to one side, its image is to the other. For plane shapes that are
/// symmetric about the axis of their orientation and the one across, as ellipses are.
template <class PackingType>
PackingType mirrored(PackingType packing) {
  using Shape = typename PackingType::Shape;
  using Law = typename PackingType::Law;
  static_assert(PackingType::dim == 2 && part_count<Shape>() == 1,
                "scarp: only packings in the plane whose grains have one part can be mirrored: a clump's image is "
                "another clump");
  auto const turn = [](auto& columns, int column, std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) columns(row, column) = -columns(row, column);
  };
  Tensor<2> mirror = Tensor<2>::Identity();
  mirror(0, 0) = -1.0;
  packing.cell = (mirror * packing.cell).eval();
  packing.cell.col(0) = (-packing.cell.col(0)).eval();  // the same lattice, right-handed again
  packing.last_move.gradient = (mirror * packing.last_move.gradient * mirror).eval();
  std::size_t const grains = packing.grain_count();
  turn(packing.position, 0, grains);
  turn(packing.velocity, 0, grains);
  turn(packing.spin, 0, grains);
  if constexpr (Shape::orientation_count == 2) turn(packing.orientation, 1, grains);
  auto& pairs = packing.pairs;
  if constexpr (Shape::remembers_normal) turn(pairs.normal, 0, pairs.count());
  if constexpr (Law::needs.shear) turn(pairs.shear, 0, pairs.count());
  if constexpr (Law::needs.moment) turn(pairs.moment, 0, pairs.count());
  for (auto& shift : pairs.ghost_shift) shift[0] = static_cast<std::int8_t>(-shift[0]);
  return packing;
}

}  // namespace scarp
