// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>

#include "scarp/mesh/crossed_grid.hpp"
#include "scarp/mesh/graded_lines.hpp"

namespace scarp {

/// Block on the ground surface that shares the surface's nodes (tied, no slip), or the place of one beside the mesh. [m]
struct Footing {
  double centre = 0.0;  ///< horizontal position
  double width = 0.0;
  double height = 0.0;
  bool meshed = true;  ///< otherwise only its place is marked, and the height does not matter
};

/// Soil layer over a fault: y = 0 is bedrock level, y = depth the ground surface, the fault meets bedrock at (tip, 0).
/// Crossed triangles, finest in the band where the shear band and its outcrop are expected; vertical grid lines pass
/// through the tip and the edges of the footing. Regions "soil" and, with a meshed footing, "footing"; boundaries "left",
/// "right", "bottom", "surface" (ground that nothing covers), "footing_base" (the ground below it), "footing_top".
struct FaultMesh {
  double left = -52.0;          ///< [m]
  double right = 23.0;          ///< [m]
  double depth = 25.0;          ///< thickness of the layer [m]
  double tip = 0.0;             ///< [m]
  double size = 1.25;           ///< width of a cell in the band [m]; a cell holds four triangles
  double coarsening = 2.0;      ///< width of a cell at the far side over `size`, from 1
  double band_left = -20.0;     ///< [m]
  double band_right = 5.0;      ///< [m]
  double row_aspect = 1.0;      ///< mean height of a row over `size`
  double row_coarsening = 1.0;  ///< height of the surface row over the bottom row; above 1 is finer at bedrock
  std::optional<Footing> footing{};

  /// \throws InputError for sizes that are not positive or finite, a tip outside the bottom, a footing that does not
  /// stand on the surface, and grid lines closer to each other than a quarter of `size`
  Mesh<Tri3> generate() const {
    check();
    auto const xs = graded_lines(columns(), fixed_columns());
    auto const ys = graded_lines(rows(), {0.0, depth});
    int const last_column = detail::count(xs) - 1;
    int const last_row = detail::count(ys) - 1;
    Mesh<Tri3> mesh;
    mesh.regions = {"soil"};
    GridNumbers numbers(last_column + 1, last_row + 1);
    add_crossed_grid(mesh, xs, ys, numbers, 0);
    mesh.boundaries["left"] = left_facets(numbers, last_row);
    mesh.boundaries["right"] = right_facets(numbers, last_column, last_row);
    mesh.boundaries["bottom"] = lower_facets(numbers, 0, last_column);
    if (!footing) {
      mesh.boundaries["surface"] = upper_facets(numbers, 0, last_column, last_row);
    } else {
      add_footing(mesh, xs, numbers, last_row);
    }
    validate(mesh);
    return mesh;
  }

  /// Number of triangles that generate() makes.
  int triangle_count() const {
    check();
    return count_triangles();
  }

  /// The same scene with the `size` whose number of triangles is nearest to the asked one.
  /// \throws InputError for fewer than 4 or more than ten million triangles
  FaultMesh with_about(int triangles) const {
    check_shape();
    if (triangles < 4 || triangles > most_triangles) {
      refuse("a mesh of {} triangles is asked for (from 4 to {} are possible): choose another number", triangles,
             most_triangles);
    }
    FaultMesh probe = *this;
    double fine = 1e-4 * depth;
    double coarse = right - left + depth;
    for (int k = 0; k < 60; ++k) {
      probe.size = std::sqrt(fine * coarse);
      (probe.ideal_triangles() > triangles ? fine : coarse) = probe.size;
    }
    double const middle = std::sqrt(fine * coarse);
    FaultMesh best = probe;
    best.size = middle;
    constexpr int reach = 500;  // the count jumps by a row or column at a time: look up to 10 % to both sides
    for (int k = 1; k <= 2 * reach; ++k) {
      int const step = (k % 2 == 0 ? 1 : -1) * (k + 1) / 2;
      probe.size = middle * (1.0 + 0.1 * step / reach);
      if (std::abs(probe.count_triangles() - triangles) < std::abs(best.count_triangles() - triangles)) {
        best = probe;
      }
    }
    best.check();
    return best;
  }

 private:
  static constexpr int most_triangles = 10'000'000;
  static constexpr int footing_rows = 2;  // one row of constant-strain triangles could not bend

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

  /// side: -1 left, +1 right; an edge that misses the tip by round-off only is put on it
  double footing_edge(double side) const {
    double const edge = footing->centre + side * footing->width / 2.0;
    return std::abs(edge - tip) < 1e-9 * footing->width ? tip : edge;
  }

  std::vector<double> fixed_columns() const {
    std::vector<double> fixed{left, tip, right};
    if (footing) {
      fixed.push_back(footing_edge(-1.0));
      fixed.push_back(footing_edge(+1.0));
    }
    std::sort(fixed.begin(), fixed.end());
    fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
    return fixed;
  }

  Spacing footing_spacing() const { return Spacing({{depth, size}, {depth + footing->height, size}}); }

  bool has_meshed_footing() const { return footing && footing->meshed; }

  int footing_row_count() const {
    return cells_between(footing_spacing(), depth, depth + footing->height, footing_rows);
  }

  /// Without rounding to whole cells: falls steadily with `size`. The footing counts little and is left out.
  double ideal_triangles() const {
    Spacing const spacing = columns();
    return 4.0 * (spacing.cells_to(right) - spacing.cells_to(left)) * rows().cells_to(depth);
  }

  int count_triangles() const {
    Spacing const spacing = columns();
    auto const fixed = fixed_columns();
    int cells = 0;
    int under_footing = 0;
    for (std::size_t k = 1; k < fixed.size(); ++k) {
      int const added = cells_between(spacing, fixed[k - 1], fixed[k]);
      cells += added;
      if (footing && std::abs((fixed[k - 1] + fixed[k]) / 2.0 - footing->centre) < footing->width / 2.0) {
        under_footing += added;
      }
    }
    return 4 * (cells * cells_between(rows(), 0.0, depth) +
                (has_meshed_footing() ? under_footing * footing_row_count() : 0));
  }

  void add_footing(Mesh<Tri3>& mesh, std::vector<double> const& xs, GridNumbers const& soil, int last_row) const {
    auto const line = [&](double x) { return static_cast<int>(std::find(xs.begin(), xs.end(), x) - xs.begin()); };
    int const first = line(footing_edge(-1.0));
    int const end = line(footing_edge(+1.0));
    auto& surface = mesh.boundaries["surface"];
    surface = upper_facets(soil, 0, first, last_row);
    auto const beyond = upper_facets(soil, end, detail::count(xs) - 1, last_row);
    surface.insert(surface.end(), beyond.begin(), beyond.end());
    mesh.boundaries["footing_base"] = upper_facets(soil, first, end, last_row);
    if (!has_meshed_footing()) return;
    std::vector<double> const xs_above(xs.begin() + first, xs.begin() + end + 1);
    auto const ys_above = graded_lines(footing_spacing(), {depth, depth + footing->height}, footing_rows);
    int const rows_above = detail::count(ys_above) - 1;
    GridNumbers numbers(end - first + 1, rows_above + 1);
    for (int i = first; i <= end; ++i) {
      numbers(i - first, 0) = soil(i, last_row);
    }
    mesh.regions.emplace_back("footing");
    add_crossed_grid(mesh, xs_above, ys_above, numbers, 1);
    mesh.boundaries["footing_top"] = upper_facets(numbers, 0, end - first, rows_above);
  }

  void check() const {
    check_shape();
    check_lines();
  }

  void check_shape() const {
    require_finite("left end of the layer", left);
    require_finite("right end of the layer", right);
    require_positive("depth of the layer", depth);
    require_positive("element size", size);
    require_positive("row aspect", row_aspect);
    require_positive("row coarsening", row_coarsening);
    if (!(left < right)) {
      refuse("the layer reaches from x = {} to {} m (it has no width): put left below right", left, right);
    }
    if (!(tip > left && tip < right)) {
      refuse("the fault tip is at x = {} m (the layer's bottom reaches from {} to {} m): move the tip between them",
             tip, left, right);
    }
    if (!(std::isfinite(coarsening) && coarsening >= 1.0)) {
      refuse("the coarsening is {} (cells grow away from the band): give a number from 1", coarsening);
    }
    if (!(std::isfinite(band_left) && std::isfinite(band_right) && band_left < band_right && band_left < right &&
          band_right > left)) {
      refuse("the fine band reaches from x = {} to {} m (it must overlap the layer, {} to {} m): move it", band_left,
             band_right, left, right);
    }
    check_footing();
  }

  void check_footing() const {
    if (!footing) {
      return;
    }
    require_finite("centre of the footing", footing->centre);
    require_positive("width of the footing", footing->width);
    if (footing->meshed) require_positive("height of the footing", footing->height);
    double const from = footing_edge(-1.0);
    double const to = footing_edge(+1.0);
    if (!(from > left && to < right)) {
      refuse("the footing reaches from x = {} to {} m (the surface reaches from {} to {} m): move or narrow it", from,
             to, left, right);
    }
  }

  void check_lines() const {
    auto const fixed = fixed_columns();
    for (std::size_t k = 1; k < fixed.size(); ++k) {
      if (fixed[k] - fixed[k - 1] < size / 4.0) {
        refuse(
            "grid lines are needed at x = {} and {} m (closer than a quarter of the element size {} m, the elements "
            "would be slivers): choose smaller elements, or move the footing or the tip",
            fixed[k - 1], fixed[k], size);
      }
    }
    if (!(ideal_triangles() <= 1.1 * most_triangles)) {
      refuse(
          "elements of {} m would give about {:.3g} triangles (more than {} are not supported): choose a larger size",
          size, ideal_triangles(), most_triangles);
    }
  }
};

}  // namespace scarp
