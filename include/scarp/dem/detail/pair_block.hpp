// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/core/index.hpp"
#include "scarp/dem/contact_frame.hpp"
#include "scarp/dem/grain_rows.hpp"
#include "scarp/dem/observation.hpp"

namespace scarp::detail {

/// Loads neighbouring rows of all columns, a lane for each row.
template <class Scalar, int Count, std::size_t Size>
void load_rows(SoaArray<Scalar, Count> const& columns, std::size_t start, std::array<lanes::Pack<Scalar>, Size>& to) {
  for (int k = 0; k < Count; ++k) to[detail::index(k)] = lanes::load(columns.column(k) + start);
}
template <class Scalar>
void load_rows(SoaArray<Scalar, 1> const& columns, std::size_t start, lanes::Pack<Scalar>& to) {
  to = lanes::load(columns.column(0) + start);
}
template <class Scalar, int Count, std::size_t Size>
void store_rows(std::array<lanes::Pack<Scalar>, Size> const& from, std::size_t start,
                SoaArray<Scalar, Count>& columns) {
  for (int k = 0; k < Count; ++k) lanes::store(from[detail::index(k)], columns.column(k) + start);
}
template <class Scalar>
void store_rows(lanes::Pack<Scalar> const& from, std::size_t start, SoaArray<Scalar, 1>& columns) {
  lanes::store(from, columns.column(0) + start);
}

/// Affine spin of a displacement gradient: half its curl.
template <int Dim, class Lanes>
Turning<Dim, Lanes> affine_turn(Tensor<Dim> const& gradient) {
  auto const half_curl = [&](int a, int b) { return broadcast<Lanes>((gradient(a, b) - gradient(b, a)) / 2.0); };
  if constexpr (Dim == 2) {
    return half_curl(1, 0);
  } else {
    return {half_curl(2, 1), half_curl(0, 2), half_curl(1, 0)};
  }
}

/// Both sides of a pair: their rows of data as lanes. Of the first quads of a row only differences are requested: they
/// are taken before the transposition in registers, which then serves both sides.
template <class Layout, class Lanes>
class PairSides {
 public:
  template <class Scalar>
  PairSides(Scalar const* rows, std::int32_t const* first, std::int32_t const* second) {
    auto const read = [=](std::int32_t const* numbers, std::size_t lane, std::size_t quad) {
      return lanes::FourScalars<Scalar>::read(rows + detail::index(numbers[lane]) * Layout::size + 4 * quad);
    };
    for (std::size_t quad = 0; quad < apart_; ++quad) {
      second_[quad] = lanes::from_quads<Scalar>([=](std::size_t lane) {
        auto difference = read(second, lane, quad);
        difference.value -= read(first, lane, quad).value;
        return difference;
      });
    }
    for (std::size_t quad = apart_; quad < second_.size(); ++quad) {
      first_[quad] = lanes::from_quads<Scalar>([=](std::size_t lane) { return read(first, lane, quad); });
      second_[quad] = lanes::from_quads<Scalar>([=](std::size_t lane) { return read(second, lane, quad); });
    }
  }

  Lanes difference(std::size_t k) const { return k / 4 < apart_ ? second(k) : second(k) - first(k); }
  Lanes const& first(std::size_t k) const { return first_[k / 4][k % 4]; }
  Lanes const& second(std::size_t k) const { return second_[k / 4][k % 4]; }

 private:
  static constexpr std::size_t apart_ = Layout::spin / 4;
  std::array<std::array<Lanes, 4>, Layout::size / 4> first_;   // from `apart_` on
  std::array<std::array<Lanes, 4>, Layout::size / 4> second_;  // before `apart_` the differences
};

/// Adds a force on the second grains, and torques on both, to the rows of forces of a pack of pairs.
template <class Layout, class Scalar, class Lanes>
void scatter_plane(Point<2, Lanes> const& force, Lanes const& torque_first, Lanes const& torque_second,
                   std::int32_t const* first, std::int32_t const* second, Scalar* forces) {
  // Rows of (force, torque on the first, torque on the second); the fourth entry of a force row is scratch.
  auto const quads = lanes::to_quads<Scalar>({force[0], force[1], torque_first, torque_second});
  for (std::size_t k = 0; k < Lanes::size(); ++k) {
    Scalar* const on_first = forces + detail::index(first[k]) * Layout::force_size;
    Scalar* const on_second = forces + detail::index(second[k]) * Layout::force_size;
    auto sum = lanes::FourScalars<Scalar>::read(on_first);
    sum.value -= quads[k].value;
    sum.write(on_first);
    sum = lanes::FourScalars<Scalar>::read(on_second);
    sum.value += __builtin_shufflevector(quads[k].value, quads[k].value, 0, 1, 3, 2);
    sum.write(on_second);
  }
}
template <class Layout, class Scalar, class Lanes>
void scatter_space(Point<3, Lanes> const& force, std::array<Lanes, 3> const& torque_first,
                   std::array<Lanes, 3> const& torque_second, std::int32_t const* first, std::int32_t const* second,
                   Scalar* forces) {
  static_assert(Layout::force_size == 8);
  Lanes const none(Scalar(0));
  auto const start = lanes::to_quads<Scalar>({force[0], force[1], force[2], none});
  auto const turn_first = lanes::to_quads<Scalar>({torque_first[0], torque_first[1], torque_first[2], none});
  auto const turn_second = lanes::to_quads<Scalar>({torque_second[0], torque_second[1], torque_second[2], none});
  auto const add = [](Scalar* to, auto const& values, Scalar sign) {
    auto sum = lanes::FourScalars<Scalar>::read(to);
    sum.value += sign * values;
    sum.write(to);
  };
  for (std::size_t k = 0; k < Lanes::size(); ++k) {
    Scalar* const on_first = forces + detail::index(first[k]) * Layout::force_size;
    Scalar* const on_second = forces + detail::index(second[k]) * Layout::force_size;
    add(on_first, start[k].value, Scalar(-1));
    add(on_first + 4, turn_first[k].value, Scalar(-1));
    add(on_second, start[k].value, Scalar(1));
    add(on_second + 4, turn_second[k].value, Scalar(1));
  }
}

/// A block of near pairs on its way through the loop: one array for each number of a pair, small enough for the nearest
/// cache.
template <class Shape, class Law, class Scalar>
struct PairBlock {
  using Layout = RowLayout<Shape, Law>;
  using Lanes = lanes::Pack<Scalar>;
  static constexpr std::size_t size = 64;  ///< pairs
  static constexpr auto axes = static_cast<std::size_t>(Shape::dim);
  static constexpr std::size_t turns = Layout::turns;
  static constexpr std::size_t pose_size = Layout::pose_size;
  /// Whether spins are gathered, which the law needs for motions at the contact.
  static constexpr bool has_spins = Law::inputs.shear || Law::inputs.motion || Law::inputs.moment;

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
  static constexpr std::size_t touch_size = Shape::warm_starts_normal ? 2 + 2 * axes : 0;
  static constexpr std::size_t overlap = torque_second + turns;
  static constexpr std::size_t normal = overlap + 1;
  static constexpr std::size_t arm_first = normal + axes;
  static constexpr std::size_t normal_error = arm_first + axes;
  static constexpr std::size_t count = overlap + touch_size;

  std::array<std::int32_t, size> first;
  std::array<std::int32_t, size> second;
  alignas(64) std::array<std::array<Scalar, size>, count> fields;

  /// Stores the numbers of the first `present` pairs; the others are pairs of grain 0 and `sentinel_row`.
  void name_pairs(std::int32_t const* firsts, std::int32_t const* seconds, std::size_t present,
                  std::int32_t sentinel_row) {
    std::copy(firsts, firsts + present, first.begin());
    std::copy(seconds, seconds + present, second.begin());
    std::fill(first.begin() + static_cast<std::ptrdiff_t>(present), first.end(), 0);
    std::fill(second.begin() + static_cast<std::ptrdiff_t>(present), second.end(), sentinel_row);
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
    if constexpr (Law::inputs.shear || Law::inputs.motion) {
      for (std::size_t a = 0; a < axes; ++a) write(velocity + a, at, sides.difference(Layout::velocity + a));
    }
    if constexpr (has_spins) {
      for (std::size_t k = 0; k < turns; ++k) {
        write(spin_first + k, at, sides.first(Layout::spin + k));
        write(spin_second + k, at, sides.second(Layout::spin + k));
      }
    }
    for (std::size_t k = 0; k < pose_size; ++k) {
      write(pose_first + k, at, sides.first(Layout::pose + k));
      write(pose_second + k, at, sides.second(Layout::pose + k));
    }
    if constexpr (Law::inputs.motion)
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
