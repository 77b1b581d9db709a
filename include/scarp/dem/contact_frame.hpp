// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/contact/contact_law.hpp"
#include "scarp/shape/particle_shape.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Motion of a point at `arm` from the centre of a grain that turns by a small `turn`.
template <class T>
constexpr std::array<T, 2> turned_motion(T const& turn, std::array<T, 2> const& arm) {
  return {-turn * arm[1], turn * arm[0]};
}
/// Motion of a point at `arm` from the centre of a grain that turns by a small vector `turn`.
template <class T>
constexpr std::array<T, 3> turned_motion(std::array<T, 3> const& turn, std::array<T, 3> const& arm) {
  return cross(turn, arm);
}

/// Part of a motion along the tangent, for the plane t = (-n_y, n_x), or in the tangent plane.
template <class T>
constexpr T tangential_part(std::array<T, 2> const& motion, std::array<T, 2> const& normal) {
  return normal[0] * motion[1] - normal[1] * motion[0];
}
/// Part of a motion in the tangent plane.
template <class T>
constexpr std::array<T, 3> tangential_part(std::array<T, 3> const& motion, std::array<T, 3> const& normal) {
  T const along = dot(motion, normal);
  return {motion[0] - along * normal[0], motion[1] - along * normal[1], motion[2] - along * normal[2]};
}

/// A tangential quantity as a vector.
template <class T>
constexpr std::array<T, 2> as_vector(T const& tangential, std::array<T, 2> const& normal) {
  return {-tangential * normal[1], tangential * normal[0]};
}
/// In space tangential quantities are vectors already.
template <class T>
constexpr std::array<T, 3> as_vector(std::array<T, 3> const& tangential, std::array<T, 3> const&) {
  return tangential;
}

/// Rotation without its part about the normal, which is twist. In the plane all rotation is rolling.
template <class T>
constexpr T rolling_part(T const& turn, std::array<T, 2> const&) {
  return turn;
}
/// Part of a rotation vector in the tangent plane.
template <class T>
constexpr std::array<T, 3> rolling_part(std::array<T, 3> const& turn, std::array<T, 3> const& normal) {
  return tangential_part(turn, normal);
}

/// Carries a stored tangential force or rolling moment to the present frame of its contact: it turns with the mean
/// rotation about the normal, is laid into the tangent plane and keeps its size. In the plane the number stays.
template <class T>
constexpr void carry_to_frame(T&, T const&, std::array<T, 2> const&) {}
/// In space: turns the stored vector by the twist of `mean_turn` [rad], lays it into the tangent plane and restores its
/// size.
template <class T>
constexpr void carry_to_frame(std::array<T, 3>& remembered, std::array<T, 3> const& mean_turn,
                              std::array<T, 3> const& normal) {
  using std::sqrt;
  T const twist = dot(mean_turn, normal);
  auto const laid = tangential_part(sum(remembered, scaled(cross(normal, remembered), twist)), normal);
  T const scale = sqrt(dot(remembered, remembered) / lanes::at_least(dot(laid, laid), smallest_normal<T>()));
  remembered = scaled(laid, scale);
}

}  // namespace scarp
