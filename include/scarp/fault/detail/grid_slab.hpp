// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <vector>

#include "scarp/mesh/box_mesh.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace scarp::detail {

/// A slab over a grid in the plane: x stays, the strike becomes y, the plane's y becomes z. Boundaries
/// as BoxMesh names them.
/// nodes: of the plane grid [m]; strike: thickness [m], in so many cells
template <ReferenceElement Element>
Mesh<Element> grid_slab(std::vector<Vector<2>> const& nodes, GridNumbers const& numbers, double strike, int cells) {
  static_assert(Element::dim == 3 && !HasMidSides<Element>);
  auto const to_place = [&](Vector<3> const& counted) -> Vector<3> {  // counted in cells along x and z
    auto const line = [&](int axis) { return static_cast<int>(std::lround(counted(axis))); };
    Vector<2> const place = nodes[index(numbers(line(0), line(2)))];
    return {place.x(), counted.y(), place.y()};
  };
  return BoxMesh<Element>{.lengths = Vector<3>(numbers.columns(), strike, numbers.rows()),
                          .cells = {numbers.columns(), cells, numbers.rows()},
                          .map = to_place}
      .generate();
}

}  // namespace scarp::detail
