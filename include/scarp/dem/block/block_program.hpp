// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/dem/block/block_list.hpp"
#include "scarp/dem/block/block_pairs.hpp"
#include "scarp/dem/block/block_stiffness.hpp"
#include "scarp/dem/damping.hpp"

namespace scarp {

/// One response of a packing by a team of threads, from and to a `BlockState`: the law, shape, damping and steps of
/// `TimeStepper`, in an order of additions that does not depend on the number of threads.
/// \tparam Types a `BlockTypes`
/// \tparam Damping next_velocity(velocity, force, mobility), as `DampsMotion`
/// \tparam Team a `WorksTogether`
template <class Types, class Damping, class Team>
class BlockProgram {
  using Law = typename Types::Law;
  using Scalar = typename Types::Scalar;
  using Work = BlockWork<Types, Team>;
  static constexpr int dim = Types::dim;
  static constexpr auto axes = static_cast<std::size_t>(dim);
  static constexpr auto turns = static_cast<std::size_t>(Types::turns);
  static constexpr std::size_t square = axes * axes;

 public:
  /// time_step_share: of the critical time step
  SCARP_HOST_DEVICE constexpr BlockProgram(Team const& team, BlockSize size, BlockGrains<Types> const& grains,
                                           Law const& law, Damping const& damping, double time_step_share)
      : w_{team, {team.memory(), size}, grains, law}, damping_(damping), time_step_share_(time_step_share) {}

  /// From `committed` in so many steps of this displacement gradient to `trial`. A response in trouble ends at once.
  /// No steps: the same state with its stiffness, and nothing is observed.
  SCARP_HOST_DEVICE constexpr void respond(BlockState<Types> const& committed, BlockState<Types> const& trial,
                                           int steps, detail::SmallTensor<dim> const& strain_step) {
    begin(committed, trial);
    auto const cell_step = detail::small_exponential<dim>(strain_step);
    double const strain_size = detail::size_of_tensor<dim>(strain_step);
    int step = 0;
    for (;; ++step) {
      if (!(w_.drift <= w_.skin)) renew();
      if (step == steps || w_.trouble != Trouble::none) break;
      find_forces();
      move(cell_step, strain_step, strain_size);
    }
    if (w_.trouble == Trouble::none && steps > 0) observe();
    if (w_.trouble == Trouble::none) seen_.stiffness = detail::block_stiffness(w_);
    end(trial, step);  // after the barriers of a sum, of a list or of a move
  }

 private:
  SCARP_HOST_DEVICE constexpr void begin(BlockState<Types> const& committed, BlockState<Types> const& trial) {
    auto const& header = *committed.header;
    auto const& b = w_.bench;
    w_.grain_count = header.grains;
    w_.pair_count = header.pairs;
    w_.cell = header.cell;
    w_.drift = header.drift;
    w_.skin = header.skin;
    w_.reach = header.reach;
    w_.critical_step = header.critical_step;
    last_gradient_ = header.gradient;
    last_duration_ = header.duration;
    applied_ = header.applied != 0;
    orientation_ = trial.orientation;
    auto const copy = [&](int columns, int rows, int stride, Scalar const* from, auto const& to) {
      for (int k = 0; k < columns; ++k) each(w_.team, rows, [&](int i) { to(k, i) = from[k * stride + i]; });
    };
    copy(dim, w_.grain_count, committed.size.grains, committed.position, b.position);
    copy(dim, w_.grain_count, committed.size.grains, committed.velocity, b.velocity);
    copy(Types::turns, w_.grain_count, committed.size.grains, committed.spin, b.spin);
    copy(Types::normals, w_.pair_count, committed.size.pairs, committed.normal, b.normal);
    copy(Types::memories, w_.pair_count, committed.size.pairs, committed.memory, b.memory);
    copy(Types::axes, w_.grain_count, committed.size.grains, committed.orientation,
         [&](int k, int i) -> Scalar& { return orientation_[k * b.grains + i]; });
    each(w_.team, w_.pair_count, [&](int p) {
      b.first[p] = committed.first[p];
      b.second[p] = committed.second[p];
      b.shift[p] = committed.shift[p];
    });
    each(w_.team, w_.grain_count, [&](int i) { w_.write_pose(orientation_, i); });
    w_.write_offsets();
    if (w_.team.rank() == 0) b.unconverged[0] = 0;
    detail::write_incidence(w_);  // with barriers, after which all threads see what was copied
    ready_damping();
  }

  SCARP_HOST_DEVICE constexpr void end(BlockState<Types> const& trial, int steps) {
    auto const& b = w_.bench;
    auto const copy = [&](int columns, int rows, int stride, auto const& from, Scalar* to) {
      for (int k = 0; k < columns; ++k) each(w_.team, rows, [&](int i) { to[k * stride + i] = from(k, i); });
    };
    copy(dim, w_.grain_count, b.grains, b.position, trial.position);
    copy(dim, w_.grain_count, b.grains, b.velocity, trial.velocity);
    copy(Types::turns, w_.grain_count, b.grains, b.spin, trial.spin);
    copy(Types::normals, w_.pair_count, b.pairs, b.normal, trial.normal);
    copy(Types::memories, w_.pair_count, b.pairs, b.memory, trial.memory);
    each(w_.team, w_.pair_count, [&](int p) {
      trial.first[p] = b.first[p];
      trial.second[p] = b.second[p];
      trial.shift[p] = b.shift[p];
    });
    if (w_.team.rank() != 0) return;
    auto& header = *trial.header;
    header = seen_;
    header.cell = w_.cell;
    header.gradient = last_gradient_;
    header.duration = last_duration_;
    header.drift = w_.drift;
    header.skin = w_.skin;
    header.reach = w_.reach;
    header.critical_step = w_.critical_step;
    header.grains = w_.grain_count;
    header.pairs = w_.pair_count;
    header.applied = applied_ ? 1 : 0;
    header.trouble = w_.trouble;
    header.steps = steps;
    header.lists = lists_;
  }

  SCARP_HOST_DEVICE constexpr void renew() {
    ++lists_;
    Work listed = w_;  // of a copy, since the steps would otherwise keep their numbers in memory
    make_list(listed);
    w_ = listed;
    ready_damping();
  }
  [[gnu::noinline, gnu::cold]] static SCARP_HOST_DEVICE constexpr void make_list(Work& listed) {
    BlockList<Work>(listed).renew();
  }

  /// Gives the time step to a damping that needs nothing else, whenever a list is made.
  SCARP_HOST_DEVICE constexpr void ready_damping() {
    struct Listed {
      struct {
        double critical_step;
      } pairs;
    };
    if constexpr (requires { damping_.before_move(Listed{}, 0, 1.0); }) {
      damping_.before_move(Listed{{w_.critical_step}}, 0, time_step_share_ * w_.critical_step);
    } else {
      static_assert(!detail::names_before_move<Damping>,
                    "scarp: a damping on a device learns the time step only: before_move must take any packing and "
                    "forces and use no more than pairs.critical_step");
    }
  }

  /// The last move as contacts see it: dashpots use it in every evaluation, springs once.
  SCARP_HOST_DEVICE constexpr CellMove<dim, Scalar> cell_move() const {
    CellMove<dim, Scalar> move;
    move.unapplied = applied_ ? Scalar(0) : Scalar(1);
    if (applied_ && !Law::inputs.motion) return move;
    move.duration = static_cast<Scalar>(last_duration_);
    for (std::size_t k = 0; k < square; ++k) move.gradient[k] = static_cast<Scalar>(last_gradient_[k]);
    auto const half_curl = [&](std::size_t a, std::size_t b) {
      return static_cast<Scalar>((last_gradient_[a * axes + b] - last_gradient_[b * axes + a]) / 2.0);
    };
    if constexpr (dim == 2) {
      move.turn = half_curl(1, 0);
    } else {
      move.turn = {half_curl(2, 1), half_curl(0, 2), half_curl(1, 0)};
    }
    return move;
  }

  SCARP_HOST_DEVICE constexpr void find_forces() {
    auto const move = cell_move();
    auto const here = w_;
    each(here.team, here.pair_count, [&](int p) { detail::pair_outcome<Observe::nothing>(here, move, p); });
    w_.team.barrier();
    applied_ = true;
  }

  SCARP_HOST_DEVICE constexpr void move(detail::SmallTensor<dim> const& cell_step,
                                        detail::SmallTensor<dim> const& strain_step, double strain_size) {
    double const time_step = time_step_share_ * w_.critical_step;
    auto const dt = static_cast<Scalar>(time_step);
    auto const turn_of_cell = static_cast<Scalar>((strain_step[axes] - strain_step[1]) / 2.0);
    std::array<Scalar, square> stretch{};
    for (std::size_t k = 0; k < square; ++k) stretch[k] = static_cast<Scalar>(cell_step[k]);
    Scalar fastest(0);
    Scalar fastest_spin(0);
    bool const is_converged = w_.bench.unconverged[0] == 0;  // before the barrier after which the next step counts
    auto const here = w_;
    auto const damping = damping_;
    auto* const orientation = orientation_;
    each(here.team, here.grain_count, [&](int i) {
      auto const& b = here.bench;
      auto const net = detail::net_force(here, i);
      Scalar const mobility = here.grains.inverse_mass[i] * dt;
      Scalar const spin_mobility = here.grains.inverse_inertia[i] * dt;
      Point<dim, Scalar> place{};
      for (std::size_t a = 0; a < axes; ++a) place[a] = b.position(a, i);
      Scalar speed(0);
      Scalar everything(0);
      for (std::size_t a = 0; a < axes; ++a) {
        Scalar const after = damping.next_velocity(b.velocity(a, i), net[a], mobility);
        b.velocity(a, i) = after;
        speed += after * after;
        Scalar moved = after * dt;
        for (std::size_t c = 0; c < axes; ++c) moved += stretch[a * axes + c] * place[c];
        b.position(a, i) = moved;
        everything += moved;
      }
      Scalar turning(0);
      for (std::size_t t = 0; t < turns; ++t) {
        Scalar const after = damping.next_velocity(b.spin(t, i), net[axes + t], spin_mobility);
        b.spin(t, i) = after;
        turning += after * after;
        if constexpr (Types::axes == 2) {
          auto const axis = turned_axis<Scalar>({orientation[i], orientation[b.grains + i]}, after * dt + turn_of_cell);
          orientation[i] = axis[0];
          orientation[b.grains + i] = axis[1];
        }
      }
      if constexpr (Types::axes > 0) here.write_pose(orientation, i);
      everything += speed + turning;
      if (everything - everything != Scalar(0)) speed = std::numeric_limits<Scalar>::quiet_NaN();
      if (fastest == fastest && !(speed <= fastest)) fastest = speed;  // not-a-number stays
      if (fastest_spin == fastest_spin && !(turning <= fastest_spin)) fastest_spin = turning;
    });
    w_.cell = detail::product_of<dim>(cell_step, w_.cell);
    w_.write_offsets();
    auto const most = w_.team.largest(
        std::array{ordered_bits(static_cast<double>(fastest)), ordered_bits(static_cast<double>(fastest_spin))});
    double const speed = std::sqrt(std::bit_cast<double>(most[0]));
    double const spin = std::sqrt(std::bit_cast<double>(most[1]));
    w_.drift += 2.0 * time_step * (speed + spin * w_.grains.largest_eccentricity);
    w_.drift += strain_size * (2.0 * w_.grains.largest_radius + w_.skin + w_.reach);
    if (!(speed < std::numeric_limits<double>::infinity())) w_.trouble = Trouble::not_finite;
    if (!is_converged) w_.trouble = Trouble::unconverged_touch;
    last_gradient_ = strain_step;
    last_duration_ = time_step;
    applied_ = false;
  }

  /// Stress and balance of the packing as it stands; the contacts are brought up to date.
  SCARP_HOST_DEVICE constexpr void observe() {
    auto const move = cell_move();
    auto const here = w_;
    double deepest = 0.0;
    auto const contacts = w_.team.template sum<square + 2>([&](int lane) {
      std::array<double, square + 2> own{};
      for (int p = lane; p < here.pair_count; p += lane_total) {
        auto const one = detail::pair_outcome<Observe::balance>(here, move, p);
        auto const& force = one.forces.force;
        for (std::size_t a = 0; a < axes; ++a) {
          for (std::size_t c = 0; c < axes; ++c) own[a * axes + c] += static_cast<double>(force[a] * one.branch[c]);
        }
        own[square] += static_cast<double>(std::sqrt(dot(force, force)));
        own[square + 1] += one.forces.normal != Scalar(0) ? 1.0 : 0.0;
        double const depth = static_cast<double>(one.approach.overlap / one.approach.reduced_radius);
        deepest = depth > deepest ? depth : deepest;
      }
      return own;
    });
    applied_ = true;
    auto const most = w_.team.largest(std::array{ordered_bits(deepest)});
    if (w_.bench.unconverged[0] != 0) w_.trouble = Trouble::unconverged_touch;
    auto const balance = w_.team.template sum<square + 1>([&](int lane) {
      std::array<double, square + 1> own{};
      for (int i = lane; i < here.grain_count; i += lane_total) {
        auto const net = detail::net_force(here, i);
        double const mass = 1.0 / static_cast<double>(here.grains.inverse_mass[i]);
        double squared = 0.0;
        for (std::size_t a = 0; a < axes; ++a) {
          squared += static_cast<double>(net[a]) * static_cast<double>(net[a]);
          for (std::size_t c = 0; c < axes; ++c)
            own[a * axes + c] +=
                mass * static_cast<double>(here.bench.velocity(a, i)) * static_cast<double>(here.bench.velocity(c, i));
        }
        own[square] += std::sqrt(squared);
      }
      return own;
    });
    for (std::size_t k = 0; k < square; ++k) {
      seen_.moment[k] = contacts[k];
      seen_.kinetic[k] = balance[k];
    }
    seen_.force = contacts[square];
    seen_.contacts = contacts[square + 1];
    seen_.deepest = std::bit_cast<double>(most[0]);
    seen_.unbalanced = balance[square];
  }

  Work w_;
  Damping damping_;
  double time_step_share_;
  Scalar* orientation_ = nullptr;  // of the trial state, in which the grains turn
  detail::SmallTensor<dim> last_gradient_{};
  double last_duration_ = 0.0;
  bool applied_ = false;
  int lists_ = 0;
  BlockHeader<dim> seen_{};
};

}  // namespace scarp
