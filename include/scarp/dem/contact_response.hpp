// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/host_device.hpp"
#include "scarp/dem/contact_frame.hpp"
#include "scarp/dem/observation.hpp"
#include "scarp/shape/particle_shape.hpp"

namespace scarp {

/// The cell's last move as contacts see it.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <int Dim, class T>
struct CellMove {
  std::array<T, static_cast<std::size_t>(Dim* Dim)> gradient{};  ///< displacement gradient, row by row
  Turning<Dim, T> turn{};                                        ///< affine rotation [rad]
  T duration{};                                                  ///< [s]
  T unapplied{};  ///< 1, or 0 where the contacts' memory contains the move already
};

/// A near pair of grains at its touch.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <class Shape, class T>
struct TouchingPair {
  static constexpr int dim = Shape::dim;  ///< of space

  ContactGeometry<dim, T> touch;  ///< where they touch
  Point<dim, T> branch;           ///< from the first centre to the second [m]
  PoseOf<Shape, T> pose_first;    ///< of the first grain
  PoseOf<Shape, T> pose_second;   ///< of the second grain
  Point<dim, T> velocity{};       ///< fluctuation of the second less that of the first [m/s]
  Turning<dim, T> spin_first{};   ///< [rad/s]
  Turning<dim, T> spin_second{};  ///< [rad/s]
  T inverse_mass{};               ///< sum of both grains' [1/kg], where the law needs motion
};

/// Force on the second grain [N] and torques [N m]; those on the first grain have the other sign, as its force has.
/// \tparam T a floating-point number or a `lanes::BasicPack`
template <int Dim, class T>
struct PairForces {
  Point<Dim, T> force;            ///< [N]
  Turning<Dim, T> torque_first;   ///< [N m]
  Turning<Dim, T> torque_second;  ///< [N m]
  T normal;                       ///< [N], positive where it pushes the grains apart
  T dissipated;                   ///< [J]
};

/// Rotation of a grain during the last move: grains turn with the cell, and their spin is a fluctuation about the
/// affine one.
template <int Dim, class T>
SCARP_HOST_DEVICE constexpr Turning<Dim, T> turn_of(Turning<Dim, T> const& spin, CellMove<Dim, T> const& move) {
  return sum(scaled(spin, move.duration), move.turn);
}

/// Response of a contact law to a near pair: one source for single numbers, packs of pairs and threads of a card.
/// approach: receives what the law saw, its overlap included; memory: of the contact, brought up to date
template <Observe what, class Shape, class Law, class T>
SCARP_HOST_DEVICE constexpr PairForces<Shape::dim, T> contact_response(Law const& law,
                                                                       TouchingPair<Shape, T> const& pair,
                                                                       CellMove<Shape::dim, T> const& move,
                                                                       ContactMemory<Shape::dim, T>& memory,
                                                                       ContactKinematics<Shape::dim, T>& approach) {
  constexpr int dim = Shape::dim;
  constexpr auto axes = static_cast<std::size_t>(dim);
  auto const& n = pair.touch.normal;
  approach.overlap = pair.touch.overlap;
  auto const turn_first = turn_of<dim, T>(pair.spin_first, move);
  auto const turn_second = turn_of<dim, T>(pair.spin_second, move);
  auto const twist = scaled(scaled(sum(turn_first, turn_second), broadcast<T>(0.5)), move.unapplied);
  if constexpr (Law::inputs.shear || Law::inputs.motion) {
    auto const swing_first = turned_motion(turn_first, pair.touch.arm_first);
    auto const swing_second = turned_motion(turn_second, pair.touch.arm_second);
    Point<dim, T> meeting{};  // relative motion at the contact point
    for (std::size_t a = 0; a < axes; ++a) {
      meeting[a] = pair.velocity[a] * move.duration + swing_second[a] - swing_first[a];
      for (std::size_t b = 0; b < axes; ++b) meeting[a] += move.gradient[a * axes + b] * pair.branch[b];
    }
    auto const slip = tangential_part(meeting, n);
    if constexpr (Law::inputs.shear) {
      approach.slip_increment = slip;
      if constexpr (dim == 3) carry_to_frame(memory.shear, twist, n);
    }
    if constexpr (Law::inputs.motion) {
      approach.overlap_increment = -dot(meeting, n);
      approach.tangential_increment = slip;
      if constexpr (Law::inputs.shear) approach.slip_increment = scaled(approach.slip_increment, move.unapplied);
      approach.reduced_mass = broadcast<T>(1.0) / pair.inverse_mass;
      approach.time_step = move.duration;
    }
  }
  if constexpr (Law::inputs.moment) {
    approach.rotation_increment = rolling_part(difference(turn_second, turn_first), n);
    if constexpr (Law::inputs.motion) approach.rotation_increment = scaled(approach.rotation_increment, move.unapplied);
    if constexpr (dim == 3) carry_to_frame(memory.moment, twist, n);
  }
  if constexpr (Law::inputs.radius || what != Observe::nothing) {
    T const radius_first = Shape::contact_radius(pair.pose_first);
    T const radius_second = Shape::contact_radius(pair.pose_second);
    approach.reduced_radius = radius_first * radius_second / (radius_first + radius_second);
  }
  if constexpr (Law::inputs.species > 0)
    approach.species = {Shape::species(pair.pose_first), Shape::species(pair.pose_second)};
  auto const forces = law.respond(approach, memory);

  PairForces<dim, T> response{};
  for (std::size_t a = 0; a < axes; ++a) response.force[a] = forces.normal * n[a];
  if constexpr (Law::inputs.shear) {
    auto const shear = as_vector(forces.shear, n);
    for (std::size_t a = 0; a < axes; ++a) response.force[a] += shear[a];
  }
  response.torque_first = cross(pair.touch.arm_first, response.force);
  response.torque_second = cross(pair.touch.arm_second, response.force);
  if constexpr (Law::inputs.moment) {
    response.torque_first = sum(response.torque_first, forces.moment);
    response.torque_second = sum(response.torque_second, forces.moment);
  }
  response.normal = forces.normal;
  response.dissipated = forces.dissipated;
  return response;
}

/// The axis (cos, sin) of a plane grain after a turn [rad]. Cayley's rotation keeps it a unit vector to round-off.
template <class T>
SCARP_HOST_DEVICE constexpr std::array<T, 2> turned_axis(std::array<T, 2> const& axis, T const& turn) {
  T const one = broadcast<T>(1.0);
  T const half = turn * broadcast<T>(0.5);
  T const scale = one / (one + half * half);
  T const c = (one - half * half) * scale;
  T const s = broadcast<T>(2.0) * half * scale;
  return {axis[0] * c - axis[1] * s, axis[0] * s + axis[1] * c};
}

}  // namespace scarp
