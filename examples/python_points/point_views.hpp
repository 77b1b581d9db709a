// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "keywords.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/tensor/geo.hpp"

namespace python_points {

inline constexpr auto number_size = static_cast<py::ssize_t>(sizeof(double));

/// Named numbers of a committed state, and p and q [Pa].
template <int Dim>
py::dict quantities(scarp::MaterialPoints<Dim> const& points, int point) {
  py::dict named;
  for (auto const& [name, value] : points.quantities(point)) named[py::str(std::string(name))] = value;
  auto const stress = points.committed_stress(point);
  if constexpr (Dim == 2) {
    auto const [p, q] = scarp::geo::plane_stress(stress);
    named["p"] = p, named["q"] = q;
  } else {
    auto const tensor = scarp::from_voigt_stress<3>(stress);
    double const p = -tensor.trace() / 3.0;
    named["p"] = p, named["q"] = std::sqrt(1.5) * (tensor + p * scarp::Tensor<3>::Identity()).norm();
  }
  return named;
}

/// Grains and contacts of a plane packing; nothing of other materials.
inline py::object picture(scarp::MaterialPoints<2> const& points, int point) {
  auto shown = points.picture<scarp::PackingPicture>(point);
  if (!shown) return py::none();
  using Picture = scarp::PackingPicture;
  static_assert(sizeof(Picture::Grain) >= 6 * sizeof(double) && sizeof(Picture::Contact) >= 7 * sizeof(double));
  py::dict named;
  py::array_t<double> cell({2, 2});
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) cell.mutable_at(i, j) = shown->cell(i, j);
  }
  named["cell"] = cell;
  named["grains"] = array_of<double>(std::move(shown->grains), {6}, {number_size});
  named["contacts"] = array_of<double>(std::move(shown->contacts), {7}, {number_size});
  return named;
}

}  // namespace python_points
