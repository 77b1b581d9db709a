// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <numeric>

#include "scarp/io/atomic_file.hpp"
#include "scarp/io/framed_file.hpp"
#include "scarp/io/read_file.hpp"
#include "scarp/points/point_states.hpp"

namespace scarp {

namespace detail {
inline constexpr FileFormat points_format{"SCARPPTS", 2, "file of material points", "save_points"};

inline std::vector<int> numbers_to(int count) {
  std::vector<int> numbers(index(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}
}  // namespace detail

/// Writes the committed states of all points. Grains that states share are in it once; points that read it continue with the bits of those that were saved.
/// \throws InputError for states that name no members, and for points of other processes
/// \throws FileError when the file cannot be written; an older file of this name is then untouched
template <int Dim>
void save_points(std::filesystem::path const& path, PointStates<Dim> const& points,
                 Durability durability = Durability::handed_over) {
  auto const bytes = detail::framed(detail::points_format, [&](StateWriter& file) {
    file("points", points.size());
    file("dimensions", Dim);
    if (points.means()) PointMeans<Dim>::basis_members(*points.means(), file);
    file("states", points.pack(detail::numbers_to(points.size())));
  });
  write_file(path, bytes, durability);
}

/// Reads the committed states of points at the same sites, of the same providers.
/// \throws InputError naming the file for one that is missing, of other points, another version or machine, cut off or harmed; the points
/// are then as before
template <int Dim>
void load_points(std::filesystem::path const& path, PointStates<Dim>& points) {
  std::string const file = read_file(path);
  with_context(fmt::format("cannot load '{}'", path.string()), [&] {
    StateReader reader(detail::payload_of(detail::points_format, file));
    int size = 0;
    int dimensions = 0;
    reader("points", size);
    reader("dimensions", dimensions);
    if (size != points.size() || dimensions != Dim)
      reject("it has {} points in {} dimensions (there are {} in {}): load it into points at the same sites", size,
             dimensions, points.size(), Dim);
    if (points.means()) PointMeans<Dim>::basis_members(*points.means(), reader);
    std::string states;
    reader("states", states);
    points.unpack(detail::numbers_to(size), states);
  });
}

}  // namespace scarp
