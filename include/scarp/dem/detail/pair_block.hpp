// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/dem/detail/pair_lanes.hpp"
#include "scarp/dem/observation.hpp"

namespace scarp::detail {

/// A block of near pairs on its way through the loop: one array for each number of a pair, small enough for the nearest cache.
template <class Shape, class Law, class Scalar>
struct PairBlock {
  using Layout = RowLayout<Shape, Law>;
  using Lanes = lanes::Pack<Scalar>;
  static constexpr std::size_t size = 64;  ///< pairs
  static constexpr auto axes = static_cast<std::size_t>(Shape::dim);
  static constexpr std::size_t turns = Layout::turns;
  static constexpr std::size_t pose_size = Layout::pose_size;

  // Fields: from grains to the law.
  static constexpr std::size_t branch = 0;
  static constexpr std::size_t velocity = branch + axes;  ///< of the second relative to the first
  static constexpr std::size_t spin_first = velocity + axes;
  static constexpr std::size_t spin_second = spin_first + turns;
  static constexpr std::size_t pose_first = spin_second + turns;
  static constexpr std::size_t pose_second = pose_first + pose_size;
  static constexpr std::size_t inverse_mass = pose_second + pose_size;  ///< sum of both
  // From the law to the grains.
  static constexpr std::size_t force = inverse_mass + 1;
  static constexpr std::size_t torque_first = force + axes;
  static constexpr std::size_t torque_second = torque_first + turns;
  // Where the grains touch; only of shapes that search for the normal.
  static constexpr std::size_t touch_size = Shape::remembers_normal ? 2 + 2 * axes : 0;
  static constexpr std::size_t overlap = torque_second + turns;
  static constexpr std::size_t normal = overlap + 1;
  static constexpr std::size_t arm_first = normal + axes;
  static constexpr std::size_t unsettled = arm_first + axes;
  static constexpr std::size_t count = overlap + touch_size;

  std::array<std::int32_t, size> first;
  std::array<std::int32_t, size> second;
  alignas(64) std::array<std::array<Scalar, size>, count> fields;

  /// Takes the numbers of the first `present` pairs; the others are pairs of grain 0 and `nobody`.
  void name_pairs(std::int32_t const* firsts, std::int32_t const* seconds, std::size_t present, std::int32_t nobody) {
    std::copy(firsts, firsts + present, first.begin());
    std::copy(seconds, seconds + present, second.begin());
    std::fill(first.begin() + static_cast<std::ptrdiff_t>(present), first.end(), 0);
    std::fill(second.begin() + static_cast<std::ptrdiff_t>(present), second.end(), nobody);
  }

  template <std::size_t Count>
  std::array<Lanes, Count> read(std::size_t field, std::size_t at) const {
    std::array<Lanes, Count> values;
    for (std::size_t k = 0; k < Count; ++k) values[k] = lanes::load(fields[field + k].data() + at);
    return values;
  }
  void write(std::size_t field, std::size_t at, Lanes const& value) { lanes::store(value, fields[field].data() + at); }
  template <std::size_t Count>
  void write(std::size_t field, std::size_t at, std::array<Lanes, Count> const& values) {
    for (std::size_t k = 0; k < Count; ++k) write(field + k, at, values[k]);
  }

  /// A pack of pairs from the rows of their grains.
  void gather(Scalar const* rows, std::size_t at) {
    PairSides<Layout, Lanes> const sides(rows, first.data() + at, second.data() + at);
    for (std::size_t a = 0; a < axes; ++a) write(branch + a, at, sides.difference(a));
    if constexpr (Law::needs.shear || Law::needs.motion) {
      for (std::size_t a = 0; a < axes; ++a) write(velocity + a, at, sides.difference(Layout::velocity + a));
    }
    if constexpr (Law::needs.shear || Law::needs.motion || Law::needs.moment) {
      for (std::size_t k = 0; k < turns; ++k) {
        write(spin_first + k, at, sides.first(Layout::spin + k));
        write(spin_second + k, at, sides.second(Layout::spin + k));
      }
    }
    for (std::size_t k = 0; k < pose_size; ++k) {
      write(pose_first + k, at, sides.first(Layout::pose + k));
      write(pose_second + k, at, sides.second(Layout::pose + k));
    }
    if constexpr (Law::needs.motion)
      write(inverse_mass, at, sides.first(Layout::inverse_mass) + sides.second(Layout::inverse_mass));
  }

  /// Adds the forces of a pack of pairs to the rows of forces.
  void scatter(Scalar* forces, std::size_t at) const {
    auto const push = read<axes>(force, at);
    auto const turn_first = read<turns>(torque_first, at);
    auto const turn_second = read<turns>(torque_second, at);
    if constexpr (axes == 2) {
      scatter_plane<Layout>(push, turn_first[0], turn_second[0], first.data() + at, second.data() + at, forces);
    } else {
      scatter_space<Layout>(push, turn_first, turn_second, first.data() + at, second.data() + at, forces);
    }
  }
};

}  // namespace scarp::detail
