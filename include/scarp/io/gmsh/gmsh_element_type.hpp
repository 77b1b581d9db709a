// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/io/gmsh/gmsh_reader.hpp"

namespace scarp {

/// Gmsh's number of the type of a file's elements, to choose the element that read_gmsh reads it as
/// (`Tri6::gmsh_type`); of several types in the highest dimension the lowest number, 0 without surfaces and volumes.
/// \throws InputError for what is no mesh of Gmsh or is damaged
inline int gmsh_element_type(std::filesystem::path const& path) {
  auto const content = detail::read_gmsh_content(read_file(path), path.string());
  for (int const dim : {3, 2}) {
    if (auto const kinds = detail::gmsh_kinds(content, dim); !kinds.empty()) return kinds.begin()->first;
  }
  return 0;
}

}  // namespace scarp
