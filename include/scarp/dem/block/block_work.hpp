// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/block/block_bench.hpp"
#include "scarp/dem/block/small_tensor.hpp"
#include "scarp/dem/block/team.hpp"
#include "scarp/shape/converged_contact.hpp"

namespace scarp {

/// A touch whose normal was iterated.
template <int Dim>
struct ConvergedTouch {
  ContactGeometry<Dim, double> touch;  ///< by the last step of the iteration
  bool is_certain;                     ///< whether its overlap is the least: else a slow search must decide
};

/// Touch of a pair as `converged_contact` finds it; shapes with an inner radius do without the slow search, which they
/// seldom need.
template <class Shape>
SCARP_HOST_DEVICE constexpr ConvergedTouch<Shape::dim> converged_touch(PoseOf<Shape> const& first,
                                                                       PoseOf<Shape> const& second,
                                                                       Point<Shape::dim, double> const& branch,
                                                                       Point<Shape::dim, double> const& start) {
  auto touch = Shape::touch(first, second, branch, start);
  if constexpr (!Shape::warm_starts_normal) {
    return {touch, true};
  } else {
    constexpr int max_iterations = 30;
    bool stands = detail::stands_still<Shape::dim>(touch, start);
    for (int k = 0; k < max_iterations && !stands; ++k) {
      auto const before = touch.normal;
      touch = Shape::touch(first, second, branch, before);
      stands = detail::stands_still<Shape::dim>(touch, before);
    }
    bool is_certain = stands && touch.overlap <= 0.0;
    if constexpr (HasInnerRadius<Shape>) {
      is_certain = stands && touch.overlap < Shape::inner_radius(first) + Shape::inner_radius(second);
    } else if constexpr (HasSupport<Shape>) {
      constexpr std::size_t directions = 64;  // 9 kB of a thread's own memory
      detail::MinimumTranslation<Shape, directions> search(first, second, branch);
      if (!is_certain) is_certain = stands && search.is_least_along(touch.normal);
      if (!is_certain && search.search()) {
        touch = search.touch();
        is_certain = touch.overlap - touch.overlap == 0.0;
      }
    }
    touch.normal_error = 0.0;
    return {touch, is_certain};
  }
}

/// What the threads of a block know alike, and where their shared memory is.
/// \tparam TypesOf a `BlockTypes`
/// \tparam TeamOf a `WorksTogether`
template <class TypesOf, class TeamOf>
struct BlockWork {
  using Types = TypesOf;                                       ///< numbers of grains and pairs
  using Team = TeamOf;                                         ///< threads
  using Shape = typename Types::Shape;                         ///< of the grains
  using Law = typename Types::Law;                             ///< of the contacts
  using Scalar = typename Types::Scalar;                       ///< of coordinates and velocities
  static constexpr int dim = Types::dim;                       ///< of space
  static constexpr auto axes = static_cast<std::size_t>(dim);  ///< of space
  using Shift = std::array<int, axes>;                         ///< cells between a grain and its image

  Team team;                                       ///< that works
  BlockBench<Types, typename Team::Memory> bench;  ///< shared memory
  BlockGrains<Types> grains;                       ///< what never changes of the grains
  Law law;                                         ///< of the contacts
  int grain_count = 0;                             ///< in the packing
  int pair_count = 0;                              ///< in the list
  detail::SmallTensor<dim> cell{};                 ///< base vectors as columns [m]
  double drift = 0.0;                              ///< see VerletList [m]
  double skin = 0.0;                               ///< see VerletList [m]
  double reach = 0.0;                              ///< of the law [m]
  double critical_step = 0.0;                      ///< [s]
  Trouble trouble = Trouble::none;                 ///< why the response ends early

  /// What the contact search sees of a part of a grain.
  template <class T>
  SCARP_HOST_DEVICE constexpr PoseOf<Shape, T> pose(int row) const {
    PoseOf<Shape, T> values{};
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<T>(bench.pose(k, row));
    return values;
  }
  /// Stored normal of a pair; zero of shapes that store none.
  template <class T>
  SCARP_HOST_DEVICE constexpr Point<dim, T> normal(int pair) const {
    Point<dim, T> values{};
    if constexpr (Types::normals > 0) {
      for (std::size_t a = 0; a < axes; ++a) values[a] = static_cast<T>(bench.normal(a, pair));
    }
    return values;
  }
  /// From the centre of one grain to that of an image of another [m].
  template <class T>
  SCARP_HOST_DEVICE constexpr Point<dim, T> branch(int first, int second, int shift) const {
    Point<dim, T> values{};
    for (std::size_t a = 0; a < axes; ++a) {
      values[a] = (static_cast<T>(bench.position(a, second)) + static_cast<T>(bench.offset(a, shift))) -
                  static_cast<T>(bench.position(a, first));
    }
    return values;
  }
  /// Writes where images lie; to be followed by a barrier.
  SCARP_HOST_DEVICE constexpr void write_offsets() {
    each(team, Types::shifts, [&](int code) {
      auto const cells = shift_of(code);
      for (std::size_t a = 0; a < axes; ++a) {
        double offset = 0.0;
        for (std::size_t k = 0; k < axes; ++k) offset += cell[a * axes + k] * static_cast<double>(cells[k]);
        bench.offset(a, code) = static_cast<Scalar>(offset);
      }
    });
  }

  /// Writes what the contact search sees of all parts of a grain. orientation: columns of all grains' orientations
  SCARP_HOST_DEVICE constexpr void write_pose(Scalar const* orientation, int i) const {
    std::array<Scalar, static_cast<std::size_t>(Types::sizes)> size{};
    for (int k = 0; k < Types::sizes; ++k) size[static_cast<std::size_t>(k)] = grains.size[k * grains.stride + i];
    std::array<Scalar, static_cast<std::size_t>(Types::axes)> axis{};
    for (int k = 0; k < Types::axes; ++k) axis[static_cast<std::size_t>(k)] = orientation[k * bench.grains + i];
    for (int part = 0; part < Types::parts; ++part) {
      auto const pose = part_pose<Shape>(size, axis, part);
      for (int k = 0; k < Types::poses; ++k) bench.pose(k, i * Types::parts + part) = pose[static_cast<std::size_t>(k)];
    }
  }

  static constexpr int far_away = 255;  ///< number of an image that is no neighbour

  /// Components -1, 0 and 1 of an image by its number.
  static SCARP_HOST_DEVICE constexpr Shift shift_of(int code) {
    Shift shift{};
    for (auto& component : shift) {
      component = code % 3 - 1;
      code /= 3;
    }
    return shift;
  }
  /// Number of an image; `far_away` for components beyond one.
  static SCARP_HOST_DEVICE constexpr int code_of(Shift const& shift) {
    int code = 0;
    for (std::size_t a = axes; a-- > 0;) {
      if (shift[a] < -1 || shift[a] > 1) return far_away;
      code = 3 * code + shift[a] + 1;
    }
    return code;
  }
  /// Sign of the first component that is not zero.
  static SCARP_HOST_DEVICE constexpr int sign_of(Shift const& shift) {
    for (int const component : shift) {
      if (component != 0) return component > 0 ? 1 : -1;
    }
    return 0;
  }
};

}  // namespace scarp
