// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>

#include "scarp/core/random.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace samples {

/// Rectangle with its lower left corner at the origin, in crossed triangles; region "soil", boundaries "left", "right",
/// "bottom" and "top".
struct CrossedRectangle {
  double width = 1.0;       ///< [m]
  double height = 1.0;      ///< [m]
  int columns = 1;          ///< number of cells along x
  int rows = 1;             ///< number of cells along y
  double distortion = 0.0;  ///< largest move of an interior node, as a part of the cell's width and height; up to 0.2
  std::uint64_t seed = 1;   ///< of the random moves

  scarp::Mesh<scarp::Tri3> generate() const {
    scarp::Mesh<scarp::Tri3> mesh;
    mesh.regions = {"soil"};
    auto const numbers = scarp::add_grid_nodes(mesh.nodes, lines(width, columns), lines(height, rows));
    scarp::add_grid_cells(mesh, numbers, scarp::Pattern::crossed, 0);
    scarp::GridSides const sides(numbers);
    mesh.boundaries = {{"left", sides.left}, {"right", sides.right}, {"bottom", sides.lower}, {"top", sides.upper}};
    scarp::Random random(seed);
    for (auto& node : mesh.nodes) {
      double const along = random.uniform(-1.0, 1.0) * distortion * width / columns;
      double const up = random.uniform(-1.0, 1.0) * distortion * height / rows;
      if (node.x() > 0.0 && node.x() < width && node.y() > 0.0 && node.y() < height)
        node += scarp::Vector<2>(along, up);
    }
    scarp::validate(mesh);
    return mesh;
  }

 private:
  static std::vector<double> lines(double length, int cells) {
    std::vector<double> positions;
    for (int i = 0; i <= cells; ++i) positions.push_back(length * i / cells);
    return positions;
  }
};

}  // namespace samples
