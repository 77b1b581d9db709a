// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <utility>

#include "keywords.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/tensor/principal.hpp"

namespace python_points {

inline constexpr auto number_size = static_cast<py::ssize_t>(sizeof(double));

/// Named numbers of a committed state, and p and q [Pa], mean and largest difference of the principal stresses.
template <int Dim>
py::dict quantities(scarp::MaterialPoints<Dim> const& points, int point) {
  py::dict named;
  for (auto const& [name, value] : points.quantities(point)) named[py::str(std::string(name))] = value;
  auto const principal =
      scarp::principal_values<Dim>(scarp::from_voigt_stress<Dim, double>(points.committed_stress(point)));
  named["p"] = 0.0 - principal.mean();
  named["q"] = principal(0) - principal(Dim - 1);
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
