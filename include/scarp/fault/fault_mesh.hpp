// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "scarp/core/precompiled.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/fault/detail/layer_checks.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/mesh/graded_lines.hpp"
#include "scarp/mesh/pattern_grid.hpp"

namespace scarp {
namespace detail {

/// A slab over a grid in the plane: x stays, the strike becomes y, the plane's y becomes z. Boundaries
/// as BoxMesh names them.
/// nodes: of the plane grid [m]; strike: thickness [m], in so many cells
template <ReferenceElement Element>
Mesh<Element> grid_slab(std::vector<Vector<2>> const& nodes, GridNumbers const& numbers, double strike, int cells) {
  static_assert(Element::dim == 3 && !HasMidSides<Element>);
  auto const to_place = [&](Vector<3> const& counted) -> Vector<3> {  // counted in cells along x and z
    auto const line = [&](int axis) { return static_cast<int>(std::lround(counted(axis))); };
    Vector<2> const place = nodes[index(numbers(line(0), line(2)))];
    return {place.x(), counted.y(), place.y()};
  };
  return BoxMesh<Element>{.lengths = Vector<3>(numbers.columns(), strike, numbers.rows()),
                          .cells = {numbers.columns(), cells, numbers.rows()},
                          .map = to_place}
      .generate();
}

}  // namespace detail

/// Soil layer over a fault: height 0 is bedrock level, `depth` the ground surface, the fault meets bedrock at (tip, 0).
/// The last axis is vertical. A grid, finest in the band where the shear band and its outcrop are expected; a line
/// passes through the tip. Region "soil"; boundaries "left", "right", "bottom", "surface". In space the grid extends
/// along the strike, the second axis, in cells of one length, with "front" (y = 0) and "back".
struct FaultMesh {
  double left = -52.0;                 ///< [m]
  double right = 23.0;                 ///< [m]
  double depth = 25.0;                 ///< thickness of the layer [m]
  double tip = 0.0;                    ///< [m]
  double size = 1.25;                  ///< width of a cell in the band [m]; a crossed cell holds four triangles
  double coarsening = 2.0;             ///< width of a cell at the far side over `size`, from 1
  double band_left = -20.0;            ///< [m]
  double band_right = 5.0;             ///< [m]
  double row_aspect = 1.0;             ///< mean height of a row over `size`
  double row_coarsening = 1.0;         ///< height of the surface row over the bottom row; above 1 is finer at bedrock
  Pattern pattern = Pattern::crossed;  ///< of triangles; for other elements `crossed` and `quads` are the same
  double jitter = 0.0;                 ///< random move of inner nodes over the distance of the nearest, up to 0.3
  std::uint64_t seed = 1;              ///< of the jitter
  double strike = 1.0;                 ///< thickness in space [m]
  int strike_cells = 1;                ///< over the thickness, in space

  /// edges: further x [m] where a grid line must pass, such as the edges of a structure; one that misses the tip or
  /// another edge by round-off is put on it
  /// \throws InputError for sizes that are not positive or finite, a tip or an edge outside the layer, a jitter out of
  /// range, a pattern that the elements cannot follow, and lines closer to each other than a quarter of `size`
  template <ReferenceElement Element = Tri3>
  SCARP_EXPORT Mesh<Element> generate(std::vector<double> const& edges = {}) const;

  /// Number of elements that generate() makes.
  /// \throws InputError as generate() does, but for the jitter
  template <ReferenceElement Element = Tri3>
  int element_count(std::vector<double> const& edges = {}) const {
    check<Element>(edges);
    return count_elements<Element>(edges);
  }

  /// The same layer with the `size` whose number of elements is nearest to the requested one.
  /// \throws InputError for less than one cell or more than ten million elements
  template <ReferenceElement Element = Tri3>
  FaultMesh with_about(int elements) const {
    detail::require_shape(*this);
    if (int const least = elements_per_cell<Element>(pattern) * cells_along_strike<Element>();
        elements < least || elements > max_elements) {
      reject("a mesh of {} elements is requested (from {} to {} are possible): choose another number", elements, least,
             max_elements);
    }
    auto const sized = [this](double size_of_cells) {
      FaultMesh probe = *this;
      probe.size = size_of_cells;
      return probe;
    };
    auto const best = sized(detail::size_for_count(
        elements, 1e-4 * depth, right - left + depth,
        [&](double probe) { return sized(probe).template ideal_elements<Element>(); },
        [&](double probe) { return sized(probe).template count_elements<Element>({}); }));
    best.template check<Element>({});
    return best;
  }

 private:
  static constexpr int max_elements = 10'000'000;

  Spacing columns() const {
    double const from = std::clamp(band_left, left, right);
    double const to = std::clamp(band_right, left, right);
    std::vector<Spacing::Knot> knots;
    if (from > left) {
      knots.push_back({left, size * coarsening});
    }
    knots.push_back({from, size});
    knots.push_back({to, size});
    if (to < right) {
      knots.push_back({right, size * coarsening});
    }
    return Spacing(knots);
  }

  Spacing rows() const {
    double const bottom = 2.0 * size * row_aspect / (1.0 + row_coarsening);
    return Spacing({{0.0, bottom}, {depth, bottom * row_coarsening}});
  }

  std::vector<double> fixed_columns(std::vector<double> const& edges) const {
    double const round_off = 1e-10 * (right - left);
    std::vector<double> fixed{left, tip, right};
    for (double const edge : edges) {
      auto const is_there = [&](double line) { return std::abs(edge - line) < round_off; };
      if (std::none_of(fixed.begin(), fixed.end(), is_there)) fixed.push_back(edge);
    }
    std::sort(fixed.begin(), fixed.end());
    return fixed;
  }

  template <class Element>
  int cells_along_strike() const {
    return Element::dim == 3 ? strike_cells : 1;
  }

  /// Without rounding to whole cells: falls steadily with `size`.
  template <class Element>
  double ideal_elements() const {
    Spacing const spacing = columns();
    return elements_per_cell<Element>(pattern) * cells_along_strike<Element>() *
           (spacing.cells_to(right) - spacing.cells_to(left)) * rows().cells_to(depth);
  }

  template <class Element>
  int count_elements(std::vector<double> const& edges) const {
    Spacing const spacing = columns();
    auto const fixed = fixed_columns(edges);
    int cells = 0;
    for (std::size_t k = 1; k < fixed.size(); ++k) {
      cells += cells_between(spacing, fixed[k - 1], fixed[k]);
    }
    return elements_per_cell<Element>(pattern) * cells_along_strike<Element>() * cells *
           cells_between(rows(), 0.0, depth);
  }

  template <class Element>
  Mesh<Element> corner_mesh(std::vector<Vector<2>> nodes, GridNumbers const& numbers) const {
    if constexpr (Element::dim == 3) {
      auto mesh = detail::grid_slab<Element>(nodes, numbers, strike, strike_cells);
      mesh.boundaries["surface"] = std::move(mesh.boundaries["top"]);
      mesh.boundaries.erase("top");
      return mesh;
    } else {
      Mesh<Element> mesh{std::move(nodes), {}, {}, {"soil"}, {}};
      add_grid_cells(mesh, numbers, pattern, 0);
      GridSides const sides(numbers);
      mesh.boundaries = {
          {"left", sides.left}, {"right", sides.right}, {"bottom", sides.lower}, {"surface", sides.upper}};
      return mesh;
    }
  }

  template <class Element>
  void check(std::vector<double> const& edges) const {
    detail::require_shape(*this);
    detail::require_inside(*this, edges);
    detail::require_apart(fixed_columns(edges), size);
    if (double const ideal = ideal_elements<Element>(); !(ideal <= 1.1 * max_elements)) {
      reject("elements of {} m would give about {:.3g} of them (more than {} are not supported): choose a larger size",
             size, ideal, max_elements);
    }
  }
};

template <ReferenceElement Element>
Mesh<Element> FaultMesh::generate(std::vector<double> const& edges) const {
  check<Element>(edges);
  std::vector<Vector<2>> nodes;
  auto const numbers =
      add_grid_nodes(nodes, graded_lines(columns(), fixed_columns(edges)), graded_lines(rows(), {0.0, depth}));
  jitter_grid(nodes, numbers, jitter, seed);
  return with_nodes_of<Element>(corner_mesh<LinearOf<Element>>(std::move(nodes), numbers));
}

}  // namespace scarp
