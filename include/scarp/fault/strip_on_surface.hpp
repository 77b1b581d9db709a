// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/fault/detail/step_at_tip.hpp"
#include "scarp/mesh/graded_lines.hpp"
#include "scarp/mesh/joined_meshes.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace scarp {

namespace detail {

/// The block's nodes on its base, sought among those of the ground: the same places to the last bit.
template <class Element>
void put_on_base(Mesh<Element>& block, Mesh<Element> const& ground, double same) {
  auto const base = boundary_nodes(ground, "footing_base");
  for (int const node : boundary_nodes(block, "footing_base")) {
    auto& place = block.nodes[index(node)];
    auto const away = [&](int other) { return (ground.nodes[index(other)] - place).norm(); };
    int const nearest = *std::min_element(base.begin(), base.end(), [&](int a, int b) { return away(a) < away(b); });
    if (!(away(nearest) <= same)) {
      reject(
          "the footing's base has no node at x = {}, height {} m (the nearest is at {}, {} m; a side's node must be in "
          "its middle, the base level): mesh the ground again",
          place.x(), place.y(), ground.nodes[index(nearest)].x(), ground.nodes[index(nearest)].y());
    }
    place = ground.nodes[index(nearest)];
  }
}

/// A block that a file brought along: a rectangle, as its weight is that of one.
template <class Element>
void require_block(Mesh<Element> const& mesh, double level, double height) {
  for (int const node : boundary_nodes(mesh, "footing_top")) {
    double const top = mesh.nodes[index(node)].y();
    if (!(std::abs(top - level - height) <= 1e-6 * height)) {
      reject(
          "'footing_top' of the mesh is {} m above the base (the footing is {} m high): give the footing the mesh's "
          "height, or take the region 'footing' out of the mesh",
          top - level, height);
    }
  }
  double const area = region_area(mesh, "footing", mesh.nodes);
  auto const base = corners_along(mesh, "footing_base");
  double const width = base.back() - base.front();
  if (!(std::abs(area - width * height) <= 1e-5 * width * height)) {
    reject(
        "the region 'footing' of the mesh has an area of {:.6g} m2 (a footing of {:.6g} x {:.6g} m has {:.6g}): make "
        "it a rectangle "
        "of that size, or take it out of the mesh",
        area, width, height, width * height);
  }
}

}  // namespace detail

/// Names the part of "surface" below a strip footing "footing_base". A mesh that has one must have it there.
/// centre, width: of the base [m]; places count as the same to 1e-6 of the width, what files with seven digits hold
/// \throws InputError when an edge is at no corner node of the surface, the surface has a gap in between, or the mesh's
/// own base is elsewhere
template <ReferenceElement Element>
void mark_footing_base(Mesh<Element>& mesh, double centre, double width) {
  static_assert(Element::dim == 2, "a strip footing is a structure of the plane");
  require_finite("centre of the footing", centre);
  require_positive("width of the footing", width);
  double const from = centre - width / 2.0;
  double const to = centre + width / 2.0;
  double const same = 1e-6 * width;
  if (mesh.boundaries.count("footing_base") != 0) {
    auto const corners = detail::corners_along(mesh, "footing_base");
    if (std::abs(corners.front() - from) > same || std::abs(corners.back() - to) > same) {
      reject(
          "the mesh has its 'footing_base' from x = {} to {} m (the footing reaches from {} to {} m): set the "
          "footing's "
          "centre and width to the mesh's",
          corners.front(), corners.back(), from, to);
    }
    return;
  }
  auto const corners = detail::corners_along(mesh, "surface");
  detail::require_corner(corners, from, same);
  detail::require_corner(corners, to, same);
  auto& surface = mesh.boundaries["surface"];
  auto const x = [&](int node) { return mesh.nodes[detail::index(node)].x(); };
  auto const below = std::stable_partition(surface.begin(), surface.end(), [&](auto const& facet) {
    return std::abs((x(facet[0]) + x(facet[1])) / 2.0 - centre) > width / 2.0;
  });
  std::vector base(below, surface.end());
  surface.erase(below, surface.end());
  double covered = 0.0;
  for (auto const& facet : base) covered += std::abs(x(facet[1]) - x(facet[0]));
  if (std::abs(covered - width) > 2.0 * same) {
    reject(
        "the surface covers {} m between x = {} and {} m (a footing of {} m stands there): put the footing where the "
        "surface has no gap",
        covered, from, to, width);
  }
  mesh.boundaries["footing_base"] = std::move(base);
}

/// Puts a block on "footing_base" that shares its nodes: region "footing", boundary "footing_top". At least two rows of
/// cells, since one of constant-strain triangles could not bend; triangles are crossed. A region "footing" that the
/// mesh has is taken as it is.
/// height: of the block [m]; size: wanted height of a row [m]
/// \throws InputError for sizes that are not positive, a base that is not level, or a block of another height in the
/// mesh
template <ReferenceElement Element>
void add_footing_block(Mesh<Element>& mesh, double height, double size) {
  static_assert(Element::dim == 2, "a strip footing is a structure of the plane");
  require_positive("height of the footing", height);
  require_positive("element size of the footing", size);
  auto const& base = boundary(mesh, "footing_base");
  double const level = mesh.nodes[detail::index(base.front().front())].y();
  if (std::find(mesh.regions.begin(), mesh.regions.end(), "footing") != mesh.regions.end()) {
    return detail::require_block(mesh, level, height);
  }
  constexpr int min_rows = 2;
  double const top = level + height;
  auto const columns = detail::corners_along(mesh, "footing_base");
  Mesh<LinearOf<Element>> grid;
  grid.regions = {"footing"};
  auto const numbers =
      add_grid_nodes(grid.nodes, columns, graded_lines(Spacing({{level, size}, {top, size}}), {level, top}, min_rows));
  add_grid_cells(grid, numbers, Pattern::crossed, 0);
  GridSides const sides(numbers);
  grid.boundaries = {{"footing_base", sides.lower}, {"footing_top", sides.upper}};
  auto block = with_nodes_of<Element>(std::move(grid));
  detail::put_on_base(block, mesh, 1e-6 * (columns.back() - columns.front()));
  block.boundaries.erase("footing_base");
  join(mesh, block);
}

}  // namespace scarp
