// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>

#include "scarp/core/random.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace scarp {

/// Rectangle with its lower left corner at the origin, in crossed triangles; region "soil", boundaries "left", "right",
/// "bottom" and "top". Interior nodes may be moved at random (for patch tests); the boundary stays.
struct RectangleMesh {
  double width = 1.0;       ///< [m]
  double height = 1.0;      ///< [m]
  int columns = 1;          ///< number of cells along x, 1 to 10000
  int rows = 1;             ///< number of cells along y, 1 to 10000
  double distortion = 0.0;  ///< largest move of an interior node, as a part of the cell's width and height; up to 0.2
  std::uint64_t seed = 1;   ///< of the random moves

  /// \throws InputError for sizes, counts or a distortion out of range
  Mesh<Tri3> generate() const {
    require_positive("width of the rectangle", width);
    require_positive("height of the rectangle", height);
    if (columns < 1 || rows < 1 || columns > 10000 || rows > 10000) {
      reject("the rectangle has {} columns and {} rows (each must be from 1 to 10000): choose other counts", columns,
             rows);
    }
    if (!(distortion >= 0.0 && distortion <= 0.2)) {
      reject("the distortion is {} (triangles may turn over beyond 0.2): choose one from 0 to 0.2", distortion);
    }
    Mesh<Tri3> mesh;
    mesh.regions = {"soil"};
    auto const numbers = add_grid_nodes(mesh.nodes, lines(width, columns), lines(height, rows));
    add_grid_cells(mesh, numbers, Pattern::crossed, 0);
    mesh.boundaries["left"] = left_facets(numbers, rows);
    mesh.boundaries["right"] = right_facets(numbers, columns, rows);
    mesh.boundaries["bottom"] = lower_facets(numbers, 0, columns);
    mesh.boundaries["top"] = upper_facets(numbers, 0, columns, rows);
    distort(mesh);
    validate(mesh);
    return mesh;
  }

 private:
  static std::vector<double> lines(double length, int cells) {
    std::vector<double> positions;
    for (int i = 0; i <= cells; ++i) {
      positions.push_back(length * i / cells);
    }
    return positions;
  }

  void distort(Mesh<Tri3>& mesh) const {
    Random random(seed);
    for (auto& node : mesh.nodes) {
      double const along = random.uniform(-1.0, 1.0) * distortion * width / columns;
      double const up = random.uniform(-1.0, 1.0) * distortion * height / rows;
      if (node.x() > 0.0 && node.x() < width && node.y() > 0.0 && node.y() < height) {
        node += Vector<2>(along, up);
      }
    }
  }
};

}  // namespace scarp
