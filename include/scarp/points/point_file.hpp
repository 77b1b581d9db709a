// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/framed_file.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/points/material_points.hpp"

namespace scarp {

namespace detail {
inline constexpr FileFormat points_format{"SCARPPTS", 3, "file of material points", "save_points"};
}  // namespace detail

/// Writes the committed states of all points. Grains that states share are in it once; points that read it continue
/// with the bits of those that were saved.
/// \throws InputError for states that name no members, and for points of other processes
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <int Dim>
void save_points(std::filesystem::path const& path, MaterialPoints<Dim> const& points,
                 Durability durability = Durability::handed_over) {
  auto const bytes = detail::framed(detail::points_format, [&](StateWriter& file) { file("points", points); });
  write_file(path, bytes, durability);
}

/// Reads the committed states of points at the same sites, of the same providers.
/// \throws InputError naming the file for one that is missing, of other points, another version or machine, cut off or
/// harmed; the points are then as before
template <int Dim>
void load_points(std::filesystem::path const& path, MaterialPoints<Dim>& points) {
  std::string const file = read_file(path);
  with_context(fmt::format("cannot load '{}'", path.string()), [&] {
    auto loaded = points;
    StateReader reader(detail::payload_of(detail::points_format, file));
    reader("points", loaded);
    if (!reader.at_end())
      reject("it holds more than the states of these {} points: load it into points of the providers that were saved",
             points.size());
    points = std::move(loaded);
  });
}

}  // namespace scarp
