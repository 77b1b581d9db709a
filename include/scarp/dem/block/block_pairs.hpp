// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/block/block_work.hpp"
#include "scarp/dem/contact_response.hpp"

namespace scarp::detail {

/// What one pair of a block responds with.
template <class Types>
struct PairOutcome {
  PairForces<Types::dim, typename Types::Scalar> forces;
  Point<Types::dim, typename Types::Scalar> branch;
  ContactKinematics<Types::dim, typename Types::Scalar> approach;
};

/// Calls visit(column, number) for the numbers that a contact stores.
template <class Types, class Scalar, class Visit>
SCARP_HOST_DEVICE constexpr void each_memory(ContactMemory<Types::dim, Scalar>& memory, Visit const& visit) {
  int k = 0;
  auto const of = [&](auto& value) {
    if constexpr (Types::dim == 2) {
      visit(k++, value);
    } else {
      for (auto& component : value) visit(k++, component);
    }
  };
  if constexpr (Types::shears > 0) of(memory.shear);
  if constexpr (Types::moments > 0) of(memory.moment);
  for (int s = 0; s < Types::Law::inputs.scalars; ++s) visit(k++, memory.scalars[static_cast<std::size_t>(s)]);
}

/// Iterates the normal of a pair for which one step is not enough. Rare; its arguments are values, since the loop over
/// pairs would otherwise keep its numbers in memory.
template <class Shape, class Scalar>
[[gnu::noinline, gnu::cold]] SCARP_HOST_DEVICE constexpr ConvergedTouch<Shape::dim> converge(
    PoseOf<Shape, Scalar> first, PoseOf<Shape, Scalar> second, Point<Shape::dim, Scalar> branch,
    Point<Shape::dim, Scalar> normal) {
  auto const in_double = []<std::size_t Count>(std::array<Scalar, Count> const& numbers) {
    std::array<double, Count> values{};
    for (std::size_t k = 0; k < Count; ++k) values[k] = static_cast<double>(numbers[k]);
    return values;
  };
  return converged_touch<Shape>(in_double(first), in_double(second), in_double(branch), in_double(normal));
}

/// Where a pair touches, from its stored normal, which is brought up to date.
template <class Types, class Team>
SCARP_HOST_DEVICE constexpr void find_touch(BlockWork<Types, Team> const& work,
                                            TouchingPair<typename Types::Shape, typename Types::Scalar>& pair, int p) {
  using Shape = typename Types::Shape;
  using Scalar = typename Types::Scalar;
  pair.touch = Shape::touch(pair.pose_first, pair.pose_second, pair.branch, work.template normal<Scalar>(p));
  if constexpr (Shape::warm_starts_normal) {
    auto& touch = pair.touch;
    if (touch.normal_error > static_cast<Scalar>(work.grains.largest_normal_change) ||
        touch.overlap > static_cast<Scalar>(work.grains.unique_minimum_depth)) [[unlikely]] {
      auto const converged = converge<Shape, Scalar>(pair.pose_first, pair.pose_second, pair.branch, touch.normal);
      if (converged.touch.overlap - converged.touch.overlap ==
          0.0) {  // else grains are lost, which is seen where they move
        if (!converged.is_certain) work.team.take(work.bench.unconverged[0]);
        touch.overlap = static_cast<Scalar>(converged.touch.overlap);
        for (std::size_t a = 0; a < touch.normal.size(); ++a) {
          touch.normal[a] = static_cast<Scalar>(converged.touch.normal[a]);
          touch.arm_first[a] = static_cast<Scalar>(converged.touch.arm_first[a]);
          touch.arm_second[a] = touch.arm_first[a] - pair.branch[a];
        }
      }
    }
    for (std::size_t a = 0; a < touch.normal.size(); ++a) work.bench.normal(a, p) = touch.normal[a];
  }
}

/// Response of a pair of a block; its forces are stored and its memory is brought up to date.
template <Observe what, class Types, class Team>
SCARP_HOST_DEVICE constexpr PairOutcome<Types> pair_outcome(BlockWork<Types, Team> const& work,
                                                            CellMove<Types::dim, typename Types::Scalar> const& move,
                                                            int p) {
  using Shape = typename Types::Shape;
  using Law = typename Types::Law;
  using Scalar = typename Types::Scalar;
  constexpr int dim = Types::dim;
  auto const& b = work.bench;
  int const i = b.first[p] / Types::parts;
  int const j = b.second[p] / Types::parts;
  TouchingPair<Shape, Scalar> pair{};
  pair.branch = work.template branch<Scalar>(i, j, b.shift[p]);
  pair.pose_first = work.template pose<Scalar>(b.first[p]);
  pair.pose_second = work.template pose<Scalar>(b.second[p]);
  find_touch(work, pair, p);
  if constexpr (Law::inputs.shear || Law::inputs.motion) {
    for (std::size_t a = 0; a < pair.velocity.size(); ++a) pair.velocity[a] = b.velocity(a, j) - b.velocity(a, i);
  }
  if constexpr (Law::inputs.shear || Law::inputs.motion || Law::inputs.moment) {
    if constexpr (dim == 2) {
      pair.spin_first = b.spin[i];
      pair.spin_second = b.spin[j];
    } else {
      for (std::size_t k = 0; k < 3; ++k) {
        pair.spin_first[k] = b.spin(k, i);
        pair.spin_second[k] = b.spin(k, j);
      }
    }
  }
  if constexpr (Law::inputs.motion) pair.inverse_mass = work.grains.inverse_mass[i] + work.grains.inverse_mass[j];
  ContactMemory<dim, Scalar> memory;
  each_memory<Types>(memory, [&](int k, Scalar& value) { value = b.memory(k, p); });
  PairOutcome<Types> outcome{};
  outcome.branch = pair.branch;
  outcome.forces = contact_response<what, Shape>(work.law, pair, move, memory, outcome.approach);
  each_memory<Types>(memory, [&](int k, Scalar& value) { b.memory(k, p) = value; });
  int column = 0;
  auto const store = [&]<class T>(T const& values) {
    if constexpr (std::is_floating_point_v<T>) {
      b.force(column++, p) = values;
    } else {
      for (auto const& value : values) b.force(column++, p) = value;
    }
  };
  store(outcome.forces.force);
  store(outcome.forces.torque_first);
  store(outcome.forces.torque_second);
  return outcome;
}

/// Net force and torque on a grain, summed in the order of its pairs. [N], [N m]
template <class Types, class Team>
SCARP_HOST_DEVICE constexpr std::array<typename Types::Scalar, static_cast<std::size_t>(Types::dim + Types::turns)>
net_force(BlockWork<Types, Team> const& work, int i) {
  using Scalar = typename Types::Scalar;
  constexpr auto axes = static_cast<std::size_t>(Types::dim);
  auto const& b = work.bench;
  std::array<Scalar, axes + static_cast<std::size_t>(Types::turns)> sum{};
  int const last = b.begin[i + 1];
#ifdef __CUDACC__
#pragma unroll 2  // a grain has five pairs
#endif
  for (int k = b.begin[i]; k < last; ++k) {
    int const entry = b.incident[k];
    int const p = entry / 2;
    int const side = entry & 1;
    Scalar const sign = static_cast<Scalar>(2 * side - 1);  // the stored force is that on the second grain
    for (std::size_t a = 0; a < axes; ++a) sum[a] += sign * b.force(a, p);
    for (int t = 0; t < Types::turns; ++t)
      sum[axes + static_cast<std::size_t>(t)] += sign * b.force(Types::dim + t + side * Types::turns, p);
  }
  return sum;
}

}  // namespace scarp::detail
