// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <functional>

#include "scarp/core/random.hpp"
#include "scarp/mesh/detail/cell_division.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp {

/// Rectangle or box from the origin to `lengths`, a grid of cells that are divided into the elements; region "soil",
/// boundaries "left" and "right" along x, "bottom" and "top" along the last axis and in 3D "front" and "back" along y.
/// Interior corners may be moved at random; then nodes on edges are put in their middles, and at last every node goes
/// at their images by `map`: a smooth map makes a graded or curved mesh.
template <CheckedElement Element>
struct BoxMesh {
  static constexpr int dim = Element::dim;  ///< of the elements

  Vector<dim> lengths = Vector<dim>::Ones();              ///< [m]
  std::array<int, detail::index(dim)> cells = filled(1);  ///< number along each axis, 1 to 10000
  double distortion = 0.0;  ///< largest move of an interior corner, as a part of the cell's lengths; up to 0.2
  std::uint64_t seed = 1;   ///< of the random moves
  std::function<Vector<dim>(Vector<dim> const&)> map{};  ///< from the box [m] to space [m]; empty: stay

  /// Equal numbers of cells along all axes.
  static constexpr std::array<int, detail::index(dim)> filled(int cells) {
    std::array<int, detail::index(dim)> all{};
    all.fill(cells);
    return all;
  }

  /// \throws InputError for lengths, counts or a distortion out of range, and for a map that turns elements inside out
  Mesh<Element> generate() const {
    check();
    auto mesh = with_nodes_of<Element>(corner_mesh());
    if (map) {
      for (auto& node : mesh.nodes) {
        node = map(node);
      }
    }
    validate(mesh);
    return mesh;
  }

 private:
  using Linear = LinearOf<Element>;
  static_assert(detail::is_simplex<Linear> || detail::is_cube<Linear>,
                "scarp: a box is divided into triangles, tetrahedra, quadrilaterals or hexahedra; an element with more "
                "nodes than corners names these, `using Linear = ...`, and `mid_sides()` or `node_places()`");
  using Place = std::array<int, detail::index(dim)>;  // of a grid node, in cells along each axis

  void check() const {
    for (int axis = 0; axis < dim; ++axis) {
      require_positive("length of the box", lengths(axis));
      int const along = cells[detail::index(axis)];
      if (along < 1 || along > 10000) {
        reject("the box has {} cells along axis {} (it must be from 1 to 10000): choose another count", along, axis);
      }
    }
    if (!(distortion >= 0.0 && distortion <= 0.2)) {
      reject("the distortion is {} (elements may turn over beyond 0.2): choose one from 0 to 0.2", distortion);
    }
  }

  Mesh<Linear> corner_mesh() const {
    Mesh<Linear> mesh;
    mesh.regions = {"soil"};
    Random random(seed);
    for_each_place(1, [&](Place const& place) { mesh.nodes.push_back(position(place, random)); });
    auto const parts = detail::cell_division<Linear>();
    for_each_place(0, [&](Place const& cell) {
      for (auto part : parts) {
        for (int& vertex : part) {
          vertex = number(cell, vertex);
        }
        mesh.elements.push_back(part);
        mesh.element_region.push_back(0);
      }
    });
    add_boundaries(mesh);
    return mesh;
  }

  /// visit(place) for every cell (extra = 0) or grid node (extra = 1), the first axis fastest.
  template <class Visit>
  void for_each_place(int extra, Visit const& visit) const {
    Place place{};
    for (int axis = 0; axis < dim;) {
      visit(place);
      for (axis = 0; axis < dim && ++place[detail::index(axis)] == cells[detail::index(axis)] + extra; ++axis) {
        place[detail::index(axis)] = 0;
      }
    }
  }

  int number(Place const& cell, int vertex) const {
    int node = 0;
    for (int axis = dim - 1; axis >= 0; --axis) {
      node = node * (cells[detail::index(axis)] + 1) + cell[detail::index(axis)] + (vertex >> axis & 1);
    }
    return node;
  }

  Vector<dim> position(Place const& place, Random& random) const {
    Vector<dim> node;
    Vector<dim> move;
    bool inside = true;
    for (int axis = 0; axis < dim; ++axis) {
      int const line = place[detail::index(axis)];
      int const end = cells[detail::index(axis)];
      node(axis) = line == end ? lengths(axis) : lengths(axis) * line / end;
      move(axis) = random.uniform(-1.0, 1.0) * distortion * lengths(axis) / end;
      inside = inside && line > 0 && line < end;
    }
    return inside ? Vector<dim>(node + move) : node;
  }

  void add_boundaries(Mesh<Linear>& mesh) const {
    for (int e = 0; e < detail::count(mesh.elements); ++e) {
      for (int side = 0; side < detail::count(Linear::facets()); ++side) {
        auto const facet = detail::side_nodes(mesh, e, side);
        for (int axis = 0; axis < dim; ++axis) {
          auto const all_at = [&](double place) {
            return std::ranges::all_of(facet, [&](int node) { return mesh.nodes[detail::index(node)](axis) == place; });
          };
          auto const& [low, high] = names(axis);
          if (all_at(0.0)) mesh.boundaries[low].push_back(facet);
          if (all_at(lengths(axis))) mesh.boundaries[high].push_back(facet);
        }
      }
    }
  }

  static std::pair<char const*, char const*> names(int axis) {
    if (axis == 0) {
      return {"left", "right"};
    }
    return axis + 1 == dim ? std::pair("bottom", "top") : std::pair("front", "back");
  }
};

}  // namespace scarp
