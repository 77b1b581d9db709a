// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/core/pack.hpp"
#include "scarp/dem/packing.hpp"

namespace scarp {

/// Scratch memory of the pair loop; one per thread, reused from call to call.
/// Grains lie row-wise (position, velocity, spin, pose) so that a pair's data come from one cache line each.
template <ParticleShape Shape, class Scalar>
struct PairScratch {
  static constexpr int dim = Shape::dim;
  static constexpr int used = 2 * dim + spin_size<dim> + Shape::pose_count;
  static constexpr std::size_t row_size = (static_cast<std::size_t>(used) + 3) / 4 * 4;
  static constexpr std::size_t force_size = dim == 2 ? 4 : 8;  // force, torque, padding

  std::vector<Scalar> rows;
  std::vector<Scalar> forces;
};

/// Writes the row of every grain: position, velocity, spin, pose, padding.
template <class PackingType>
void fill_grain_rows(PackingType const& packing, typename PackingType::Scalar* rows) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  using Scratch = PairScratch<Shape, Scalar>;
  using Lanes = Pack<Scalar>;
  constexpr auto axes = static_cast<std::size_t>(Shape::dim);
  auto const lanes_of = [](auto const& columns, std::size_t count, std::size_t start, Lanes* to) {
    for (std::size_t k = 0; k < count; ++k) to[k] = load(columns.column(static_cast<int>(k)) + start);
  };
  for (std::size_t start = 0; start < packing.position.padded_rows(); start += Lanes::size()) {
    std::array<Lanes, Scratch::row_size> fields{};
    lanes_of(packing.position, axes, start, fields.data());
    lanes_of(packing.velocity, axes, start, fields.data() + axes);
    lanes_of(packing.spin, 1, start, fields.data() + 2 * axes);
    std::array<Lanes, static_cast<std::size_t>(Shape::size_count)> size;
    lanes_of(packing.population->sizes(), size.size(), start, size.data());
    std::array<Lanes, static_cast<std::size_t>(Shape::orientation_count)> orientation;
    if constexpr (Shape::orientation_count > 0)
      lanes_of(packing.orientation, orientation.size(), start, orientation.data());
    auto const pose = Shape::pose(size, orientation);
    for (std::size_t k = 0; k < pose.size(); ++k) fields[2 * axes + 1 + k] = pose[k];
    for (std::size_t quad = 0; quad < Scratch::row_size; quad += 4) {
      auto const quads = to_quads<Scalar>({fields[quad], fields[quad + 1], fields[quad + 2], fields[quad + 3]});
      for (std::size_t lane = 0; lane < quads.size(); ++lane)
        quads[lane].write(rows + (start + lane) * Scratch::row_size + quad);
    }
  }
}

/// Sums over the contacts that a pair loop can give along the way.
template <int Dim>
struct ContactSums {
  Tensor<Dim> moment = Tensor<Dim>::Zero();  ///< force on the second grain (x) branch [N m]
  double force = 0.0;                        ///< |force| [N]
  double contacts = 0.0;

  /// Love and Weber's stress [Pa], tension positive, for a packing's volume [m3].
  Tensor<Dim> stress(double volume) const { return -moment / volume; }
};

/// Forces of all near pairs at the present positions, and the update of what contacts remember.
/// `strain_step`, the cell's displacement gradient during the step, gives the affine part of the slip; `time_step` [s].
/// With `Observe` the loop also sums over the contacts. Flattened, since shape and law must melt into the loop: a third of the
/// speed is lost otherwise.
template <bool Observe, class PackingType, class Law>
[[gnu::flatten]] ContactSums<PackingType::dim> pair_forces(
    PackingType& packing, Law const& law, Tensor<PackingType::dim> const& strain_step, double time_step,
    PairScratch<typename PackingType::Shape, typename PackingType::Scalar>& scratch) {
  using Shape = typename PackingType::Shape;
  using Scalar = typename PackingType::Scalar;
  using Scratch = PairScratch<Shape, Scalar>;
  using Lanes = Pack<Scalar>;
  constexpr int dim = Shape::dim;
  constexpr auto axes = static_cast<std::size_t>(dim);
  constexpr std::size_t width = Lanes::size();
  constexpr std::size_t row_size = Scratch::row_size;
  constexpr std::size_t force_size = Scratch::force_size;
  static_assert(Columns<Scalar, 1>::padding % width == 0, "columns must fill whole packs");
  static_assert(dim == 2, "the pair loop's torques and frames are written for the plane");

  auto& pairs = packing.pairs;
  std::size_t const grains = packing.grain_count();
  std::size_t const ghosts = pairs.ghost_owner.size();
  std::size_t const dummy = grains + ghosts;  // partner of the lanes beyond the last pair: far away, touches nothing
  scratch.rows.resize(std::max(dummy + 1, packing.position.padded_rows()) * row_size);
  scratch.forces.assign((dummy + 1) * force_size, Scalar(0));

  Scalar* const rows = scratch.rows.data();
  fill_grain_rows(packing, rows);
  for (std::size_t g = 0; g < ghosts; ++g) {
    Scalar const* owner = rows + static_cast<std::size_t>(pairs.ghost_owner[g]) * row_size;
    Scalar* row = rows + (grains + g) * row_size;
    for (std::size_t k = 0; k < row_size; ++k) row[k] = owner[k];
    for (int a = 0; a < dim; ++a) {
      double offset = 0.0;
      for (int b = 0; b < dim; ++b) offset += packing.cell(a, b) * pairs.ghost_shift[g][static_cast<std::size_t>(b)];
      row[a] += static_cast<Scalar>(offset);
    }
  }
  for (std::size_t k = 0; k < row_size; ++k) rows[dummy * row_size + k] = rows[k];
  rows[dummy * row_size] += static_cast<Scalar>(1e3 * packing.population->largest_radius());

  std::array<Lanes, axes * axes> affine;  // displacement gradient of one step
  for (int a = 0; a < dim; ++a) {
    for (int b = 0; b < dim; ++b) {
      affine[static_cast<std::size_t>(a * dim + b)] = Lanes(static_cast<Scalar>(strain_step(a, b)));
    }
  }
  Lanes const step(static_cast<Scalar>(time_step));
  // Grains turn with the cell: their spin is a fluctuation about the affine spin.
  Lanes const affine_turn(static_cast<Scalar>((strain_step(1, 0) - strain_step(0, 1)) / 2.0));

  std::array<Lanes, axes * axes> moment{};
  Lanes magnitude(Scalar(0));
  double contacts = 0.0;
  std::array<std::int32_t, width> last_first{};
  std::array<std::int32_t, width> last_second{};
  std::size_t const count = pairs.count();
  for (std::size_t start = 0; start < count; start += width) {
    std::int32_t const* first = pairs.first.data() + start;
    std::int32_t const* second = pairs.second.data() + start;
    if (start + width > count) {
      for (std::size_t k = 0; k < width; ++k) {
        last_first[k] = start + k < count ? first[k] : 0;
        last_second[k] = start + k < count ? second[k] : static_cast<std::int32_t>(dummy);
      }
      first = last_first.data();
      second = last_second.data();
    }
    auto const row_of = [&](std::int32_t const* numbers, std::size_t quad) {
      return [=](std::size_t lane) { return rows + static_cast<std::size_t>(numbers[lane]) * row_size + 4 * quad; };
    };
    std::array<std::array<Lanes, 4>, row_size / 4> row_first;
    std::array<std::array<Lanes, 4>, row_size / 4> row_second;
    for (std::size_t quad = 0; quad < row_first.size(); ++quad) {
      row_first[quad] = load_quads<Scalar>(row_of(first, quad));
      row_second[quad] = load_quads<Scalar>(row_of(second, quad));
    }
    auto const column = [](auto const& row, std::size_t k) -> Lanes const& { return row[k / 4][k % 4]; };

    Point<dim, Lanes> branch;
    Point<dim, Lanes> approach_motion;
    for (std::size_t a = 0; a < axes; ++a) branch[a] = column(row_second, a) - column(row_first, a);
    for (std::size_t a = 0; a < axes; ++a) {
      approach_motion[a] = (column(row_second, axes + a) - column(row_first, axes + a)) * step;
      for (std::size_t b = 0; b < axes; ++b) approach_motion[a] += affine[a * axes + b] * branch[b];
    }
    Lanes const turn_first = column(row_first, 2 * axes) * step + affine_turn;
    Lanes const turn_second = column(row_second, 2 * axes) * step + affine_turn;
    std::array<Lanes, static_cast<std::size_t>(Shape::pose_count)> pose_first;
    std::array<Lanes, static_cast<std::size_t>(Shape::pose_count)> pose_second;
    for (std::size_t k = 0; k < pose_first.size(); ++k) {
      pose_first[k] = column(row_first, 2 * axes + 1 + k);
      pose_second[k] = column(row_second, 2 * axes + 1 + k);
    }
    Point<dim, Lanes> normal{};
    if constexpr (Shape::remembers_normal) {
      for (int a = 0; a < dim; ++a) normal[static_cast<std::size_t>(a)] = load(pairs.normal.column(a) + start);
    }
    auto const touch = Shape::touch(pose_first, pose_second, branch, normal);
    if constexpr (Shape::remembers_normal) {
      for (int a = 0; a < dim; ++a) store(touch.normal[static_cast<std::size_t>(a)], pairs.normal.column(a) + start);
    }

    auto const& n = touch.normal;
    Point<dim, Lanes> const tangent{-n[1], n[0]};
    Approach<dim, Lanes> approach{touch.overlap, Lanes(Scalar(0))};
    Lanes shear(Scalar(0));
    if constexpr (Law::remembers_shear) {
      Point<dim, Lanes> const slip{
          approach_motion[0] - turn_second * touch.arm_second[1] + turn_first * touch.arm_first[1],
          approach_motion[1] + turn_second * touch.arm_second[0] - turn_first * touch.arm_first[0]};
      approach.slip = slip[0] * tangent[0] + slip[1] * tangent[1];
      shear = load(pairs.shear.column(0) + start);
    }
    Lanes const push = law.respond(approach, shear);
    Point<dim, Lanes> force{push * n[0], push * n[1]};  // on the second grain
    if constexpr (Law::remembers_shear) {
      store(shear, pairs.shear.column(0) + start);
      force[0] += shear * tangent[0];
      force[1] += shear * tangent[1];
    }
    // Rows of (force, torque on the first, torque on the second); the fourth entry of a force row is scratch.
    auto const quads =
        to_quads<Scalar>({force[0], force[1], touch.arm_first[0] * force[1] - touch.arm_first[1] * force[0],
                          touch.arm_second[0] * force[1] - touch.arm_second[1] * force[0]});
    if constexpr (Observe) {
      auto const closed = push > Lanes(Scalar(0));
      Lanes size = sqrt(force[0] * force[0] + force[1] * force[1]);
      where(!closed, size) = Lanes(Scalar(0));
      magnitude += size;
      contacts += static_cast<double>(popcount(closed));
      for (std::size_t a = 0; a < axes; ++a) {
        for (std::size_t b = 0; b < axes; ++b) moment[a * axes + b] += force[a] * branch[b];
      }
    }
    for (std::size_t k = 0; k < width; ++k) {
      Scalar* const on_first = scratch.forces.data() + static_cast<std::size_t>(first[k]) * force_size;
      Scalar* const on_second = scratch.forces.data() + static_cast<std::size_t>(second[k]) * force_size;
      auto sum = Quad<Scalar>::read(on_first);
      sum.value -= quads[k].value;
      sum.write(on_first);
      sum = Quad<Scalar>::read(on_second);
      sum.value += __builtin_shufflevector(quads[k].value, quads[k].value, 0, 1, 3, 2);
      sum.write(on_second);
    }
  }
  for (std::size_t g = 0; g < ghosts; ++g) {
    Scalar* const owner = scratch.forces.data() + static_cast<std::size_t>(pairs.ghost_owner[g]) * force_size;
    Scalar const* const ghost = scratch.forces.data() + (grains + g) * force_size;
    for (std::size_t k = 0; k < 3; ++k) owner[k] += ghost[k];
  }

  ContactSums<dim> sums;
  if constexpr (Observe) {
    auto const total = [](Lanes const& lanes) {
      double sum = 0.0;
      for (std::size_t k = 0; k < width; ++k) sum += static_cast<double>(lanes[k]);
      return sum;
    };
    for (int a = 0; a < dim; ++a) {
      for (int b = 0; b < dim; ++b) sums.moment(a, b) = total(moment[static_cast<std::size_t>(a * dim + b)]);
    }
    sums.force = total(magnitude);
    sums.contacts = contacts;
  }
  return sums;
}

}  // namespace scarp
