// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>

#include "scarp/dem/packing.hpp"

namespace benchmarks {

/// Memory [bytes] of one state without the shared population.
template <class PackingType>
std::size_t state_bytes(PackingType const& packing) {
  auto const& pairs = packing.pairs;
  return sizeof(packing) + packing.position.bytes() + packing.velocity.bytes() + packing.spin.bytes() +
         packing.orientation.bytes() + pairs.normal.bytes() + pairs.shear.bytes() + pairs.moment.bytes() +
         pairs.scalars.bytes() +
         sizeof(std::int32_t) * (pairs.first.capacity() + pairs.second.capacity() + pairs.ghost_owner.capacity()) +
         sizeof(pairs.ghost_shift[0]) * pairs.ghost_shift.capacity();
}

}  // namespace benchmarks
