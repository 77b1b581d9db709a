// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/detail/contact_frame.hpp"
#include "scarp/dem/detail/grain_rows.hpp"

namespace scarp::detail {

/// Rows of columns as lanes, one number or several.
template <class Scalar, int Count, std::size_t Size>
void load_rows(Columns<Scalar, Count> const& columns, std::size_t start, std::array<lanes::Pack<Scalar>, Size>& to) {
  for (int k = 0; k < Count; ++k) to[detail::index(k)] = lanes::load(columns.column(k) + start);
}
template <class Scalar>
void load_rows(Columns<Scalar, 1> const& columns, std::size_t start, lanes::Pack<Scalar>& to) {
  to = lanes::load(columns.column(0) + start);
}
template <class Scalar, int Count, std::size_t Size>
void store_rows(std::array<lanes::Pack<Scalar>, Size> const& from, std::size_t start, Columns<Scalar, Count>& columns) {
  for (int k = 0; k < Count; ++k) lanes::store(from[detail::index(k)], columns.column(k) + start);
}
template <class Scalar>
void store_rows(lanes::Pack<Scalar> const& from, std::size_t start, Columns<Scalar, 1>& columns) {
  lanes::store(from, columns.column(0) + start);
}

/// Affine spin of a displacement gradient: half its curl.
template <int Dim, class Lanes>
Turning<Dim, Lanes> affine_turn(Tensor<Dim> const& gradient) {
  auto const half_curl = [&](int a, int b) { return constant<Lanes>((gradient(a, b) - gradient(b, a)) / 2.0); };
  if constexpr (Dim == 2) {
    return half_curl(1, 0);
  } else {
    return {half_curl(2, 1), half_curl(0, 2), half_curl(1, 0)};
  }
}

/// Both sides of a pair: their rows of data as lanes. Of the first quads of a row only differences are asked for: they are
/// taken before the transposition in registers, which then serves both sides.
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

template <class Lanes>
Lanes difference(Lanes const& a, Lanes const& b) {
  return a - b;
}
template <class Lanes>
std::array<Lanes, 3> difference(std::array<Lanes, 3> const& a, std::array<Lanes, 3> const& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Lanes>
Lanes sum(Lanes const& a, Lanes const& b) {
  return a + b;
}
template <class Lanes>
std::array<Lanes, 3> sum(std::array<Lanes, 3> const& a, std::array<Lanes, 3> const& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Lanes>
Lanes mean(Lanes const& a, Lanes const& b) {
  return (a + b) * constant<Lanes>(0.5);
}
template <class Lanes>
std::array<Lanes, 3> mean(std::array<Lanes, 3> const& a, std::array<Lanes, 3> const& b) {
  return {mean(a[0], b[0]), mean(a[1], b[1]), mean(a[2], b[2])};
}

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

}  // namespace scarp::detail
