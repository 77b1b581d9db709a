// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/tensor.hpp"
#include "scarp/dem/population.hpp"

namespace scarp {

/// Pairs of grains closer than a skin, each once, sorted by (first, second). A partner across the cell's boundary is a
/// *ghost*: number grain_count + g stands for grain `ghost_owner[g]` moved by cell x `ghost_shift[g]`.
/// `shear` is the tangential force on the second grain [N]; what a shape or law does not remember takes no room.
template <ParticleShape Shape, class Law, class Scalar>
struct NearPairs {
  static constexpr int dim = Shape::dim;
  static constexpr int shear_count = Law::remembers_shear ? (dim == 2 ? 1 : 3) : 0;
  using Shift = std::array<std::int8_t, static_cast<std::size_t>(dim)>;

  std::vector<std::int32_t> first;
  std::vector<std::int32_t> second;
  Columns<Scalar, Shape::remembers_normal ? dim : 0> normal;
  Columns<Scalar, shear_count> shear;
  std::vector<std::int32_t> ghost_owner;
  std::vector<Shift> ghost_shift;
  double drift = 0.0;          ///< bound on how far gaps have shrunk since the list was made [m]
  double skin = -1.0;          ///< gap up to which pairs are listed [m]; negative before the first list
  double critical_step = 0.0;  ///< largest stable time step [s] when the list was made

  std::size_t count() const { return first.size(); }

  friend bool operator==(NearPairs const&, NearPairs const&) = default;
};

/// State of a periodic packing: everything that evolves. Velocities are fluctuations about the affine motion of the
/// cell; the cell's columns are its base vectors [m]. Positions may lie outside the cell by a lattice vector.
template <ParticleShape ShapePolicy, class LawPolicy, class ScalarType = double>
struct Packing {
  using Shape = ShapePolicy;
  using Law = LawPolicy;
  using Scalar = ScalarType;
  static constexpr int dim = Shape::dim;

  std::shared_ptr<Population<Shape, Scalar> const> population;
  Tensor<dim> cell = Tensor<dim>::Identity();
  Columns<Scalar, dim> position;
  Columns<Scalar, dim> velocity;
  Columns<Scalar, spin_size<dim>> spin;
  Columns<Scalar, Shape::orientation_count> orientation;
  NearPairs<Shape, Law, Scalar> pairs;

  std::size_t grain_count() const { return position.rows(); }
  /// Volume of the cell [m3] including the out-of-plane thickness in 2D.
  double volume() const { return cell.determinant() * population->thickness(); }

  /// Volume of voids over volume of grains; overlaps are not subtracted from the grains.
  double void_ratio() const { return cell.determinant() / population->content() - 1.0; }

  void rest() {
    velocity.resize(grain_count());
    spin.resize(grain_count());
  }

  friend bool operator==(Packing const&, Packing const&) = default;
};

/// Memory [bytes] of one state without the shared population.
template <class PackingType>
std::size_t state_bytes(PackingType const& packing) {
  auto const& pairs = packing.pairs;
  return sizeof(packing) + packing.position.bytes() + packing.velocity.bytes() + packing.spin.bytes() +
         packing.orientation.bytes() + pairs.normal.bytes() + pairs.shear.bytes() +
         sizeof(std::int32_t) * (pairs.first.capacity() + pairs.second.capacity() + pairs.ghost_owner.capacity()) +
         sizeof(pairs.ghost_shift[0]) * pairs.ghost_shift.capacity();
}

}  // namespace scarp
