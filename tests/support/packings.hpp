// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "scarp/contact/frictionless.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"

/// Packings that several tests look at.
namespace samples {

using scarp::Tensor;
using scarp::Vector;

using Discs = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
using Ellipses = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
using SmoothDiscs = scarp::Packing<scarp::Disc, scarp::Frictionless>;

inline constexpr double density = 2650.0;  // [kg/m3], the study's grains
inline constexpr double thickness = 0.2;   // [m], of grains in the plane
inline constexpr double pressure = 2e5;    // [Pa]

inline scarp::LinearFrictional study_law() {
  return {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
}

/// Grains at rest at given places; ellipses with their major axes along `angles` [rad].
template <class PackingType>
PackingType place(Tensor<2> const& cell, std::vector<typename PackingType::Shape::template Size<double>> const& sizes,
                  std::vector<Vector<2>> const& places, std::vector<double> const& angles = {}) {
  using Scalar = typename PackingType::Scalar;
  PackingType packing;
  packing.population =
      std::make_shared<scarp::Population<typename PackingType::Shape, Scalar> const>(sizes, density, thickness);
  packing.cell = cell;
  packing.position.resize(sizes.size());
  packing.orientation.resize(sizes.size());
  packing.rest();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (int a = 0; a < 2; ++a) packing.position(i, a) = static_cast<Scalar>(places[i](a));
    if constexpr (PackingType::Shape::orientation_count == 2) {
      double const angle = angles.empty() ? 0.0 : angles[i];
      packing.orientation(i, 0) = static_cast<Scalar>(std::cos(angle));
      packing.orientation(i, 1) = static_cast<Scalar>(std::sin(angle));
    }
  }
  return packing;
}

/// side x side equal discs in a triangular lattice whose neighbours are `spacing` apart, one row along x.
template <class PackingType>
PackingType triangular_lattice(int side, double radius, double spacing) {
  Vector<2> const along(spacing, 0.0);
  Vector<2> const up(spacing / 2.0, spacing * std::sqrt(3.0) / 2.0);
  Tensor<2> cell;
  cell.col(0) = side * along;
  cell.col(1) = side * up;
  std::vector<Vector<2>> places;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) places.emplace_back((i + 0.25) * along + (j + 0.25) * up);
  }
  return place<PackingType>(cell, {places.size(), {radius}}, places);
}

template <class PackingType>
auto grading() {
  if constexpr (PackingType::Shape::orientation_count == 0) {
    return scarp::DiscGrading{.smallest = 4e-3, .largest = 6e-3};
  } else {
    return scarp::EllipseGrading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75};
  }
}

template <class PackingType>
PackingType loose_cloud(int grains, std::uint64_t seed) {
  auto const sizes = grading<PackingType>();
  using Grading = std::remove_const_t<decltype(sizes)>;
  return scarp::Cloud<Grading>{
      .grading = sizes, .grains = grains, .density = density, .thickness = thickness, .seed = seed}
      .template make<PackingType>();
}

/// The study's material under 200 kPa; made once per program.
template <class PackingType>
scarp::Prepared<PackingType> const& consolidated(int grains, std::uint64_t seed = 1) {
  static std::map<std::pair<int, std::uint64_t>, scarp::Prepared<PackingType>> made;
  auto const key = std::pair{grains, seed};
  if (!made.contains(key)) {
    scarp::IsotropicPreparation const preparation{.pressure = pressure};
    made.emplace(key, preparation.prepare(loose_cloud<PackingType>(grains, seed), study_law()));
  }
  return made.at(key);
}

/// Turns everything that has a direction; the list of pairs stays valid.
template <class PackingType>
PackingType turned(PackingType packing, double angle) {
  Tensor<2> const turn = scarp::rotation(angle);
  auto const turn_rows = [&](auto& columns, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) {
      Vector<2> const there = turn * Vector<2>(columns(i, 0), columns(i, 1));
      columns(i, 0) = there(0);
      columns(i, 1) = there(1);
    }
  };
  packing.cell = (turn * packing.cell).eval();
  packing.last_move.gradient = (turn * packing.last_move.gradient * turn.transpose()).eval();
  turn_rows(packing.position, packing.grain_count());
  turn_rows(packing.velocity, packing.grain_count());
  if constexpr (PackingType::Shape::orientation_count == 2) {
    turn_rows(packing.orientation, packing.grain_count());
    turn_rows(packing.pairs.normal, packing.pairs.count());
  }
  return packing;
}

}  // namespace samples
