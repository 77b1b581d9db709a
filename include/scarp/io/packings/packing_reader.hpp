// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "scarp/core/index.hpp"
#include "scarp/dem/neighbour_list.hpp"
#include "scarp/io/csv_reader.hpp"

namespace scarp {

/// The columns of a table that hold the sizes of a shape's grains, in the shape's order. A shape that has an
/// orientation in the plane also names the column of its angle [rad], counter-clockwise from x. Another shape is one
/// specialisation more.
template <class Shape>
struct GrainColumns;

struct Disc;
struct Sphere;
struct Ellipse;
struct Superellipse;
template <class Template>
struct Clump;

/// Columns of a disc.
template <>
struct GrainColumns<Disc> {
  static constexpr std::array<std::string_view, 1> size{"r"};  ///< radius [m]
};

/// Columns of a sphere.
template <>
struct GrainColumns<Sphere> {
  static constexpr std::array<std::string_view, 1> size{"r"};  ///< radius [m]
};

/// Columns of an ellipse.
template <>
struct GrainColumns<Ellipse> {
  static constexpr std::array<std::string_view, 2> size{"a", "b"};  ///< semi-axes [m]
  static constexpr std::string_view angle = "angle";                ///< of the axis a [rad]
};

/// Columns of a superellipse.
template <>
struct GrainColumns<Superellipse> {
  static constexpr std::array<std::string_view, 3> size{"a", "b", "eps"};  ///< half axes [m] and exponent
  static constexpr std::string_view angle = "angle";                       ///< of the axis of a [rad]
};

/// Columns of a clump.
template <class Template>
struct GrainColumns<Clump<Template>> {
  static constexpr std::array<std::string_view, 1> size{"scale"};  ///< length [m] of the template's unit
  static constexpr std::string_view angle = "angle";               ///< of the template's x axis [rad]
};

/// A shape whose sizes, and angle if it turns, have names of columns.
template <class Shape>
concept HasGrainColumns = requires {
  requires GrainColumns<Shape>::size.size() == static_cast<std::size_t>(Shape::size_count);
  requires Shape::orientation_count == 0 || (Shape::orientation_count == 2 && requires {
    { GrainColumns<Shape>::angle } -> std::convertible_to<std::string_view>;
  });
};

/// A packing of a file and what its grains are called there.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct NamedPacking {
  PackingType packing;                                    ///< at rest, placed as in the file, without a list of pairs
  std::vector<std::int64_t> ids{};                        ///< of each grain
  std::unordered_map<std::int64_t, std::size_t> grain{};  ///< by id
};

namespace detail {

inline constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// Ids of the rows; the rows' numbers where the table has no column `id`.
template <class PackingType>
void read_ids(CsvColumns const& table, NamedPacking<PackingType>& named) {
  if (table.has("id")) {
    named.ids = table.column<std::int64_t>("id");
  } else {
    for (std::size_t i = 0; i < table.rows(); ++i) named.ids.push_back(static_cast<std::int64_t>(i));
  }
  for (std::size_t i = 0; i < table.rows(); ++i) {
    auto const [other, is_new] = named.grain.emplace(named.ids[i], i);
    if (!is_new) {
      table.reject_cell(i, "id", fmt::format("line {} has the same", table.line(other->second)),
                        "give each grain its own id");
    }
  }
}

template <class Shape>
std::vector<std::array<double, static_cast<std::size_t>(Shape::size_count)>> read_sizes(CsvColumns const& table) {
  std::vector<std::array<double, static_cast<std::size_t>(Shape::size_count)>> sizes(table.rows());
  for (std::size_t k = 0; k < GrainColumns<Shape>::size.size(); ++k) {
    auto const name = GrainColumns<Shape>::size[k];
    auto const values = table.column(name);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (!(values[i] > 0.0)) table.reject_cell(i, name, "a size is above zero", "correct it or leave the grain out");
      sizes[i][k] = values[i];
    }
  }
  if constexpr (requires { Shape::check(sizes[0]); }) {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      with_context(fmt::format("line {} of '{}'", table.line(i), table.file()), [&] { Shape::check(sizes[i]); });
    }
  }
  return sizes;
}

template <class PackingType>
void read_places(CsvColumns const& table, PackingType& packing) {
  using Scalar = typename PackingType::Scalar;
  using Shape = typename PackingType::Shape;
  constexpr double farthest = 1e6;  // cells away; beyond, doubles in [m] lose digits that overlaps need
  double const limit = farthest * packing.cell.norm();
  packing.position.resize(table.rows());
  packing.orientation.resize(table.rows());
  packing.rest();
  for (int a = 0; a < PackingType::dim; ++a) {
    auto const name = axis_names[detail::index(a)];
    auto const values = table.column(name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::abs(values[i]) > limit) {
        table.reject_cell(i, name, "it is more than a million cells away", "check the units, or wrap the position");
      }
      packing.position(i, a) = static_cast<Scalar>(values[i]);
    }
  }
  if constexpr (Shape::orientation_count == 2) {
    auto const angles = table.column(GrainColumns<Shape>::angle);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      packing.orientation.set_row(i,
                                  {static_cast<Scalar>(std::cos(angles[i])), static_cast<Scalar>(std::sin(angles[i]))});
    }
  }
}

/// Grains in the plane may come with a column z, but then it is the same for all.
inline void reject_places_in_space(CsvColumns const& table) {
  if (!table.has("z")) return;
  auto const places = table.column("z");
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i] == places[0]) continue;
    table.reject_cell(i, "z", fmt::format("the first grain has {}, and grains in the plane lie in one", places[0]),
                      "read them as spheres in space by scarp::read_packing, or leave the column out");
  }
}

/// Takes a copy, because making the list of pairs wraps the positions.
template <class PackingType>
void reject_deep_overlaps(PackingType packing, std::vector<std::int64_t> const& ids, std::string const& file) {
  using Shape = typename PackingType::Shape;
  if (!rebuild_pairs(packing, 0.0).acceptable()) {
    reject(
        "the grains of '{}' do not fit into their cell (its base vectors must be right-handed and its faces more than "
        "two "
        "of the largest diameters apart): check cell and units",
        file);
  }
  for (std::size_t p = 0; p < packing.pairs.count(); ++p) {
    PairGeometry<PackingType> const near(packing, p);
    double const overlap = near.touch.overlap;
    double const radius = std::min(Shape::contact_radius(near.first), Shape::contact_radius(near.second));
    if (overlap <= radius) continue;
    reject(
        "grains {} and {} of '{}' overlap by {} m (more than the smaller one's radius {}): check cell, units and "
        "repeated grains",
        ids[grain_of_row(packing, detail::index(packing.pairs.first[p]))],
        ids[grain_of_row(packing, detail::index(packing.pairs.second[p]))], file, overlap, radius);
  }
}

}  // namespace detail

/// Reads grains from a table with columns x, y (z), those of GrainColumns and, when the file has it, id.
/// cell: columns are base vectors [m]; lengths in [m], density [kg/m3]; thickness: out of plane in 2D [m], 1 in 3D
/// \throws InputError naming the line for sizes, ids and places that cannot be, the ids of grains that lie in one
/// another
template <class PackingType>
  requires HasGrainColumns<typename PackingType::Shape> NamedPacking<PackingType> read_packing(
      CsvColumns const& table, Tensor<PackingType::dim> const& cell, double density, double thickness) {
    using Shape = typename PackingType::Shape;
    if (table.rows() == 0) reject("'{}' lists no grain (a packing needs one at least): add lines", table.file());
    if (!(cell.allFinite() && cell.determinant() > 0.0)) {
      reject("the cell for '{}' has a content of {} (its base vectors must be finite and right-handed): check them",
             table.file(), cell.determinant());
    }
    if constexpr (PackingType::dim == 2) detail::reject_places_in_space(table);
    NamedPacking<PackingType> named;
    auto& packing = named.packing;
    packing.cell = cell;
    detail::read_ids(table, named);
    packing.population = std::make_shared<Population<Shape, typename PackingType::Scalar> const>(
        detail::read_sizes<Shape>(table), density, thickness);
    detail::read_places(table, packing);
    detail::reject_deep_overlaps(packing, named.ids, table.file());
    return named;
  }

/// Reads the packing of a CSV file.
/// \throws InputError for a file that cannot be read, and for a table or cell that makes no packing
template <class PackingType>
NamedPacking<PackingType> read_packing(std::filesystem::path const& path, Tensor<PackingType::dim> const& cell,
                                       double density, double thickness) {
  return read_packing<PackingType>(read_csv(path), cell, density, thickness);
}

}  // namespace scarp
