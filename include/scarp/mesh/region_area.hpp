// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>
#include <vector>

#include "scarp/element/map.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Area of a region [m2], in 3D its volume [m3].
/// places [m]: of all nodes, such as mesh.nodes
/// \throws InputError for an unknown region
template <class Element>
double region_area(Mesh<Element> const& mesh, std::string_view region,
                   std::vector<Vector<Element::dim>> const& places) {
  int const number = region_number(mesh, region);
  double area = 0.0;
  for (int e = 0; e < detail::count(mesh.elements); ++e) {
    if (mesh.element_region[detail::index(e)] != number) continue;
    auto const rows = corners<Element, Element::dim>(mesh.elements[detail::index(e)], places);
    for (auto const& point : Element::quadrature())
      area += point.weight * measure<Element, Element::dim>(rows, point.xi);
  }
  return area;
}

}  // namespace scarp
