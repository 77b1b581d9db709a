// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include "scarp/bvp/constraints.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/fault/detail/step_at_tip.hpp"
#include "scarp/fault/rupture_measures.hpp"

namespace scarp {

/// A fault in the bedrock: how far its two sides move per unit of throw (horizontal, vertical; upwards is positive)
/// and where it meets the bottom of the ground, `tip` [m]. The throw is the vertical part of the slip [m].
template <class Motion>
concept BedrockMotion = requires(Motion const& motion) {
  { motion.tip } -> std::convertible_to<double>;
  { motion.left() } -> std::same_as<Vector<2>>;
  { motion.right() } -> std::same_as<Vector<2>>;
};

/// A fault whose slip changes along its strike: share_along(y) of `left()` and `right()` at the strike y [m].
template <class Motion>
concept ChangesAlongStrike = BedrockMotion<Motion> && requires(Motion const& motion, double y) {
  { motion.share_along(y) } -> std::same_as<double>;
};

/// How far both walls have settled at a throw [m], for the measures of the rupture above.
template <BedrockMotion Motion>
FaultOffset offset_at(Motion const& motion, double fault_throw) {
  return {.tip = motion.tip, .foot = -motion.left().y() * fault_throw, .hanging = -motion.right().y() * fault_throw};
}

/// \throws InputError when no corner of the bottom lies at the tip of a fault
template <class Element>
SCARP_EXPORT void require_node_at_tip(Mesh<Element> const& mesh, double tip) {
  auto const lines = detail::corners_along(mesh, "bottom");
  double const nearest = std::ranges::min(lines, {}, [&](double line) { return std::abs(line - tip); });
  if (std::abs(nearest - tip) <= detail::StepAtTip::same_place * (lines.back() - lines.front())) return;
  reject(
      "the fault tip is at x = {} m (the nearest corner of the mesh's bottom is at {} m): put a node there or move the "
      "tip",
      tip, nearest);
}

/// The sides "left" and "right" of a mesh and its "bottom" move with the two sides of a fault, by amplitude(load
/// factor) in units of throw; in between, at the tip, the bottom follows detail::StepAtTip. The first axis is
/// horizontal, the last vertical; in space the fault strikes along the second, where nothing moves on "front", "back"
/// and the prescribed sides. A motion that changes along its strike moves each node by its share there.
/// \throws InputError for parameters that the motion rejects, a tip outside the bottom, or a mesh without these
/// boundaries
template <BedrockMotion Motion, class Element>
SCARP_EXPORT Constraints bedrock_constraints(Mesh<Element> const& mesh, Motion const& motion, int extra_dofs = 0,
                                             TimeFunction const& amplitude = {}) {
  constexpr int dim = Element::dim;
  Vector<2> const left = motion.left();
  Vector<2> const right = motion.right();
  detail::StepAtTip const step(mesh, motion.tip);
  Constraints constraints(mesh, extra_dofs);
  auto const move = [&](int node, double share) {
    Vector<2> rate = left + share * (right - left);
    if constexpr (dim == 3 && ChangesAlongStrike<Motion>)
      rate *= motion.share_along(mesh.nodes[detail::index(node)](1));
    constraints.move(node, 0, rate.x(), amplitude);
    constraints.move(node, dim - 1, rate.y(), amplitude);
    if constexpr (dim == 3) constraints.fix(node, 1);
  };
  for (int const node : boundary_nodes(mesh, "left")) move(node, 0.0);
  for (int const node : boundary_nodes(mesh, "right")) move(node, 1.0);
  for (int const node : boundary_nodes(mesh, "bottom")) move(node, step.share_at(mesh.nodes[detail::index(node)](0)));
  if constexpr (dim == 3) {
    for (char const* side : {"front", "back"}) {
      for (int const node : boundary_nodes(mesh, side)) constraints.fix(node, 1);
    }
  }
  return constraints;
}

namespace detail {

/// Horizontal slip per throw on a plane that dips by so much [rad], 1/tan(dip); exactly zero for a vertical one.
/// \throws InputError for a dip outside (0, pi/2]
inline double heave_per_throw(double dip) {
  constexpr double vertical = std::numbers::pi / 2.0;
  if (!(dip > 0.0 && dip <= vertical * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()))) {
    reject("the dip is {} rad (a fault dips by more than 0 and at most pi/2): {}", dip,
           dip > vertical && dip <= 90.0 ? "was it given in degrees?" : "choose a dip in this range");
  }
  double const along = std::cos(dip);
  return std::abs(along) < std::numeric_limits<double>::epsilon() ? 0.0 : along / std::sin(dip);
}

}  // namespace detail

/// The hanging wall, right of the tip, slides down the fault plane and away from the footwall, which stays.
struct NormalFault {
  double dip = std::numbers::pi / 3.0;  ///< angle of the fault plane against the horizontal [rad], up to pi/2
  double tip = 0.0;                     ///< where the fault meets the bottom of the ground [m]

  Vector<2> left() const { return Vector<2>::Zero(); }  ///< Zero: the footwall stays.
  /// \throws InputError for a dip outside (0, pi/2]
  Vector<2> right() const { return {detail::heave_per_throw(dip), -1.0}; }
};

static_assert(BedrockMotion<NormalFault>);

/// The hanging wall, right of the tip, is pushed up the fault plane and over the footwall, which stays.
struct ReverseFault {
  double dip = std::numbers::pi / 3.0;  ///< angle of the fault plane against the horizontal [rad], up to pi/2
  double tip = 0.0;                     ///< where the fault meets the bottom of the ground [m]

  Vector<2> left() const { return Vector<2>::Zero(); }  ///< Zero: the footwall stays.
  /// \throws InputError for a dip outside (0, pi/2]
  Vector<2> right() const { return {-detail::heave_per_throw(dip), 1.0}; }
};

static_assert(BedrockMotion<ReverseFault>);

/// A fault that dies out along its strike: all of its slip up to `full_to`, none from `ends_at` on, and half a cosine
/// in between, level at both ends, so that planes of symmetry fit there. In the plane it is the fault itself.
/// \code
/// TaperedSlip<NormalFault>{{.dip = 1.0}, 0.0, 50.0}
/// \endcode
template <BedrockMotion Fault>
struct TaperedSlip : Fault {
  double full_to = 0.0;   ///< [m] along the strike
  double ends_at = 50.0;  ///< [m] along the strike, beyond `full_to`

  /// Share of the slip at y [m], from 1 to 0.
  /// \throws InputError for ends that are not finite or in the wrong order
  double share_along(double y) const {
    if (!(std::isfinite(full_to) && std::isfinite(ends_at) && full_to < ends_at)) {
      reject("the slip is full up to y = {} m and ends at {} m (it dies out along the strike): put the end beyond",
             full_to, ends_at);
    }
    double const beyond = std::clamp((y - full_to) / (ends_at - full_to), 0.0, 1.0);
    return (1.0 + std::cos(std::numbers::pi * beyond)) / 2.0;
  }
};

}  // namespace scarp
