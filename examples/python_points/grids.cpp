// SPDX-License-Identifier: BSL-1.0
// Meshes and elements, compiled apart from all that only needs a Grid.
#include "grids.hpp"

#include <array>
#include <string_view>
#include <type_traits>

#include "elements.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"
#include "scarp/mesh/box_mesh.hpp"

namespace python_points {
namespace {

template <class Element>
MeshTables tables_of(std::string const& name, scarp::Mesh<Element> const& mesh) {
  MeshTables tables{.element = name, .element_region = mesh.element_region, .regions = mesh.regions};
  for (auto const& node : mesh.nodes) tables.nodes.insert(tables.nodes.end(), node.begin(), node.end());
  for (auto const& element : mesh.elements)
    tables.elements.insert(tables.elements.end(), element.begin(), element.end());
  for (auto const& [boundary, facets] : mesh.boundaries) {
    auto& numbers = tables.boundaries[boundary];
    for (auto const& facet : facets) numbers.insert(numbers.end(), facet.begin(), facet.end());
  }
  return tables;
}

template <std::size_t Size>
std::vector<std::array<int, Size>> rows_of_numbers(std::vector<int> const& numbers) {
  std::vector<std::array<int, Size>> rows(numbers.size() / Size);
  for (std::size_t k = 0; k < rows.size(); ++k)
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(Size * k), Size, rows[k].begin());
  return rows;
}

template <class Element>
scarp::Mesh<Element> mesh_of(MeshTables const& tables) {
  scarp::Mesh<Element> mesh;
  for (std::size_t k = 0; k < tables.nodes.size(); k += Element::dim)
    mesh.nodes.emplace_back(Eigen::Map<scarp::Vector<Element::dim> const>(tables.nodes.data() + k));
  mesh.elements = rows_of_numbers<Element::nodes>(tables.elements);
  mesh.element_region = tables.element_region;
  mesh.regions = tables.regions;
  for (auto const& [name, facets] : tables.boundaries)
    mesh.boundaries[name] = rows_of_numbers<Element::facet_nodes>(facets);
  return mesh;
}

}  // namespace

ElementSizes sizes_of(std::string const& element) {
  ElementSizes sizes{};
  with_element(element, [&]<class Element>(std::type_identity<Element>) {
    sizes = {Element::dim, Element::nodes, Element::facet_nodes};
  });
  return sizes;
}

MeshTables gmsh_tables(std::filesystem::path const& file, std::string const& element, int highest_order) {
  scarp::GmshFile const content(file, {.highest_order = highest_order});
  std::string name = element;
  if (name.empty()) {
    bool const is_known = any_element([&]<class Element>(std::string_view own, std::type_identity<Element>) {
      name = own;
      return Element::gmsh_type == content.element_type();
    });
    if (!is_known) name = "tri3";  // whose reader says what is wrong with the file
  }
  MeshTables tables;
  with_element(name,
               [&]<class Element>(std::type_identity<Element>) { tables = tables_of(name, content.mesh<Element>()); });
  tables.notes = content.notes();
  return tables;
}

MeshTables box_tables(std::string const& element, std::vector<double> const& lengths, std::vector<int> const& cells) {
  MeshTables tables;
  with_element(element, [&]<class Element>(std::type_identity<Element>) {
    if (std::ssize(lengths) != Element::dim || std::ssize(cells) != Element::dim)
      scarp::reject("a box of {} has {} lengths and {} numbers of cells ({} of each are expected): give as many",
                    element, lengths.size(), cells.size(), Element::dim);
    scarp::BoxMesh<Element> box;
    for (int axis = 0; axis < Element::dim; ++axis) {
      box.lengths(axis) = lengths[static_cast<std::size_t>(axis)];
      box.cells[static_cast<std::size_t>(axis)] = cells[static_cast<std::size_t>(axis)];
    }
    tables = tables_of(element, box.generate());
  });
  return tables;
}

template <int Dim>
std::unique_ptr<scarp::Grid<Dim>> grid_of(MeshTables const& tables, std::string const& kinematics, double thickness) {
  std::unique_ptr<scarp::Grid<Dim>> grid;
  with_element(tables.element, [&]<class Element>(std::type_identity<Element>) {
    if constexpr (Element::dim == Dim) {
      if (kinematics == "updated_lagrangian") {
        grid = std::make_unique<scarp::DefaultGrid<Element>>(mesh_of<Element>(tables), thickness);
      } else if (kinematics == "small_strain") {
        grid = std::make_unique<SmallGrid<Element>>(mesh_of<Element>(tables), thickness);
      } else {
        scarp::reject("the kinematics are '{}' (updated_lagrangian or small_strain is expected): use one of these",
                      kinematics);
      }
    }
  });
  return grid;
}

template std::unique_ptr<scarp::Grid<2>> grid_of<2>(MeshTables const&, std::string const&, double);
template std::unique_ptr<scarp::Grid<3>> grid_of<3>(MeshTables const&, std::string const&, double);

}  // namespace python_points
