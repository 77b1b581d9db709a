// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/dem/cell.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp::detail {

template <int Dim>
struct PlacedGrain {
  std::array<double, static_cast<std::size_t>(Dim)> place;
  std::int32_t owner;
  std::array<std::int8_t, static_cast<std::size_t>(Dim)> shift;
};

/// Grains followed by those of their images that a neighbour search needs; the functions are what nanoflann requires.
template <int Dim>
struct GrainsAndImages {
  std::vector<PlacedGrain<Dim>> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i].place[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Sign of the first component that is not zero: of a lattice vector and its opposite one is positive.
template <std::size_t Dim, class Integer>
int sign_of(std::array<Integer, Dim> const& shift) {
  for (auto component : shift) {
    if (component != 0) return component > 0 ? 1 : -1;
  }
  return 0;
}

/// Centres of all grains [m].
template <class PackingType>
std::vector<Vector<PackingType::dim>> grain_places(PackingType const& packing) {
  std::vector<Vector<PackingType::dim>> places(packing.grain_count());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (int a = 0; a < PackingType::dim; ++a) places[i](a) = static_cast<double>(packing.position(i, a));
  }
  return places;
}

/// How `reduce_and_wrap` has renamed images: each grain's cell in the new base vectors, and old shifts in new ones.
template <int Dim>
struct Renaming {
  using Cells = std::array<int, static_cast<std::size_t>(Dim)>;

  std::vector<Cells> moved;
  Tensor<Dim> old_to_new;
};

/// Cells away from the own one up to which a place still means something: round-off is there 1e-10 of a cell.
inline constexpr double furthest_cell = 1e6;

/// Reduces a cell and wraps places into it. \return false, with nothing done, for a place too many cells away
template <int Dim>
bool reduce_and_wrap(Tensor<Dim>& cell, std::vector<Vector<Dim>>& places, Renaming<Dim>& renaming) {
  Tensor<Dim> const change = lattice_reduction<Dim>(cell).template cast<double>();
  Tensor<Dim> const reduced = cell * change;
  Tensor<Dim> const inverse = reduced.inverse();
  renaming.moved.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    Vector<Dim> const cells = (inverse * places[i]).array().floor();
    if (!(cells.cwiseAbs().maxCoeff() <= furthest_cell)) return false;
    for (int a = 0; a < Dim; ++a) renaming.moved[i][detail::index(a)] = static_cast<int>(cells(a));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (renaming.moved[i] == typename Renaming<Dim>::Cells{}) continue;
    Vector<Dim> cells;
    for (int a = 0; a < Dim; ++a) cells(a) = renaming.moved[i][detail::index(a)];
    places[i] -= reduced * cells;
  }
  cell = reduced;
  renaming.old_to_new = change.inverse();
  return true;
}

/// Shift number `code` of the block of cells around the own one, each component -1, 0 or 1.
template <int Dim>
std::array<std::int8_t, static_cast<std::size_t>(Dim)> neighbour_shift(int code) {
  std::array<std::int8_t, static_cast<std::size_t>(Dim)> shift{};
  for (auto& component : shift) {
    component = static_cast<std::int8_t>(code % 3 - 1);
    code /= 3;
  }
  return shift;
}

/// All grains, then those of their images that lie within `reach` [m] of the cell, in the positive half of the lattice.
template <int Dim>
GrainsAndImages<Dim> grains_and_images(Tensor<Dim> const& cell, std::vector<Vector<Dim>> const& places, double reach) {
  GrainsAndImages<Dim> all;
  Tensor<Dim> const inverse = cell.inverse();
  Vector<Dim> margin;  // reach in lattice coordinates
  for (int a = 0; a < Dim; ++a) margin(a) = reach * inverse.row(a).norm();
  auto const add = [&](Vector<Dim> const& place, std::size_t owner, auto const& shift) {
    PlacedGrain<Dim> grain{{}, static_cast<std::int32_t>(owner), shift};
    for (int a = 0; a < Dim; ++a) grain.place[detail::index(a)] = place(a);
    all.points.push_back(grain);
  };
  for (std::size_t i = 0; i < places.size(); ++i) add(places[i], i, decltype(PlacedGrain<Dim>::shift){});
  int shifts = 1;
  for (int a = 0; a < Dim; ++a) shifts *= 3;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Vector<Dim> const fraction = inverse * places[i];
    for (int code = 0; code < shifts; ++code) {
      auto const shift = neighbour_shift<Dim>(code);
      if (sign_of(shift) <= 0) continue;
      bool near = true;
      Vector<Dim> steps;
      for (int a = 0; a < Dim; ++a) {
        steps(a) = shift[detail::index(a)];
        double const there = fraction(a) + steps(a);
        near = near && there > -margin(a) && there < 1.0 + margin(a);
      }
      if (near) add(places[i] + cell * steps, i, shift);
    }
  }
  return all;
}

}  // namespace scarp::detail
