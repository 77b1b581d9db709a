// SPDX-License-Identifier: BSL-1.0
/// \file
/// Faults that meshes from elsewhere may have and `validate` does not look for, since meshes of this library have none.
#pragma once

#include <Eigen/Geometry>

#include "scarp/core/error.hpp"
#include "scarp/mesh/detail/place_index.hpp"
#include "scarp/mesh/facets.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp {

/// \throws InputError for two nodes at one place (to 1e-6 of the mesh's extent), where the mesh is torn, with the place
/// and how many there are
template <ReferenceElement Element>
void require_no_duplicate_nodes(Mesh<Element> const& mesh) {
  constexpr int dim = Element::dim;
  double const same = 1e-6 * extent<dim>(mesh.nodes);
  detail::PlaceIndex<dim> places(4.0 * same);
  std::pair<int, int> first{-1, -1};
  int found = 0;
  for (int n = 0; n < detail::count(mesh.nodes); ++n) {
    auto const& node = mesh.nodes[detail::index(n)];
    if (int const there = places.at(node, same); there < 0) {
      places.add(node, n);
    } else if (++found == 1) {
      first = {there, n};
    }
  }
  if (found == 0) return;
  reject(
      "nodes {} and {} are both at ({}) (the elements there would come apart; {} nodes in all are at the place of "
      "another): merge them, in Gmsh by 'Coherence Mesh'",
      first.first, first.second, listed(mesh.nodes[detail::index(first.first)]), found);
}

namespace detail {

/// Whether a place is on the straight side between corners, but not at one of them.
inline bool is_inside(Vector<2> const& place, std::array<Vector<2>, 2> const& corners, double same) {
  Vector<2> const along = corners[1] - corners[0];
  double const length = along.norm();
  Vector<2> const from = place - corners[0];
  double const way = from.dot(along) / length;
  double const beside = std::abs(from.x() * along.y() - from.y() * along.x()) / length;
  return beside <= same && way > same && way < length - same;
}

/// Whether a place is inside a triangle or, as a ring of corners, a quadrilateral in space, but not at one of its
/// corners.
template <std::size_t Corners>
bool is_inside(Vector<3> const& place, std::array<Vector<3>, Corners> const& corners, double same) {
  for (auto const& corner : corners) {
    if ((place - corner).norm() <= same) return false;
  }
  for (std::size_t k = 2; k < Corners; ++k) {
    Vector<3> const a = corners[k - 1] - corners[0];
    Vector<3> const b = corners[k] - corners[0];
    Vector<3> const from = place - corners[0];
    Vector<3> const normal = a.cross(b);
    double const twice_area = normal.norm();
    double const share_b = normal.dot(a.cross(from)) / (twice_area * twice_area);
    double const share_a = normal.dot(from.cross(b)) / (twice_area * twice_area);
    double const tiny = same * (a.norm() + b.norm()) / twice_area;
    if (std::abs(normal.dot(from)) / twice_area <= same && share_a >= -tiny && share_b >= -tiny &&
        share_a + share_b <= 1.0 + tiny) {
      return true;
    }
  }
  return false;
}

}  // namespace detail

/// Sides count as straight between their corners; only those that no two elements share are looked at, so that the
/// effort is that of the outline.
/// \throws InputError for a corner node inside a side of another element, which would slide along it, naming both
template <ReferenceElement Element>
void require_no_hanging_nodes(Mesh<Element> const& mesh) {
  constexpr int dim = Element::dim;
  constexpr std::size_t corners = LinearOf<Element>::facet_nodes;
  auto const sides = outer_facets(mesh);
  if (sides.empty()) return;
  auto const corners_of = [&](MeshSide<Element> const& side) {
    std::array<Vector<dim>, corners> places;
    for (std::size_t k = 0; k < corners; ++k) places[k] = mesh.nodes[detail::index(side.nodes[k])];
    return places;
  };
  double mean = 0.0;
  std::vector<int> nodes;
  for (auto const& side : sides) {
    auto const places = corners_of(side);
    mean += (places[1] - places[0]).norm() / static_cast<double>(sides.size());
    nodes.insert(nodes.end(), side.nodes.begin(), side.nodes.begin() + corners);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  detail::PlaceIndex<dim> index(2.0 * mean);
  for (int const node : nodes) index.add(mesh.nodes[detail::index(node)], node);
  for (auto const& side : sides) {
    auto const places = corners_of(side);
    Vector<dim> low = places[0];
    Vector<dim> high = places[0];
    for (auto const& place : places) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    double const same = 1e-6 * (high - low).norm();
    Vector<dim> const reach = Vector<dim>::Constant(same);
    index.near(low - reach, high + reach, [&](Vector<dim> const& place, int node) {
      auto const end = side.nodes.begin() + corners;
      if (std::find(side.nodes.begin(), end, node) != end || !detail::is_inside(place, places, same)) return;
      reject(
          "node {} at ({}) hangs: it is a corner inside a side of element {} (nodes {}), which would slide along it: "
          "divide that element, or mesh the parts with common nodes",
          node, listed(place), side.element, listed(mesh.elements[detail::index(side.element)]));
    });
  }
}

}  // namespace scarp
