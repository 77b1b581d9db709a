// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scarp/bvp/grid.hpp"

namespace python_points {

/// A mesh whose elements are known by name: tables of numbers, row by row.
struct MeshTables {
  std::string element;                                   ///< such as "tri6"
  std::vector<double> nodes{};                           ///< shape (nodes, dim) [m]
  std::vector<int> elements{};                           ///< shape (elements, nodes of one)
  std::vector<int> element_region{};                     ///< number of each element's region
  std::vector<std::string> regions{};                    ///< names
  std::map<std::string, std::vector<int>> boundaries{};  ///< shape (facets, nodes of one) each
  std::vector<std::string> notes{};                      ///< what a file has and the mesh has not, see GmshFile
};

/// Dimension, nodes, and nodes of a facet of an element.
struct ElementSizes {
  int dim;
  int nodes;
  int facet_nodes;
};

/// \throws InputError for a name of no element, naming all
ElementSizes sizes_of(std::string const& element);

/// The mesh of a file of Gmsh; element: empty for the file's own. \throws InputError
MeshTables gmsh_tables(std::filesystem::path const& file, std::string const& element, int highest_order);

/// Rectangle or box from the origin, see BoxMesh. \throws InputError
MeshTables box_tables(std::string const& element, std::vector<double> const& lengths, std::vector<int> const& cells);

/// Elements with their default integration. kinematics: "updated_lagrangian" or "small_strain". \throws InputError
template <int Dim>
std::unique_ptr<scarp::Grid<Dim>> grid_of(MeshTables const& tables, std::string const& kinematics, double thickness);

}  // namespace python_points
