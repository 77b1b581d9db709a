// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "scarp/dem/contacts.hpp"

namespace scarp {

/// Mean numbers of contacts of a grain.
struct Coordination {
  double all = 0.0;  ///< \f$ 2 N_c / N_p \f$, grains without contact included
  double mechanical =
      0.0;  ///< without rattlers, grains with one contact or none: \f$ (2 N_c - N_1) / (N_p - N_0 - N_1) \f$
  double rattlers = 0.0;  ///< share of the grains
};

/// The mechanical number is Thornton's (2000).
template <class PackingType>
Coordination coordination(PackingType const& packing, typename PackingType::Law const& law) {
  std::vector<int> partners(packing.grain_count(), 0);
  for_each_contact(packing, law, [&](auto const& contact) {
    ++partners[contact.first];
    ++partners[contact.second];
  });
  double sum = 0.0;
  double single = 0.0;
  double rattling = 0.0;
  for (int const count : partners) {
    sum += count;
    if (count == 1) single += 1.0;
    if (count <= 1) rattling += 1.0;
  }
  double const grains = static_cast<double>(partners.size());
  double const bearing = grains - rattling;
  return {
      .all = sum / grains, .mechanical = bearing > 0.0 ? (sum - single) / bearing : 0.0, .rattlers = rattling / grains};
}

}  // namespace scarp
