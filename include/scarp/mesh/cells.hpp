// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// The elements of a mesh whose kind is known at run time only.
struct Cells {
  int nodes = 0;                             ///< of each element
  std::uint8_t vtk_type = 0;                 ///< VTK's number of the kind
  std::vector<std::int32_t> connectivity{};  ///< node numbers of all elements in turn, in VTK's order
  std::vector<int> regions{};                ///< number of each element's region

  int count() const { return detail::count(regions); }  ///< Number of elements.
};

/// The elements of a mesh as cells.
template <class Element>
Cells cells_of(Mesh<Element> const& mesh) {
  Cells cells{Element::nodes, static_cast<std::uint8_t>(Element::vtk_cell_type), {}, mesh.element_region};
  for (auto const& element : mesh.elements)
    cells.connectivity.insert(cells.connectivity.end(), element.begin(), element.end());
  return cells;
}

}  // namespace scarp
