// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp {

/// A packing in the mirror across the plane with this normal, x -> -x if none is given, with its contacts' memory. It
/// responds to a mirrored strain with the mirrored stress: across an axis bit by bit, until lists of pairs are made
/// anew, whose order is another, or a grain at rest is met, whose +0 damping treats as forwards; across another plane
/// as far as the damping, which acts on components, allows. Where a packing is by accident stiffer to one side, its
/// image is stiffer to the other. normal: of length 1. For spheres, and for plane shapes that are symmetric about the
/// axis of their orientation; the image of a clump is another clump.
/// \throws InputError for a normal of another length
template <class PackingType>
  requires((PackingType::dim == 2 || PackingType::Shape::orientation_count == 0) &&
           part_count<typename PackingType::Shape>() == 1)
PackingType mirrored(PackingType packing, Vector<PackingType::dim> const& normal = Vector<PackingType::dim>::UnitX()) {
  using Shape = typename PackingType::Shape;
  using Law = typename PackingType::Law;
  constexpr int dim = PackingType::dim;
  if (!(std::abs(normal.norm() - 1.0) <= 1e-9))
    reject("the normal of a mirror has a length of {} (1 is expected): divide by it", normal.norm());
  Tensor<dim> const mirror = reflection<dim>(normal);
  auto const map = [&](auto& columns, double sign, std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
      Vector<dim> image = Vector<dim>::Constant(-0.0);  // which leaves the sign of a zero that is added
      for (int a = 0; a < dim; ++a) {
        for (int b = 0; b < dim; ++b) {
          if (mirror(a, b) != 0.0) image(a) += sign * mirror(a, b) * static_cast<double>(columns(row, b));
        }
      }
      for (int a = 0; a < dim; ++a)
        columns(row, a) = static_cast<std::remove_cvref_t<decltype(columns(row, a))>>(image(a));
    }
  };
  auto const negate = [](auto& columns, std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) columns(row, 0) = -columns(row, 0);
  };
  // Spins and moments are axial: what turns about the normal itself stays.
  auto const map_axial = [&](auto& columns, std::size_t rows) {
    if constexpr (dim == 2) {
      negate(columns, rows);
    } else {
      map(columns, -1.0, rows);
    }
  };
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  packing.cell = (mirror * packing.cell).eval();
  packing.cell.col(axis) = (-packing.cell.col(axis)).eval();  // the same lattice, right-handed again
  packing.last_move.gradient = (mirror * packing.last_move.gradient * mirror).eval();
  std::size_t const grains = packing.grain_count();
  map(packing.position, 1.0, grains);
  map(packing.velocity, 1.0, grains);
  map_axial(packing.spin, grains);
  if constexpr (Shape::orientation_count == 2) map(packing.orientation, 1.0, grains);
  auto& pairs = packing.pairs;
  if constexpr (Shape::warm_starts_normal) map(pairs.normal, 1.0, pairs.count());
  if constexpr (Law::inputs.shear) {
    if constexpr (dim == 2) {
      negate(pairs.shear, pairs.count());
    } else {
      map(pairs.shear, 1.0, pairs.count());
    }
  }
  if constexpr (Law::inputs.moment) map_axial(pairs.moment, pairs.count());
  for (auto& shift : pairs.ghost_shift)
    shift[detail::index(axis)] = static_cast<std::int8_t>(-shift[detail::index(axis)]);
  return packing;
}

}  // namespace scarp
