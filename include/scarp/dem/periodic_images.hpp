// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scarp/dem/cell.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp::detail {

template <int Dim>
struct PlacedGrain {
  std::array<double, static_cast<std::size_t>(Dim)> place;
  std::int32_t owner;
  std::array<std::int8_t, static_cast<std::size_t>(Dim)> shift;
};

/// Grains followed by those of their images that a neighbour search needs; the functions are what nanoflann asks for.
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

/// How `reduce_and_wrap` has renamed images: each grain's cell in the new base vectors, and old shifts in new ones.
template <int Dim>
struct Renaming {
  std::vector<std::array<int, static_cast<std::size_t>(Dim)>> moved;
  Tensor<Dim> old_to_new;
};

/// Wraps positions into a reduced cell.
template <class PackingType>
Renaming<PackingType::dim> reduce_and_wrap(PackingType& packing) {
  constexpr int dim = PackingType::dim;
  using Scalar = typename PackingType::Scalar;
  Renaming<dim> renaming;
  Eigen::Matrix<int, dim, dim> const change = lattice_reduction<dim>(packing.cell);
  renaming.old_to_new = change.template cast<double>().inverse();
  packing.cell = (packing.cell * change.template cast<double>()).eval();
  Tensor<dim> const inverse = packing.cell.inverse();
  renaming.moved.resize(packing.grain_count());
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    Vector<dim> place;
    for (int a = 0; a < dim; ++a) place(a) = static_cast<double>(packing.position(i, a));
    Vector<dim> const cells = (inverse * place).array().floor();
    for (int a = 0; a < dim; ++a) renaming.moved[i][static_cast<std::size_t>(a)] = static_cast<int>(cells(a));
    if (cells.squaredNorm() == 0.0) continue;
    place -= packing.cell * cells;
    for (int a = 0; a < dim; ++a) packing.position(i, a) = static_cast<Scalar>(place(a));
  }
  return renaming;
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
template <class PackingType>
GrainsAndImages<PackingType::dim> grains_and_images(PackingType const& packing, double reach) {
  constexpr int dim = PackingType::dim;
  std::size_t const grains = packing.grain_count();
  GrainsAndImages<dim> all;
  Tensor<dim> const inverse = packing.cell.inverse();
  Vector<dim> margin;  // reach in lattice coordinates
  for (int a = 0; a < dim; ++a) margin(a) = reach * inverse.row(a).norm();
  for (std::size_t i = 0; i < grains; ++i) {
    PlacedGrain<dim> grain{{}, static_cast<std::int32_t>(i), {}};
    for (int a = 0; a < dim; ++a)
      grain.place[static_cast<std::size_t>(a)] = static_cast<double>(packing.position(i, a));
    all.points.push_back(grain);
  }
  int shifts = 1;
  for (int a = 0; a < dim; ++a) shifts *= 3;
  for (std::size_t i = 0; i < grains; ++i) {
    Vector<dim> place;
    for (int a = 0; a < dim; ++a) place(a) = all.points[i].place[static_cast<std::size_t>(a)];
    Vector<dim> const fraction = inverse * place;
    for (int code = 0; code < shifts; ++code) {
      auto const shift = neighbour_shift<dim>(code);
      if (sign_of(shift) <= 0) continue;
      bool near = true;
      Vector<dim> steps;
      for (int a = 0; a < dim; ++a) {
        steps(a) = shift[static_cast<std::size_t>(a)];
        double const there = fraction(a) + steps(a);
        near = near && there > -margin(a) && there < 1.0 + margin(a);
      }
      if (!near) continue;
      Vector<dim> const there = place + packing.cell * steps;
      PlacedGrain<dim> image{{}, static_cast<std::int32_t>(i), shift};
      for (int a = 0; a < dim; ++a) image.place[static_cast<std::size_t>(a)] = there(a);
      all.points.push_back(image);
    }
  }
  return all;
}

}  // namespace scarp::detail
