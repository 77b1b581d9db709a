// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cassert>
#include <cstddef>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp {

/// A packing in the mirror that turns one axis round, x -> -x if none is named, with its contacts' memory. It responds to a
/// mirrored strain with the mirrored stress, bit by bit until lists of pairs are made anew, whose order is another, or a grain
/// at rest is met, whose +0 damping treats as forwards. Where a packing is by accident stiffer to one side, its image is stiffer to the
/// other. axis: 0 to dim - 1. For spheres, and for plane shapes that are symmetric about the axis of their orientation and the one across, as ellipses are;
/// the image of a clump is another clump.
template <class PackingType>
  requires((PackingType::dim == 2 || PackingType::Shape::orientation_count == 0) &&
           part_count<typename PackingType::Shape>() == 1)
PackingType mirrored(PackingType packing, int axis = 0) {
  using Shape = typename PackingType::Shape;
  using Law = typename PackingType::Law;
  constexpr int dim = PackingType::dim;
  assert(0 <= axis && axis < dim);
  auto const turn = [](auto& columns, int column, std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) columns(row, column) = -columns(row, column);
  };
  // Spins and moments are axial: what turns about the axis itself stays.
  auto const turn_axial = [&](auto& columns, std::size_t rows) {
    for (int column = 0; column < spin_size<dim>; ++column) {
      if (dim == 2 || column != axis) turn(columns, column, rows);
    }
  };
  Tensor<dim> mirror = Tensor<dim>::Identity();
  mirror(axis, axis) = -1.0;
  packing.cell = (mirror * packing.cell).eval();
  packing.cell.col(axis) = (-packing.cell.col(axis)).eval();  // the same lattice, right-handed again
  packing.last_move.gradient = (mirror * packing.last_move.gradient * mirror).eval();
  std::size_t const grains = packing.grain_count();
  turn(packing.position, axis, grains);
  turn(packing.velocity, axis, grains);
  turn_axial(packing.spin, grains);
  if constexpr (Shape::orientation_count == 2) turn(packing.orientation, 1, grains);
  auto& pairs = packing.pairs;
  if constexpr (Shape::warm_starts_normal) turn(pairs.normal, axis, pairs.count());
  if constexpr (Law::inputs.shear) turn(pairs.shear, dim == 2 ? 0 : axis, pairs.count());
  if constexpr (Law::inputs.moment) turn_axial(pairs.moment, pairs.count());
  for (auto& shift : pairs.ghost_shift)
    shift[detail::index(axis)] = static_cast<std::int8_t>(-shift[detail::index(axis)]);
  return packing;
}

}  // namespace scarp
