// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "scarp/dem/block/block_state.hpp"
#include "scarp/dem/block/small_tensor.hpp"
#include "scarp/dem/grain_view.hpp"
#include "scarp/dem/neighbour_list.hpp"

namespace scarp {

/// Numbers that a packing's grains and pairs have in a block.
template <class PackingType>
using BlockTypesOf = BlockTypes<typename PackingType::Shape, typename PackingType::Law, typename PackingType::Scalar>;

namespace detail {

template <int Dim>
SmallTensor<Dim> row_by_row(Tensor<Dim> const& tensor) {
  SmallTensor<Dim> rows{};
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) rows[index(a * Dim + b)] = tensor(a, b);
  }
  return rows;
}
template <int Dim>
Tensor<Dim> as_tensor(SmallTensor<Dim> const& rows) {
  Tensor<Dim> tensor;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) tensor(a, b) = rows[index(a * Dim + b)];
  }
  return tensor;
}

/// Calls visit(number, column) for the columns of a pair list's memory: shear, moment, scalars.
template <class Pairs, class Visit>
void each_memory_column(Pairs& pairs, Visit const& visit) {
  int number = 0;
  auto const of = [&](auto& columns) {
    constexpr int count = static_cast<int>(std::tuple_size_v<decltype(columns.row(0))>);
    if constexpr (count > 0) {
      for (int k = 0; k < count; ++k) visit(number++, columns.column(k));
    }
  };
  of(pairs.shear);
  of(pairs.moment);
  of(pairs.scalars);
}

/// Number of a grain's image by the cells between both.
template <class Shift>
int image_code(Shift const& shift) {
  int code = 0;
  for (std::size_t a = shift.size(); a-- > 0;) code = 3 * code + shift[a] + 1;
  return code;
}

}  // namespace detail

/// Writes a packing into a state. Pairs are sorted by their grains, so that a block's threads read side by side, and a
/// state that was a packing in between has the same list.
template <class PackingType>
void to_block(PackingType const& packing, BlockState<BlockTypesOf<PackingType>> const& state) {
  using Types = BlockTypesOf<PackingType>;
  constexpr int dim = PackingType::dim;
  auto const& pairs = packing.pairs;
  auto& header = *state.header;
  header = {};
  header.cell = detail::row_by_row<dim>(packing.cell);
  header.gradient = detail::row_by_row<dim>(packing.last_move.gradient);
  header.duration = packing.last_move.duration;
  header.applied = packing.last_move.applied ? 1 : 0;
  header.drift = pairs.drift;
  header.skin = pairs.skin;
  header.reach = pairs.basis.reach;
  header.critical_step = pairs.critical_step;
  header.grains = static_cast<std::int32_t>(packing.grain_count());
  header.pairs = static_cast<std::int32_t>(pairs.count());
  auto const columns = [&](auto const& from, int count, auto* to) {
    for (int k = 0; k < count; ++k) std::copy_n(from.column(k), packing.grain_count(), to + k * state.size.grains);
  };
  columns(packing.position, dim, state.position);
  columns(packing.velocity, dim, state.velocity);
  columns(packing.spin, Types::turns, state.spin);
  if constexpr (Types::axes > 0) columns(packing.orientation, Types::axes, state.orientation);
  struct Named {
    std::int32_t first;
    std::int32_t second;
    int image;
    std::size_t from;
    auto operator<=>(Named const&) const = default;
  };
  std::vector<Named> named;
  std::size_t const rows = packing.row_count();
  for (std::size_t p = 0; p < pairs.count(); ++p) {
    Named name{pairs.first[p], pairs.second[p], Types::no_shift, p};
    if (auto const row = detail::index(pairs.second[p]); row >= rows) {
      name.second = pairs.ghost_owner[row - rows];
      name.image = detail::image_code(pairs.ghost_shift[row - rows]);
    }
    named.push_back(name);
  }
  std::ranges::sort(named);
  auto const place = [&](int column, std::size_t p) { return detail::index(column * state.size.pairs) + p; };
  for (std::size_t p = 0; p < named.size(); ++p) {
    state.first[p] = static_cast<std::uint16_t>(named[p].first);
    state.second[p] = static_cast<std::uint16_t>(named[p].second);
    state.shift[p] = static_cast<std::uint8_t>(named[p].image);
    if constexpr (Types::normals > 0) {
      for (int k = 0; k < Types::normals; ++k) state.normal[place(k, p)] = pairs.normal(named[p].from, k);
    }
    detail::each_memory_column(pairs,
                               [&](int k, auto const* column) { state.memory[place(k, p)] = column[named[p].from]; });
  }
}

/// Reads a state into a packing, whose grains and basis of the list stay. Pairs are ordered as the loop over packs
/// wants them.
template <class PackingType>
void from_block(BlockState<BlockTypesOf<PackingType>> const& state, PackingType& packing) {
  using Types = BlockTypesOf<PackingType>;
  constexpr int dim = PackingType::dim;
  auto const& header = *state.header;
  packing.cell = detail::as_tensor<dim>(header.cell);
  packing.last_move = {detail::as_tensor<dim>(header.gradient), header.duration, header.applied != 0};
  auto const columns = [&](auto const* from, int count, auto& to) {
    for (int k = 0; k < count; ++k) std::copy_n(from + k * state.size.grains, packing.grain_count(), to.column(k));
  };
  columns(state.position, dim, packing.position);
  columns(state.velocity, dim, packing.velocity);
  columns(state.spin, Types::turns, packing.spin);
  if constexpr (Types::axes > 0) columns(state.orientation, Types::axes, packing.orientation);
  std::size_t const count = detail::index(header.pairs);
  std::vector<detail::NearPair<dim>> pairs(count);
  for (std::size_t p = 0; p < count; ++p) pairs[p] = {static_cast<std::int32_t>(p), 0, {}, nullptr};
  auto const woven = detail::interleaved(pairs);
  auto& list = packing.pairs;
  auto const basis = list.basis;
  list = {};
  list.basis = basis;
  list.drift = header.drift;
  list.skin = header.skin;
  list.critical_step = header.critical_step;
  list.first.resize(count);
  list.second.resize(count);
  list.normal.resize(count);
  list.shear.resize(count);
  list.moment.resize(count);
  list.scalars.resize(count);
  std::size_t const rows = packing.row_count();
  std::vector<std::int32_t> ghost(rows * Types::shifts, -1);
  auto const place = [&](int column, std::size_t p) { return detail::index(column * state.size.pairs) + p; };
  for (std::size_t p = 0; p < count; ++p) {
    auto const from = detail::index(woven[p].first);
    list.first[p] = state.first[from];
    list.second[p] = state.second[from];
    if (int code = state.shift[from]; code != Types::no_shift) {
      auto& number = ghost[state.second[from] * std::size_t{Types::shifts} + detail::index(code)];
      if (number < 0) {
        number = static_cast<std::int32_t>(rows + list.ghost_owner.size());
        list.ghost_owner.push_back(state.second[from]);
        typename std::remove_cvref_t<decltype(list)>::Shift shift{};
        for (auto& component : shift) {
          component = static_cast<std::int8_t>(code % 3 - 1);
          code /= 3;
        }
        list.ghost_shift.push_back(shift);
      }
      list.second[p] = number;
    }
    if constexpr (Types::normals > 0) {
      for (int k = 0; k < Types::normals; ++k) list.normal(p, k) = state.normal[place(k, from)];
    }
    detail::each_memory_column(list, [&](int k, auto* column) { column[p] = state.memory[place(k, from)]; });
  }
  if constexpr (Types::normals > 0) {  // lanes without a pair search along a unit vector
    for (std::size_t p = count; p < list.normal.padded_rows(); ++p)
      list.normal.column(0)[p] = typename Types::Scalar(1);
  }
}

/// What never changes of a population's grains, as blocks read it; valid as long as the population.
template <class Shape, class Law, class Scalar>
BlockGrains<BlockTypes<Shape, Law, Scalar>> block_grains(Population<Shape, Scalar> const& population) {
  return {.size = population.sizes().column(0),
          .inverse_mass = population.inverse_mass(),
          .inverse_inertia = population.inverse_inertia(),
          .bounding_radius = population.bounding_radii().data(),
          .stride = static_cast<int>(population.sizes().padded_rows()),
          .largest_radius = population.largest_radius(),
          .largest_eccentricity = population.largest_eccentricity(),
          .largest_normal_change = population.largest_normal_change(),
          .unique_minimum_depth = population.unique_minimum_depth()};
}

}  // namespace scarp
