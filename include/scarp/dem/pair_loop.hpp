// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/contact_response.hpp"
#include "scarp/dem/detail/pair_block.hpp"
#include "scarp/shape/converged_contact.hpp"

namespace scarp {

namespace detail {

/// Response of a block of near pairs: contact geometry, contact law, contact memory.
template <Observe what, class PackingType, class Law>
class PairResponse {
 public:
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  using Lanes = lanes::Pack<Scalar>;
  using Block = PairBlock<Shape, Law, Scalar>;
  static constexpr int dim = Shape::dim;
  static constexpr auto axes = static_cast<std::size_t>(dim);

  PairResponse(PackingType& packing, Law const& law) : pairs_(packing.pairs), law_(law) {
    // Dashpots use the last move in every evaluation, springs only once.
    bool const applied = packing.last_move.applied;
    LastMove<dim> const move = applied && !Law::inputs.motion ? LastMove<dim>{} : packing.last_move;
    largest_normal_change_ = packing.population->largest_normal_change();
    unique_minimum_depth_ = packing.population->unique_minimum_depth();
    move_.unapplied = broadcast<Lanes>(applied ? 0.0 : 1.0);
    move_.duration = broadcast<Lanes>(move.duration);
    move_.turn = affine_turn<dim, Lanes>(move.gradient);
    for (int a = 0; a < dim; ++a) {
      for (int b = 0; b < dim; ++b) move_.gradient[detail::index(a * dim + b)] = broadcast<Lanes>(move.gradient(a, b));
    }
  }

  /// Where the first `used` pairs of the block touch, which are the pairs `start` and following of the list; searched
  /// from their last normals. A pass of its own, so that the one for the law has registers enough.
  void search(Block& block, std::size_t used, std::size_t start) {
    Lanes normal_error{};
    Lanes deepest{};
    for (std::size_t at = 0; at < used; at += Lanes::size()) {
      Point<dim, Lanes> last;
      load_rows(pairs_.normal, start + at, last);
      auto const touch = Shape::touch(pose(block, Block::pose_first, at), pose(block, Block::pose_second, at),
                                      block.template read<axes>(Block::branch, at), last);
      store_rows(touch.normal, start + at, pairs_.normal);
      block.write(Block::overlap, at, touch.overlap);
      block.write(Block::normal, at, touch.normal);
      block.write(Block::arm_first, at, touch.arm_first);
      block.write(Block::normal_error, at, touch.normal_error);
      normal_error = max(normal_error, touch.normal_error);
      deepest = max(deepest, touch.overlap);
    }
    if (lanes::any_of(normal_error > broadcast<Lanes>(largest_normal_change_)) ||
        lanes::any_of(deepest > broadcast<Lanes>(unique_minimum_depth_))) [[unlikely]]
      find_normals(block, used, start);
  }

  /// The pairs `at` and following of the block, which are the pairs `start` and following of the list.
  void respond(Block& block, std::size_t at, std::size_t start) {
    auto const branch = block.template read<axes>(Block::branch, at);
    TouchingPair<Shape, Lanes> pair{.touch = touch_of(block, at, branch),
                                    .branch = branch,
                                    .pose_first = pose(block, Block::pose_first, at),
                                    .pose_second = pose(block, Block::pose_second, at)};
    if constexpr (Law::inputs.shear || Law::inputs.motion)
      pair.velocity = block.template read<axes>(Block::velocity, at);
    if constexpr (Block::has_spins) {
      pair.spin_first = spin(block, Block::spin_first, at);
      pair.spin_second = spin(block, Block::spin_second, at);
    }
    if constexpr (Law::inputs.motion) pair.inverse_mass = block.template read<1>(Block::inverse_mass, at)[0];
    ContactMemory<dim, Lanes> memory;
    if constexpr (Law::inputs.shear) load_rows(pairs_.shear, start, memory.shear);
    if constexpr (Law::inputs.moment) load_rows(pairs_.moment, start, memory.moment);
    if constexpr (Law::inputs.scalars > 0) load_rows(pairs_.scalars, start, memory.scalars);
    ContactKinematics<dim, Lanes> approach{.overlap = pair.touch.overlap, .slip_increment = {}};
    auto const forces = contact_response<what, Shape>(law_, pair, move_, memory, approach);
    if constexpr (Law::inputs.shear) store_rows(memory.shear, start, pairs_.shear);
    if constexpr (Law::inputs.moment) store_rows(memory.moment, start, pairs_.moment);
    if constexpr (Law::inputs.scalars > 0) store_rows(memory.scalars, start, pairs_.scalars);
    block.write(Block::force, at, forces.force);
    block.write(Block::torque_first, at, forces.torque_first);
    block.write(Block::torque_second, at, forces.torque_second);

    if constexpr (what != Observe::nothing) {
      sums_.force += sqrt(dot(forces.force, forces.force));
      sums_.contacts += lanes::select(forces.normal != broadcast<Lanes>(0), broadcast<Lanes>(1), broadcast<Lanes>(0));
      sums_.deepest = max(sums_.deepest, pair.touch.overlap / approach.reduced_radius);
      for (std::size_t a = 0; a < axes; ++a) {
        for (std::size_t b = 0; b < axes; ++b) sums_.moment[a * axes + b] += forces.force[a] * branch[b];
      }
    }
    if constexpr (what == Observe::energy) {
      sums_.stored += law_.stored_energy(approach, memory);
      sums_.dissipated += forces.dissipated;
    }
  }

  ContactSums<dim> total() const {
    auto sums = sums_.total();
    sums.converged = converged_;
    return sums;
  }

 private:
  PoseOf<Shape, Lanes> pose(Block const& block, std::size_t field, std::size_t at) const {
    return block.template read<Block::pose_size>(field, at);
  }

  ContactGeometry<dim, Lanes> touch_of(Block const& block, std::size_t at, Point<dim, Lanes> const& branch) const {
    if constexpr (Shape::warm_starts_normal) {
      ContactGeometry<dim, Lanes> touch{.overlap = block.template read<1>(Block::overlap, at)[0],
                                        .normal = block.template read<axes>(Block::normal, at),
                                        .arm_first = block.template read<axes>(Block::arm_first, at),
                                        .arm_second = {}};
      for (std::size_t a = 0; a < axes; ++a) touch.arm_second[a] = touch.arm_first[a] - branch[a];
      return touch;
    } else {
      return Shape::touch(pose(block, Block::pose_first, at), pose(block, Block::pose_second, at), branch, {});
    }
  }

  /// Searches the touch of those pairs anew for which one step from the last normal is not enough. Rare, hence out of
  /// the loop.
  [[gnu::noinline, gnu::cold]] void find_normals(Block& block, std::size_t used, std::size_t start) {
    auto const read = [&]<std::size_t Count>(std::size_t field, std::size_t pair, std::array<double, Count>& values) {
      for (std::size_t k = 0; k < Count; ++k) values[k] = static_cast<double>(block.fields[field + k][pair]);
    };
    for (std::size_t pair = 0; pair < used; ++pair) {
      if (!(static_cast<double>(block.fields[Block::normal_error][pair]) > largest_normal_change_ ||
            static_cast<double>(block.fields[Block::overlap][pair]) > unique_minimum_depth_))
        continue;
      PoseOf<Shape> first;
      PoseOf<Shape> second;
      Point<dim, double> branch;
      Point<dim, double> normal;
      read(Block::pose_first, pair, first);
      read(Block::pose_second, pair, second);
      read(Block::branch, pair, branch);
      read(Block::normal, pair, normal);
      auto const touch = converged_contact<Shape>(first, second, branch, normal);
      if (!std::isfinite(touch.overlap)) continue;  // of grains that are lost: seen where they move
      converged_ = converged_ && touch.normal_error == 0.0;
      block.fields[Block::overlap][pair] = static_cast<Scalar>(touch.overlap);
      for (std::size_t a = 0; a < axes; ++a) {
        block.fields[Block::normal + a][pair] = static_cast<Scalar>(touch.normal[a]);
        block.fields[Block::arm_first + a][pair] = static_cast<Scalar>(touch.arm_first[a]);
        pairs_.normal(start + pair, static_cast<int>(a)) = static_cast<Scalar>(touch.normal[a]);
      }
    }
  }

  Turning<dim, Lanes> spin(Block const& block, std::size_t field, std::size_t at) const {
    auto const spin = block.template read<Block::turns>(field, at);
    if constexpr (dim == 2) {
      return spin[0];
    } else {
      return spin;
    }
  }

  VerletList<Shape, Law, Scalar>& pairs_;
  Law law_;
  CellMove<dim, Lanes> move_;
  LaneSums<dim, Lanes> sums_;
  double largest_normal_change_;
  double unique_minimum_depth_;
  bool converged_ = true;
};

}  // namespace detail

/// Forces of all near pairs at the present positions, and the update of the contacts' memory by the packing's last
/// move, unless it was applied before. Afterwards `scratch.forces` begins with a row (force, torque) for each grain.
/// Pairs go through in blocks: gather the grains' data, evaluate the law, scatter the forces. Each of the three loops
/// is free of the others' latencies. Flattened, since shape and law must be inlined into the loop.
template <Observe what, class PackingType, class Law>
[[gnu::flatten]] ContactSums<PackingType::dim> pair_forces(PackingType& packing, Law const& law,
                                                           PairScratch<typename PackingType::Scalar>& scratch) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  using Layout = RowLayout<Shape, Law>;
  using Block = detail::PairBlock<Shape, Law, Scalar>;
  constexpr std::size_t width = lanes::Pack<Scalar>::size();

  auto const& pairs = packing.pairs;
  constexpr auto parts = static_cast<std::size_t>(part_count<Shape>());
  std::size_t const row_limit = packing.row_count() + pairs.ghost_owner.size() + 1;
  scratch.rows.resize(std::max(row_limit, packing.position.padded_rows() * parts) * Layout::size);
  scratch.forces.assign(row_limit * Layout::force_size, Scalar(0));
  Scalar* const rows = scratch.rows.data();
  Scalar* const forces = scratch.forces.data();
  fill_grain_rows(packing, rows);
  auto const nobody = static_cast<std::int32_t>(fill_ghost_rows(packing, rows));

  detail::PairResponse<what, PackingType, Law> response(packing, law);
  Block block;
  for (std::size_t start = 0; start < pairs.count(); start += Block::size) {
    std::size_t const present = std::min(Block::size, pairs.count() - start);
    block.name_pairs(pairs.first.data() + start, pairs.second.data() + start, present, nobody);
    std::size_t const used = (present + width - 1) / width * width;
    for (std::size_t at = 0; at < used; at += width) block.gather(rows, at);
    if constexpr (Shape::warm_starts_normal) response.search(block, used, start);
    for (std::size_t at = 0; at < used; at += width) response.respond(block, at, start + at);
    for (std::size_t at = 0; at < used; at += width) block.scatter(forces, at);
  }
  packing.last_move.applied = true;
  gather_forces(packing, forces);
  return response.total();
}

}  // namespace scarp
