// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scarp/bvp/constraints.hpp"

namespace scarp {

/// Normal fault in the bedrock below the mesh: the hanging wall, right of the tip, slides down the fault plane and
/// away from the foot wall. The load factor is the throw h [m], the vertical part of the slip, positive downwards.
struct FaultBlock {
  double dip = std::numbers::pi / 3.0;  ///< angle of the fault plane against the horizontal [rad], up to pi/2
  double tip = 0.0;                     ///< horizontal position where the fault meets the bottom of the mesh [m]

  /// Bottom nodes right of the tip and the whole side "right" move by (h / tan(dip), -h); bottom nodes up to the tip
  /// and the side "left" stay; throw = course(load factor). The first axis is horizontal, the last vertical; in 3D the fault strikes along the other.
  /// \throws InputError for a dip outside (0, pi/2], a tip outside the bottom, or a mesh without these boundaries
  template <class Element>
  Constraints constraints(Mesh<Element> const& mesh, int extra_dofs = 0, TimeFunction const& course = {}) const {
    check_dip();
    auto const bottom = boundary_nodes(mesh, "bottom");
    auto const x_of = [&](int node) { return mesh.nodes[detail::index(node)](0); };
    auto const [first, last] =
        std::minmax_element(bottom.begin(), bottom.end(), [&](int a, int b) { return x_of(a) < x_of(b); });
    if (bottom.empty() || !(tip > x_of(*first) && tip < x_of(*last))) {
      refuse("the fault tip is at x = {} m (the mesh's bottom reaches from {} to {} m): move the tip between them", tip,
             bottom.empty() ? 0.0 : x_of(*first), bottom.empty() ? 0.0 : x_of(*last));
    }
    double const round_off = 1e-9 * (x_of(*last) - x_of(*first));  // a node on the tip belongs to the foot wall
    Constraints constraints(mesh, extra_dofs);
    for (int const node : boundary_nodes(mesh, "left")) {
      constraints.fix(node);
    }
    for (int const node : boundary_nodes(mesh, "right")) {
      move_with_hanging_wall(constraints, node, Element::dim, course);
    }
    for (int const node : bottom) {
      if (x_of(node) > tip + round_off) {
        move_with_hanging_wall(constraints, node, Element::dim, course);
      } else {
        constraints.fix(node);
      }
    }
    return constraints;
  }

  /// Horizontal displacement per throw, 1/tan(dip); exactly zero for a vertical fault.
  double heave() const {
    double const along = std::cos(dip);
    return std::abs(along) < std::numeric_limits<double>::epsilon() ? 0.0 : along / std::sin(dip);
  }

 private:
  void check_dip() const {
    constexpr double vertical = std::numbers::pi / 2.0;
    if (!(dip > 0.0 && dip <= vertical * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()))) {
      refuse("the dip is {} rad (a normal fault dips by more than 0 and at most pi/2): {}", dip,
             dip > vertical && dip <= 90.0 ? "was it given in degrees?" : "choose a dip in this range");
    }
  }

  void move_with_hanging_wall(Constraints& constraints, int node, int dim, TimeFunction const& course) const {
    for (int axis = 1; axis + 1 < dim; ++axis) {
      constraints.fix(node, axis);
    }
    constraints.move(node, 0, heave(), course);
    constraints.move(node, dim - 1, -1.0, course);
  }
};

}  // namespace scarp
