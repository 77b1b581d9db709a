// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/dem/contact_sums.hpp"
#include "scarp/dem/pair_lanes.hpp"

namespace scarp {

/// Forces of all near pairs at the present positions, and the update of what contacts remember by the packing's last move,
/// unless that has been answered before. Afterwards `scratch.forces` begins with a row (force, torque) for each grain.
/// Flattened, since shape and law must melt into the loop: a third of the speed is lost otherwise.
template <Observe what, class PackingType, class Law>
[[gnu::flatten]] ContactSums<PackingType::dim> pair_forces(PackingType& packing, Law const& law,
                                                           PairScratch<typename PackingType::Scalar>& scratch) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  using Layout = RowLayout<Shape, Law>;
  using Lanes = Pack<Scalar>;
  constexpr int dim = Shape::dim;
  constexpr auto axes = static_cast<std::size_t>(dim);
  constexpr std::size_t width = Lanes::size();
  static_assert(Columns<Scalar, 1>::padding % width == 0, "columns must fill whole packs");

  auto& pairs = packing.pairs;
  std::size_t const row_limit = packing.row_count() + pairs.ghost_owner.size() + 1;
  scratch.rows.resize(
      std::max(row_limit, packing.position.padded_rows() * static_cast<std::size_t>(part_count<Shape>())) *
      Layout::size);
  scratch.forces.assign(row_limit * Layout::force_size, Scalar(0));
  Scalar* const rows = scratch.rows.data();
  Scalar* const forces = scratch.forces.data();
  fill_grain_rows(packing, rows);
  auto const nobody = static_cast<std::int32_t>(fill_ghost_rows(packing, rows));

  // Dashpots look at the last move however often they are asked, springs only once.
  LastMove<dim> const move = packing.last_move.answered && !Law::needs.motion ? LastMove<dim>{} : packing.last_move;
  Lanes const unanswered = constant<Lanes>(packing.last_move.answered ? 0.0 : 1.0);
  packing.last_move.answered = true;
  std::array<Lanes, axes * axes> affine;
  for (int a = 0; a < dim; ++a) {
    for (int b = 0; b < dim; ++b) affine[static_cast<std::size_t>(a * dim + b)] = constant<Lanes>(move.gradient(a, b));
  }
  auto const affine_turn = detail::affine_turn<dim, Lanes>(move.gradient);
  Lanes const step = constant<Lanes>(move.duration);

  detail::LaneSums<dim, Lanes> sums;
  std::array<std::int32_t, width> last_first{};
  std::array<std::int32_t, width> last_second{};
  std::size_t const count = pairs.count();
  for (std::size_t start = 0; start < count; start += width) {
    std::int32_t const* first = pairs.first.data() + start;
    std::int32_t const* second = pairs.second.data() + start;
    if (start + width > count) {
      for (std::size_t k = 0; k < width; ++k) {
        last_first[k] = start + k < count ? first[k] : 0;
        last_second[k] = start + k < count ? second[k] : nobody;
      }
      first = last_first.data();
      second = last_second.data();
    }
    detail::PairSide<Layout, dim, Lanes> const one(rows, first);
    detail::PairSide<Layout, dim, Lanes> const other(rows, second);

    Point<dim, Lanes> branch;
    Point<dim, Lanes> motion;  // of the second centre relative to the first during the step
    for (std::size_t a = 0; a < axes; ++a) branch[a] = other[a] - one[a];
    for (std::size_t a = 0; a < axes; ++a) {
      motion[a] = (other[Layout::velocity + a] - one[Layout::velocity + a]) * step;
      for (std::size_t b = 0; b < axes; ++b) motion[a] += affine[a * axes + b] * branch[b];
    }
    auto const turn_one = one.turn(step, affine_turn);
    auto const turn_other = other.turn(step, affine_turn);

    Point<dim, Lanes> normal{};
    if constexpr (Shape::remembers_normal) {
      for (int a = 0; a < dim; ++a) normal[static_cast<std::size_t>(a)] = load(pairs.normal.column(a) + start);
    }
    auto const pose_one = one.pose();
    auto const pose_other = other.pose();
    auto const touch = Shape::touch(pose_one, pose_other, branch, normal);
    auto const& n = touch.normal;
    if constexpr (Shape::remembers_normal) {
      for (int a = 0; a < dim; ++a) store(n[static_cast<std::size_t>(a)], pairs.normal.column(a) + start);
    }

    Approach<dim, Lanes> approach{.overlap = touch.overlap, .slip = {}};
    ContactMemory<dim, Lanes> memory;
    if constexpr (Law::needs.shear || Law::needs.motion) {
      auto const swing_one = turned_motion(turn_one, touch.arm_first);
      auto const swing_other = turned_motion(turn_other, touch.arm_second);
      Point<dim, Lanes> meeting;  // relative motion at the contact point
      for (std::size_t a = 0; a < axes; ++a) meeting[a] = motion[a] + swing_other[a] - swing_one[a];
      if constexpr (Law::needs.shear) {
        approach.slip = tangential_part(meeting, n);
        if constexpr (Law::needs.motion) {
          approach.sweep = approach.slip;
          approach.slip = scaled(approach.slip, unanswered);
        }
        detail::load_tangential(pairs.shear, start, memory.shear);
        if constexpr (dim == 3) carry_to_frame(memory.shear, detail::mean(turn_one, turn_other), n);
      }
      if constexpr (Law::needs.motion) {
        approach.closing = -dot(meeting, n);
        approach.reduced_mass = constant<Lanes>(1.0) / (one[Layout::inverse_mass] + other[Layout::inverse_mass]);
        approach.time_step = step;
      }
    }
    if constexpr (Law::needs.moment) {
      approach.roll = rolling_part(detail::difference(turn_other, turn_one), n);
      if constexpr (Law::needs.motion) approach.roll = scaled(approach.roll, unanswered);
      detail::load_tangential(pairs.moment, start, memory.moment);
      if constexpr (dim == 3) carry_to_frame(memory.moment, detail::mean(turn_one, turn_other), n);
    }
    if constexpr (Law::needs.radius || what != Observe::nothing) {
      Lanes const radius_one = Shape::contact_radius(pose_one);
      Lanes const radius_other = Shape::contact_radius(pose_other);
      approach.reduced_radius = radius_one * radius_other / (radius_one + radius_other);
    }
    if constexpr (Law::needs.scalars > 0) {
      for (int k = 0; k < Law::needs.scalars; ++k)
        memory.scalars[static_cast<std::size_t>(k)] = load(pairs.scalars.column(k) + start);
    }
    auto const answer = law.respond(approach, memory);
    if constexpr (Law::needs.shear) detail::store_tangential(memory.shear, start, pairs.shear);
    if constexpr (Law::needs.moment) detail::store_tangential(memory.moment, start, pairs.moment);
    if constexpr (Law::needs.scalars > 0) {
      for (int k = 0; k < Law::needs.scalars; ++k)
        store(memory.scalars[static_cast<std::size_t>(k)], pairs.scalars.column(k) + start);
    }

    Point<dim, Lanes> force;  // on the second grain
    for (std::size_t a = 0; a < axes; ++a) force[a] = answer.normal * n[a];
    if constexpr (Law::needs.shear) {
      auto const shear = as_vector(answer.shear, n);
      for (std::size_t a = 0; a < axes; ++a) force[a] += shear[a];
    }
    auto torque_one = cross(touch.arm_first, force);  // reversed, as the force is
    auto torque_other = cross(touch.arm_second, force);
    if constexpr (Law::needs.moment) {
      if constexpr (dim == 2) {
        torque_one += answer.moment;
        torque_other += answer.moment;
      } else {
        for (std::size_t a = 0; a < 3; ++a) {
          torque_one[a] += answer.moment[a];
          torque_other[a] += answer.moment[a];
        }
      }
    }
    if constexpr (what != Observe::nothing) {
      using std::experimental::max;
      auto const closed = answer.normal != Lanes(Scalar(0));
      sums.force += sqrt(dot(force, force));
      sums.contacts += static_cast<double>(popcount(closed));
      sums.deepest = max(sums.deepest, touch.overlap / approach.reduced_radius);
      for (std::size_t a = 0; a < axes; ++a) {
        for (std::size_t b = 0; b < axes; ++b) sums.moment[a * axes + b] += force[a] * branch[b];
      }
    }
    if constexpr (what == Observe::energy) {
      sums.stored += law.stored_energy(approach, memory);
      sums.dissipated += answer.dissipated;
    }
    detail::scatter<Layout>(force, torque_one, torque_other, first, second, forces);
  }
  gather_forces(packing, forces);
  return sums.total();
}

}  // namespace scarp
