// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "scarp/contact/law_checks.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/dem/time_stepping.hpp"

namespace scarp {

/// Grains that have been cemented.
/// \tparam PackingType a `Packing`
template <class PackingType>
struct [[nodiscard]] BondedPacking {
  PackingType packing;    ///< under the law with bonds, at rest
  Verdict verdict{};      ///< of the list of near pairs; the packing is of use only where it is acceptable
  std::size_t bonds = 0;  ///< contacts that were bonded
};

/// The same grains under a law with bonds: every contact that touches is bonded, and every gap up to `gap` [m] too.
/// Grains are at rest, contacts retain their shear forces and moments, so that a packing in balance stays so where
/// both laws have equal springs and no gap is bonded: a bond across a gap pulls.
/// \throws InputError for a gap that is negative or beyond the law's range, where it breaks at once, for a packing
/// without grains, one under a law with bonds, and for a law that `require_consistent` rejects
template <Bonds Law, class PackingType>
BondedPacking<Packing<typename PackingType::Shape, Law, typename PackingType::Scalar>> bonded(
    PackingType grains, typename PackingType::Law const& former, Law const& law, double gap = 0.0) {
  require_population(grains);
  require_not_negative("gap that is bonded", gap);
  require_consistent(law, grains.population->largest_radius());
  if constexpr (Bonds<typename PackingType::Law>)
    reject("the packing's law has bonds already (bonded anew it would lose those that pull): bond a packing once");
  double range = interaction_range_of(law);
  for_each_law(law, [&](auto const& one) { range = std::min(range, interaction_range_of(one)); });
  if (gap > range)
    reject("gaps up to {} m are to be bonded (these bonds break beyond {} m): give a smaller gap", gap, range);
  BondedPacking<Packing<typename PackingType::Shape, Law, typename PackingType::Scalar>> made;
  if (gap > grains.pairs.skin - grains.pairs.drift) grains.pairs.drift = std::numeric_limits<double>::infinity();
  TimeStepper<PackingType> stepper;
  stepper.skin_ratio = std::max(stepper.skin_ratio, gap / grains.population->largest_radius());
  made.verdict = stepper.stop(grains, former);
  if (!made.verdict.acceptable()) return made;

  auto& packing = made.packing;
  packing.population = grains.population;
  packing.cell = grains.cell;
  packing.position = grains.position;
  packing.orientation = grains.orientation;
  packing.rest();
  auto& pairs = packing.pairs;
  pairs.first = grains.pairs.first;
  pairs.second = grains.pairs.second;
  pairs.ghost_owner = grains.pairs.ghost_owner;
  pairs.ghost_shift = grains.pairs.ghost_shift;
  pairs.normal = grains.pairs.normal;
  auto const carry = [&](auto const& from, auto& to) {
    if constexpr (std::is_same_v<decltype(from), std::remove_reference_t<decltype(to)> const&>) {
      to = from;
    } else {
      to.resize(pairs.count());
    }
  };
  carry(grains.pairs.shear, pairs.shear);
  carry(grains.pairs.moment, pairs.moment);
  pairs.scalars.resize(pairs.count());
  ContactMemory<PackingType::dim, double> memory;
  Law::bond(memory);
  for_each_near_pair(grains, former, [&](Contact<PackingType::dim> const& contact) {
    if (contact.touch.overlap < -gap || (gap == 0.0 && contact.touch.overlap == 0.0)) return;
    for (int k = 0; k < Law::inputs.scalars; ++k) {
      pairs.scalars(contact.pair, k) = static_cast<typename PackingType::Scalar>(memory.scalars[detail::index(k)]);
    }
    ++made.bonds;
  });
  // The next step makes a list as wide as the new law acts, and carries these memories over.
  pairs.skin = grains.pairs.skin;
  pairs.drift = std::numeric_limits<double>::infinity();
  return made;
}

}  // namespace scarp
