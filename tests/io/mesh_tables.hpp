// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "scarp/io/csv.hpp"
#include "scarp/mesh/mesh.hpp"

namespace samples {

using scarp::CsvTable;
using scarp::Mesh;

namespace detail {

using scarp::detail::index;

inline constexpr std::array<std::string_view, 3> coordinate_names{"x", "y", "z"};

template <class Element>
CsvTable mesh_node_table(Mesh<Element> const& mesh) {
  std::vector<std::string> columns{"node"};
  columns.insert(columns.end(), coordinate_names.begin(), coordinate_names.begin() + Element::dim);
  CsvTable table(columns);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    auto const& x = mesh.nodes[n];
    if constexpr (Element::dim == 2) {
      table.add(n, x(0), x(1));
    } else {
      table.add(n, x(0), x(1), x(2));
    }
  }
  return table;
}

template <class Element>
CsvTable mesh_element_table(Mesh<Element> const& mesh) {
  std::vector<std::string> columns{"element", "region"};
  for (int a = 0; a < Element::nodes; ++a) columns.push_back(fmt::format("n{}", a));
  CsvTable table(columns);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    auto const& region = mesh.regions[index(mesh.element_region[e])];
    std::apply([&](auto... nodes) { table.add(e, region, nodes...); }, mesh.elements[e]);
  }
  return table;
}

template <class Element>
CsvTable mesh_boundary_table(Mesh<Element> const& mesh) {
  std::vector<std::string> columns{"boundary"};
  for (int a = 0; a < Element::facet_nodes; ++a) columns.push_back(fmt::format("n{}", a));
  CsvTable table(columns);
  for (auto const& [name, sides] : mesh.boundaries) {
    for (auto const& side : sides) {
      std::apply([&, &called = name](auto... nodes) { table.add(called, nodes...); }, side);
    }
  }
  return table;
}

}  // namespace detail

/// Writes what Python compares a mesh with: nodes.csv (node, x, y and in 3D z [m]), elements.csv (element, region by
/// name, n0, n1, ...: node numbers from 0 in the order of VTK) and boundaries.csv (boundary by name, n0, n1, ...: nodes
/// of one side).
/// Coordinates keep every bit.
template <class Element>
void write_mesh_tables(std::filesystem::path const& folder, Mesh<Element> const& mesh) {
  detail::mesh_node_table(mesh).write(folder / "nodes.csv");
  detail::mesh_element_table(mesh).write(folder / "elements.csv");
  detail::mesh_boundary_table(mesh).write(folder / "boundaries.csv");
}

}  // namespace samples
