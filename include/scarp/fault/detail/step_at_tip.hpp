// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/mesh/mid_side_nodes.hpp"

namespace scarp::detail {

/// Positions along the first axis [m] of the corner nodes on some boundary, increasing, each once; those that differ by
/// less than 1e-9 of the boundary's length are one.
template <class Element>
std::vector<double> corners_along(Mesh<Element> const& mesh, std::string_view name) {
  constexpr std::size_t corners = LinearOf<Element>::facet_nodes;
  std::vector<double> places;
  for (auto const& facet : boundary(mesh, name)) {
    for (std::size_t k = 0; k < corners; ++k) places.push_back(mesh.nodes[index(facet[k])](0));
  }
  std::sort(places.begin(), places.end());
  double const same = 1e-9 * (places.back() - places.front());
  places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a <= same; }),
               places.end());
  return places;
}

/// corners: of the surface, increasing [m]; edge: of a structure [m]
inline void require_corner(std::vector<double> const& corners, double edge, double same) {
  auto by_distance = corners;
  std::sort(by_distance.begin(), by_distance.end(),
            [&](double a, double b) { return std::abs(a - edge) < std::abs(b - edge); });
  if (!by_distance.empty() && std::abs(by_distance.front() - edge) <= same) return;
  by_distance.resize(std::min<std::size_t>(by_distance.size(), 2));
  reject(
      "the edge of a structure at x = {} m is at no corner node of the surface (the nearest are at {} m): move the "
      "edge there, or mesh the ground with a node below the edge",
      edge, listed(by_distance, " and ", "{:.7g}"));
}

/// A unit step of the bottom at the tip of a fault, in the shapes of the mesh. The shapes cannot jump, so the nodes
/// next to the tip have values whose interpolant has the step's moments \f$ \int (u - u_h)\, x^k\, dx = 0 \f$ about
/// the tip: k = 0 with linear facets, k = 0, 1, 2 with quadratic ones; where both facets are equally long that is half
/// at the tip, and 0 and 1 in their middles. Away from the tip only moments matter, so the step lowers no
/// element's order of convergence. A tip between two lines of nodes is a mean of steps at these two.
class StepAtTip {
 public:
  static constexpr double same_place = 1e-6;  ///< of the bottom's length: what files with seven digits hold

  /// \throws InputError for a tip outside the bottom or on its outermost facets
  template <class Element>
  StepAtTip(Mesh<Element> const& mesh, double tip) : is_quadratic_(HasMidSides<Element>) {
    auto const lines = corners_along(mesh, "bottom");
    if (!(tip > lines.front() && tip < lines.back())) {
      reject("the fault tip is at x = {} m (the mesh's bottom reaches from {} to {} m): move the tip between them", tip,
             lines.front(), lines.back());
    }
    round_off_ = 1e-9 * (lines.back() - lines.front());
    double const same = same_place * (lines.back() - lines.front());
    std::size_t before = 0;  // the last line at the tip or left of it
    while (before + 2 < lines.size() && lines[before + 1] <= tip + same) ++before;
    double const share = (tip - lines[before]) / (lines[before + 1] - lines[before]);
    bool const on_line = std::abs(tip - lines[before]) <= same;
    if (before == 0 || before + (on_line ? 1 : 2) >= lines.size()) {
      reject(
          "the fault tip is at x = {} m (in the outermost facet of the bottom, {} to {} m, whose end moves with the "
          "side): move the tip inwards or make the mesh finer there",
          tip, lines[before], lines[before + 1]);
    }
    add(lines, before, on_line ? 1.0 : 1.0 - share);
    if (!on_line) add(lines, before + 1, share);
  }

  /// Share of the step of a bottom node at x [m]: 0 left of the tip, 1 right of it.
  double share_at(double x) const {
    double sum = 0.0;
    for (auto const& part : parts_) sum += part.weight * share_of(part, x);
    return sum;
  }

 private:
  /// A step at a line of nodes: values there and in the middles of the facets before and after it.
  struct Part {
    double weight, line, to_left, to_right;
    double before, at, after;
  };

  void add(std::vector<double> const& lines, std::size_t line, double weight) {
    double const l = lines[line] - lines[line - 1];
    double const r = lines[line + 1] - lines[line];
    Part part{weight, lines[line], l, r, 0.0, r / (l + r), 1.0};
    if (is_quadratic_) {
      // Integrals over a facet of its shapes times 1, x, x^2, x from the tip's node: middle 2/3, 1/3, 1/5; node at the
      // tip 1/6, 0, -1/60; node at the other end 1/6, 1/6, 3/20. The three unknowns follow in closed form.
      part.before = r * r * (l - r) / (4.0 * std::pow(l + r, 3));
      part.at -= 4.0 * part.before * l / r;
      part.after += part.before * l * l / (r * r);
    }
    parts_.push_back(part);
  }

  double share_of(Part const& part, double x) const {
    double const from = x - part.line;
    if (std::abs(from) <= round_off_) return part.at;
    if (from < 0.0) return from > -part.to_left + round_off_ ? part.before : 0.0;
    return from < part.to_right - round_off_ ? part.after : 1.0;
  }

  bool is_quadratic_;
  double round_off_ = 0.0;
  std::vector<Part> parts_;
};

}  // namespace scarp::detail
