// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/block/block_work.hpp"

namespace scarp::detail {

/// Lists for each grain its pairs, in their order, so that its forces are added up in one order whatever the number of
/// threads. To be followed by a barrier, such as that after the forces.
template <class Types, class Team>
[[gnu::noinline]] SCARP_HOST_DEVICE constexpr void write_incidence(BlockWork<Types, Team>& work) {
  auto const& b = work.bench;
  auto& team = work.team;
  constexpr int parts = Types::parts;
  each(team, work.grain_count + 1, [&](int i) { b.count[i] = 0; });
  team.barrier();
  each(team, work.pair_count, [&](int p) {
    team.take(b.count[b.first[p] / parts]);
    team.take(b.count[b.second[p] / parts]);
  });
  team.barrier();
  each(team, work.grain_count + 1, [&](int i) {
    int sum = 0;
    for (int k = 0; k < i; ++k) sum += b.count[k];
    b.begin[i] = sum;
  });
  team.barrier();
  each(team, work.grain_count, [&](int i) { b.count[i] = b.begin[i]; });
  team.barrier();
  each(team, work.pair_count, [&](int p) {
    b.incident[team.take(b.count[b.first[p] / parts])] = static_cast<std::uint16_t>(2 * p);
    b.incident[team.take(b.count[b.second[p] / parts])] = static_cast<std::uint16_t>(2 * p + 1);
  });
  team.barrier();
  each(team, work.grain_count, [&](int i) {
    for (int k = b.begin[i] + 1; k < b.begin[i + 1]; ++k) {
      std::uint16_t const entry = b.incident[k];
      int to = k;
      for (; to > b.begin[i] && b.incident[to - 1] > entry; --to) b.incident[to] = b.incident[to - 1];
      b.incident[to] = entry;
    }
  });
}

}  // namespace scarp::detail
