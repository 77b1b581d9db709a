// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/core/index.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/simd/quads.hpp"
#include "scarp/simd/soa_array.hpp"

namespace scarp {

/// Where a grain's data stand in its row: position, velocity, spin, pose of the part, where the law needs motion also
/// the inverse mass, padding. A pair's data then come from one or two cache lines each.
template <ParticleShape Shape, ContactLaw Law>
struct RowLayout {
  static constexpr auto axes = static_cast<std::size_t>(Shape::dim);              ///< numbers of a position
  static constexpr auto turns = static_cast<std::size_t>(spin_size<Shape::dim>);  ///< numbers of a spin
  static constexpr auto pose_size = static_cast<std::size_t>(Shape::pose_count);  ///< numbers of a pose

  static constexpr std::size_t velocity = axes;      ///< where the velocity begins
  static constexpr std::size_t spin = 2 * axes;      ///< where the spin begins
  static constexpr std::size_t pose = spin + turns;  ///< where the pose begins
  /// Where the inverse mass stands, if the law needs it.
  static constexpr std::size_t inverse_mass = pose + pose_size;
  static constexpr std::size_t used = inverse_mass + (Law::inputs.motion ? 1 : 0);  ///< numbers without padding
  static constexpr std::size_t size = (used + 3) / 4 * 4;  ///< numbers with padding, a multiple of four

  /// Row of forces: force and torque, in space each padded to four; in the plane the fourth entry is scratch.
  static constexpr std::size_t force_size = axes == 2 ? 4 : 8;
  static constexpr std::size_t torque = axes == 2 ? 2 : 4;  ///< where the torque begins in a row of forces
};

/// Scratch memory of the pair loop; one per thread, reused from call to call.
/// \tparam Scalar float or double
template <class Scalar>
struct PairScratch {
  AlignedVector<Scalar> rows;    ///< data of grains, ghosts and one row far from all
  AlignedVector<Scalar> forces;  ///< force [N] and torque [N m] of each row
};

/// Writes the rows of every part of every grain.
template <class PackingType>
void fill_grain_rows(PackingType const& packing, typename PackingType::Scalar* rows) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  using Layout = RowLayout<Shape, typename PackingType::Law>;
  using Lanes = lanes::Pack<Scalar>;
  constexpr auto parts = static_cast<std::size_t>(part_count<Shape>());
  auto const read = [](auto const& columns, std::size_t start, Lanes* to, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) to[k] = lanes::load(columns.column(static_cast<int>(k)) + start);
  };
  for (std::size_t start = 0; start < packing.position.padded_rows(); start += Lanes::size()) {
    std::array<Lanes, Layout::size> fields{};
    read(packing.position, start, fields.data(), Layout::axes);
    read(packing.velocity, start, fields.data() + Layout::velocity, Layout::axes);
    read(packing.spin, start, fields.data() + Layout::spin, Layout::turns);
    std::array<Lanes, static_cast<std::size_t>(Shape::size_count)> size;
    read(packing.population->sizes(), start, size.data(), size.size());
    std::array<Lanes, static_cast<std::size_t>(Shape::orientation_count)> orientation;
    if constexpr (Shape::orientation_count > 0)
      read(packing.orientation, start, orientation.data(), orientation.size());
    if constexpr (PackingType::Law::inputs.motion) {
      fields[Layout::inverse_mass] = lanes::load(packing.population->inverse_mass() + start);
    }
    for (std::size_t part = 0; part < parts; ++part) {
      auto const pose = part_pose<Shape>(size, orientation, static_cast<int>(part));
      for (std::size_t k = 0; k < pose.size(); ++k) fields[Layout::pose + k] = pose[k];
      for (std::size_t quad = 0; quad < Layout::size; quad += 4) {
        auto const quads =
            lanes::to_quads<Scalar>({fields[quad], fields[quad + 1], fields[quad + 2], fields[quad + 3]});
        for (std::size_t lane = 0; lane < quads.size(); ++lane)
          quads[lane].write(rows + ((start + lane) * parts + part) * Layout::size + quad);
      }
    }
  }
}

/// Writes the rows of ghosts behind those of the grains, and last one that is far from all: the partner of lanes
/// without a pair. \return number of the last row
template <class PackingType>
std::size_t fill_ghost_rows(PackingType const& packing, typename PackingType::Scalar* rows) {
  using Scalar = typename PackingType::Scalar;
  using Layout = RowLayout<typename PackingType::Shape, typename PackingType::Law>;
  constexpr int dim = PackingType::dim;
  auto const& pairs = packing.pairs;
  std::size_t const own = packing.row_count();
  for (std::size_t g = 0; g < pairs.ghost_owner.size(); ++g) {
    Scalar const* const owner = rows + detail::index(pairs.ghost_owner[g]) * Layout::size;
    Scalar* const row = rows + (own + g) * Layout::size;
    std::copy(owner, owner + Layout::size, row);
    for (int a = 0; a < dim; ++a) {
      double offset = 0.0;
      for (int b = 0; b < dim; ++b) offset += packing.cell(a, b) * pairs.ghost_shift[g][detail::index(b)];
      row[a] += static_cast<Scalar>(offset);
    }
  }
  std::size_t const sentinel_row = own + pairs.ghost_owner.size();
  std::copy(rows, rows + Layout::size, rows + sentinel_row * Layout::size);
  rows[sentinel_row * Layout::size] += static_cast<Scalar>(1e3 * packing.population->largest_radius());
  return sentinel_row;
}

/// Adds one row of forces to another.
template <class Layout, class Scalar>
void add_force_row(Scalar const* row, Scalar* to) {
  for (std::size_t quad = 0; quad < Layout::force_size; quad += 4) {
    auto sum = lanes::FourScalars<Scalar>::read(to + quad);
    sum.value += lanes::FourScalars<Scalar>::read(row + quad).value;
    sum.write(to + quad);
  }
}

/// Adds what ghosts and parts have received to their grains, whose rows of forces then come first.
template <class PackingType>
void gather_forces(PackingType const& packing, typename PackingType::Scalar* forces) {
  using Scalar = typename PackingType::Scalar;
  using Layout = RowLayout<typename PackingType::Shape, typename PackingType::Law>;
  constexpr auto parts = static_cast<std::size_t>(part_count<typename PackingType::Shape>());
  constexpr std::size_t size = Layout::force_size;
  auto const& owner = packing.pairs.ghost_owner;
  std::size_t const own = packing.row_count();
  for (std::size_t g = 0; g < owner.size(); ++g)
    add_force_row<Layout>(forces + (own + g) * size, forces + detail::index(owner[g]) * size);
  if constexpr (parts > 1) {
    for (std::size_t grain = 0; grain < packing.grain_count(); ++grain) {
      Scalar const* const first = forces + grain * parts * size;
      Scalar* const sum = forces + grain * size;
      if (grain > 0) std::copy(first, first + size, sum);
      for (std::size_t part = 1; part < parts; ++part) add_force_row<Layout>(first + part * size, sum);
    }
  }
}

}  // namespace scarp
