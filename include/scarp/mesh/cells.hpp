// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// The elements of a mesh whose kind is known at run time only.
struct Cells {
  int nodes = 0;                             ///< of each element
  std::uint8_t vtk_type = 0;                 ///< VTK's number of the kind, 0 for one that names none
  std::vector<std::int32_t> connectivity{};  ///< node numbers of all elements in turn, in VTK's order
  std::vector<int> regions{};                ///< number of each element's region; empty where they have none

  /// Number of elements.
  int count() const { return nodes > 0 ? detail::count(connectivity) / nodes : 0; }
};

/// The elements of a mesh as cells.
template <class Element>
Cells cells_of(Mesh<Element> const& mesh) {
  Cells cells{Element::nodes, static_cast<std::uint8_t>(Element::vtk_cell_type), {}, mesh.element_region};
  for (auto const& element : mesh.elements)
    cells.connectivity.insert(cells.connectivity.end(), element.begin(), element.end());
  return cells;
}

/// The facets of a boundary as cells, without regions.
/// \throws InputError as boundary() does
template <class Element>
Cells facets_of(Mesh<Element> const& mesh, std::string_view boundary) {
  using Facet = typename Element::Facet;
  Cells cells{.nodes = Facet::nodes};
  if constexpr (HasVtkCellType<Facet>) cells.vtk_type = static_cast<std::uint8_t>(Facet::vtk_cell_type);
  for (auto const& facet : scarp::boundary(mesh, boundary))
    cells.connectivity.insert(cells.connectivity.end(), facet.begin(), facet.end());
  return cells;
}

}  // namespace scarp
