// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cassert>
#include <cstddef>

#include "scarp/core/precompiled.hpp"
#include "scarp/dem/damping.hpp"

namespace scarp {

/// Constraints of a boundary on grains: hold their centres or spins on the cell's mean motion, without fluctuation.
/// What is held has no net force, also in the unbalanced ratio; the stress is of all contacts.
/// \tparam PackingType a `Packing`
template <class PackingType>
class GrainHolds {
 public:
  using Scalar = typename PackingType::Scalar;  ///< of the packing's coordinates

  /// forces: rows of net forces and torques, one per grain, which holds set to zero; both must outlive this object
  GrainHolds(PackingType& packing, Scalar* forces) : packing_(packing), forces_(forces) {}

  /// The centre follows the mean motion along one axis of space; the net force along it becomes zero.
  void hold_centre(std::size_t grain, int axis) const {
    assert(grain < packing_.grain_count() && 0 <= axis && axis < PackingType::dim);
    packing_.velocity(grain, axis) = Scalar(0);
    row(grain)[axis] = Scalar(0);
  }
  /// The grain turns with the mean rotation, without a spin of its own; its net torque becomes zero.
  void hold_spin(std::size_t grain) const {
    assert(grain < packing_.grain_count());
    for (int k = 0; k < spin_size<PackingType::dim>; ++k) {
      packing_.spin(grain, k) = Scalar(0);
      row(grain)[static_cast<int>(Layout::torque) + k] = Scalar(0);
    }
  }
  /// Centre and spin.
  void hold(std::size_t grain) const {
    for (int axis = 0; axis < PackingType::dim; ++axis) hold_centre(grain, axis);
    hold_spin(grain);
  }

 private:
  using Layout = RowLayout<typename PackingType::Shape, typename PackingType::Law>;
  Scalar* row(std::size_t grain) const { return forces_ + grain * Layout::force_size; }

  PackingType& packing_;
  Scalar* forces_;
};

/// constrain(packing, holds): once a step, after the contacts and before the grains move; calls `holds` for those that
/// are not free.
template <class Boundary, class PackingType>
concept ConstrainsGrains = requires(Boundary const& boundary, PackingType const& packing,
                                    GrainHolds<PackingType> const& holds) {
  boundary.constrain(packing, holds);
};

/// Fluctuations are periodic: all grains are free.
struct Periodic {
  template <class PackingType>
  void constrain(PackingType const&, GrainHolds<PackingType> const&) const {}
};

template <>
inline constexpr bool is_precompiled<Periodic> = detail::has_library;

}  // namespace scarp
