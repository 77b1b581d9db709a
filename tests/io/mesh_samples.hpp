// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scarp/element/hex20.hpp"
#include "scarp/element/hex8.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tet4.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#include "scarp/mesh/mesh.hpp"

/// Small meshes of each element type whose volumes are known: a box of 2 x 1 (x 1) m, sheared or bent. Mid-side nodes
/// stand in the order of VTK's file formats, listed here anew.
namespace samples {

using Lattice = std::array<int, 3>;  ///< quarters of the box in x, halves in y and z: middles of sides lie on it too
using Cell = std::vector<Lattice>;

inline constexpr double bend_x = 0.2;
inline constexpr double bend_y = 0.1;

/// A quadratic map, which quadratic elements with straight sides before it follow exactly. Its Jacobian is
/// 1 + 0.2 Y - 0.04 X^2.
inline std::array<double, 3> bent(double x, double y, double z) {
  return {x * (1.0 + bend_x * y), y + bend_y * x * x, z + 0.1 * x * y + 0.05 * y * y};
}
inline constexpr double bent_volume = 2.0 + 0.1 * 2.0 - 0.04 * 8.0 / 3.0;  // analytic: integral over [0, 2] x [0, 1]

/// A linear map of Jacobian 1.
inline std::array<double, 3> sheared(double x, double y, double z) { return {x + 0.3 * y, y, z + 0.2 * x}; }
inline constexpr double sheared_volume = 2.0;  // analytic

inline std::vector<std::array<int, 2>> edges(int dim, int corners) {
  if (dim == 2 && corners == 3) return {{0, 1}, {1, 2}, {2, 0}};
  if (dim == 2) return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  if (corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
}

/// The cells that fill one cube of the lattice.
inline std::vector<Cell> split(Lattice const& low, int dim, int corners) {
  auto const at = [&](int i, int j, int k) { return Lattice{low[0] + 2 * i, low[1] + 2 * j, low[2] + 2 * k}; };
  Cell const quad{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)};
  Cell const lid{at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)};
  if (dim == 2 && corners == 3) return {{quad[0], quad[1], quad[2]}, {quad[2], quad[3], quad[0]}};
  if (dim == 2) return {quad};
  if (corners == 8) return {{quad[0], quad[1], quad[2], quad[3], lid[0], lid[1], lid[2], lid[3]}};
  // Six tetrahedra around the diagonal, one for each order of the axes.
  return {{quad[0], quad[1], quad[2], lid[2]}, {quad[0], lid[1], quad[1], lid[2]}, {quad[0], quad[2], quad[3], lid[2]},
          {quad[0], quad[3], lid[3], lid[2]},  {quad[0], lid[0], lid[1], lid[2]},  {quad[0], lid[3], lid[0], lid[2]}};
}

/// Facets whose nodes all have this lattice coordinate.
template <class Element>
std::vector<std::array<int, Element::facet_nodes>> sides(scarp::Mesh<Element> const& mesh,
                                                         std::vector<Lattice> const& lattice, std::size_t axis,
                                                         int value) {
  std::vector<std::array<int, Element::facet_nodes>> found;
  for (auto const& element : mesh.elements) {
    for (auto side : Element::facets()) {
      bool inside = true;
      for (int& node : side) {
        node = element[static_cast<std::size_t>(node)];
        inside = inside && lattice[static_cast<std::size_t>(node)][axis] == value;
      }
      if (inside) found.push_back(side);
    }
  }
  return found;
}

template <class Element, class Map>
scarp::Mesh<Element> mesh_sample(Map const& map) {
  constexpr int dim = Element::dim;
  constexpr int corners = Element::nodes % 4 == 0 && !(dim == 3 && Element::nodes == 4) ? 4 * (dim - 1) : dim + 1;
  scarp::Mesh<Element> mesh;
  mesh.regions = {"lower sand", "upper"};
  std::vector<Lattice> lattice;
  std::map<Lattice, int> number;
  auto const node = [&](Lattice const& at) {
    auto const [entry, is_new] = number.emplace(at, static_cast<int>(lattice.size()));
    if (is_new) {
      lattice.push_back(at);
      auto const x = map(0.25 * at[0], 0.5 * at[1], 0.5 * at[2]);
      mesh.nodes.push_back(Eigen::Map<scarp::Vector<3> const>(x.data()).template head<dim>());
    }
    return entry->second;
  };
  for (int i = 0; i < 4; ++i) {
    for (auto const& cell : split({2 * i, 0, 0}, dim, corners)) {
      std::array<int, Element::nodes> element{};
      std::size_t a = 0;
      for (auto const& corner : cell) element[a++] = node(corner);
      if constexpr (Element::nodes > corners) {
        for (auto const& [from, to] : edges(dim, corners)) {
          auto const& p = cell[static_cast<std::size_t>(from)];
          auto const& q = cell[static_cast<std::size_t>(to)];
          element[a++] = node({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
        }
      }
      mesh.elements.push_back(element);
      mesh.element_region.push_back(i % 2);  // regions that take turns
    }
  }
  mesh.boundaries["left"] = sides(mesh, lattice, 0, 0);
  mesh.boundaries["right side"] = sides(mesh, lattice, 0, 8);
  mesh.boundaries["ground"] = sides(mesh, lattice, 1, 0);
  return mesh;
}

/// Calls action(name, Element{}) for each element type.
template <class Action>
void for_each_element(Action const& action) {
  action("Tri3", scarp::Tri3{});
  action("Quad4", scarp::Quad4{});
  action("Tet4", scarp::Tet4{});
  action("Hex8", scarp::Hex8{});
  action("Tri6", scarp::Tri6{});
  action("Quad8", scarp::Quad8{});
  action("Tet10", scarp::Tet10{});
  action("Hex20", scarp::Hex20{});
}

template <class Element>
double volume(scarp::Mesh<Element> const& mesh) {
  double sum = 0.0;
  for (auto const& element : mesh.elements) {
    auto const rows = scarp::corners<Element, Element::dim>(element, mesh.nodes);
    for (auto const& point : Element::quadrature()) {
      sum += point.weight * scarp::measure<Element, Element::dim>(rows, point.xi);
    }
  }
  return sum;
}

}  // namespace samples
