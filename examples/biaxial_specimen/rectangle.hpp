// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <limits>
#include <map>

#include "scarp/element/tri3.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace biaxial_specimen {

/// A rectangle of crossed triangles, four in each of the equal cells.
inline scarp::Mesh<scarp::Tri3> crossed_rectangle(double width, double height, int columns, int rows) {
  auto const lines = [](double length, int cells) {
    std::vector<double> positions;
    for (int i = 0; i <= cells; ++i) positions.push_back(length * i / cells);
    return positions;
  };
  scarp::Mesh<scarp::Tri3> mesh;
  mesh.regions = {"soil"};
  auto const numbers = scarp::add_grid_nodes(mesh.nodes, lines(width, columns), lines(height, rows));
  scarp::add_grid_cells(mesh, numbers, scarp::Pattern::crossed, 0);
  return mesh;
}

/// What a test needs of a rectangular mesh, found from where its nodes are: meshes come with any names or none.
template <class Element>
struct Sides {
  using Facet = std::array<int, Element::facet_nodes>;

  double width = 0.0;         ///< [m]
  double height = 0.0;        ///< [m]
  double top_level = 0.0;     ///< y [m]
  std::vector<int> bottom{};  ///< nodes
  std::vector<int> top{};
  int bottom_centre = -1;        ///< of the bottom's nodes the one nearest to its middle, mid-side nodes included
  std::vector<Facet> lateral{};  ///< facets of left and right, body on their left
};

/// Facets of one element only, their nodes in the order of the element.
template <class Element>
std::vector<typename Sides<Element>::Facet> outline(scarp::Mesh<Element> const& mesh) {
  using Facet = typename Sides<Element>::Facet;
  std::map<Facet, Facet> single;  // by sorted nodes
  for (auto const& element : mesh.elements) {
    for (auto facet : Element::facets()) {
      for (int& node : facet) node = element[static_cast<std::size_t>(node)];
      Facet sorted = facet;
      std::sort(sorted.begin(), sorted.end());
      if (auto const [place, is_new] = single.emplace(sorted, facet); !is_new) single.erase(place);
    }
  }
  std::vector<Facet> facets;
  for (auto const& [sorted, facet] : single) facets.push_back(facet);
  return facets;
}

/// \throws InputError when the mesh fills no upright rectangle
template <class Element>
Sides<Element> find_sides(scarp::Mesh<Element> const& mesh) {
  scarp::Vector<2> least = mesh.nodes.front();
  scarp::Vector<2> most = least;
  for (auto const& node : mesh.nodes) {
    least = least.cwiseMin(node);
    most = most.cwiseMax(node);
  }
  Sides<Element> sides{.width = most.x() - least.x(), .height = most.y() - least.y(), .top_level = most.y()};
  double const near = 1e-6 * std::max(sides.width, sides.height);  // more than the rounding of seven digits
  auto const node_lies_on = [&](int node, int axis, double level) {
    return std::abs(mesh.nodes[static_cast<std::size_t>(node)](axis) - level) < near;
  };
  double const middle = (least.x() + most.x()) / 2.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    if (node_lies_on(node, 1, most.y())) sides.top.push_back(node);
    if (!node_lies_on(node, 1, least.y())) continue;
    sides.bottom.push_back(node);
    double const distance = std::abs(mesh.nodes[static_cast<std::size_t>(node)].x() - middle);
    if (distance < nearest - near) {
      sides.bottom_centre = node;
      nearest = distance;
    }
  }
  for (auto const& facet : outline(mesh)) {
    auto const lies_on = [&](int axis, double level) {
      return std::all_of(facet.begin(), facet.end(), [&](int node) { return node_lies_on(node, axis, level); });
    };
    if (lies_on(0, least.x()) || lies_on(0, most.x())) {
      sides.lateral.push_back(facet);
    } else if (!lies_on(1, least.y()) && !lies_on(1, most.y())) {
      auto const& place = mesh.nodes[static_cast<std::size_t>(facet[0])];
      scarp::reject(
          "the mesh has a side at ({} m, {} m), inside the rectangle that holds it (an upright rectangle is "
          "compressed): mesh one without holes, steps and slanting sides",
          place.x(), place.y());
    }
  }
  return sides;
}

}  // namespace biaxial_specimen
