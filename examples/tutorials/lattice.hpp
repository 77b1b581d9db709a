// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "scarp/dem/packing.hpp"

namespace tutorials {

/// A square or cubic lattice of equal grains at rest, whose stresses are known: each grain touches its neighbours along
/// the axes and nothing else.
/// size [m]: parameters of every grain; spacing [m]: of the centres; side: grains along each axis
template <class PackingType>
PackingType lattice(scarp::SizeOf<typename PackingType::Shape> const& size,
                    scarp::Vector<PackingType::dim> const& spacing, int side = 4) {
  constexpr int dim = PackingType::dim;
  using Population = scarp::Population<typename PackingType::Shape>;
  std::size_t const grains =
      dim == 2 ? static_cast<std::size_t>(side * side) : static_cast<std::size_t>(side * side * side);
  PackingType packing;
  packing.population = std::make_shared<Population const>(std::vector(grains, size), 2650.0, 1.0);
  packing.cell = (side * spacing).asDiagonal();
  packing.position.resize(grains);
  packing.orientation.resize(grains);
  packing.rest();
  for (std::size_t i = 0; i < grains; ++i) {
    std::size_t left = i;
    for (int axis = 0; axis < dim; ++axis, left /= static_cast<std::size_t>(side)) {
      packing.position(i, axis) = spacing(axis) * (0.5 + static_cast<double>(left % static_cast<std::size_t>(side)));
    }
    if constexpr (PackingType::Shape::orientation_count == 2) packing.orientation(i, 0) = 1.0;  // axes along x
  }
  return packing;
}

/// One-dimensional modulus C11 [Pa] of a soil in the plane, by a compression of 1e-4 along x; NaN for a response that
/// is not acceptable.
template <class Soil>
double modulus(Soil const& soil) {
  constexpr double strain = 1e-4;
  auto const start = soil.initial_state({});
  auto trial = start;
  auto const response = soil.respond(start, scarp::Gradient<2>{{-strain, 0.0}, {0.0, 0.0}}, trial);
  return response.verdict.acceptable() ? (start.stress(0) - response.stress(0)) / strain : std::nan("");
}

/// Prints a result and its known value. \return whether they agree to a relative tolerance
inline bool agree(char const* what, double found, double known, double tolerance) {
  bool const good = std::abs(found - known) <= tolerance * std::abs(known);
  fmt::print("{:<48} {:>14.7g}  known {:>14.7g}  {}\n", what, found, known, good ? "ok" : "WRONG");
  return good;
}

}  // namespace tutorials
