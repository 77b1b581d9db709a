// SPDX-License-Identifier: BSL-1.0
// Trials of first steps in a bounded arena, and more of them than fit.
#include "host.h"
#include "umat_states.hpp"

namespace {

bool is_rejected(points_library::Arena& arena, std::uint64_t key, std::uint64_t generation) try {
  static_cast<void>(arena.find(key, generation));
  return false;
} catch (scarp::InputError const& error) {
  return std::string_view(error.what()).find("of first steps as many as fit") != std::string_view::npos;
}

}  // namespace

void check_first_steps() {
  constexpr int trials = 100;
  auto const snapshot = [](int number) {
    return std::make_shared<points_library::Snapshot const>(fmt::format("{:10000}", number),
                                                            scarp::Tensor<3>(scarp::Tensor<3>::Zero()));
  };
  points_library::Arena arena(1e5);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> states;
  int kept = 0;
  bool good = true;
  for (int number = 0; number < trials; ++number) {
    auto const key = arena.new_key();
    states.emplace_back(key, arena.add(key, snapshot(number)));
    if (number < 3) good = good && !is_rejected(arena, key, states.back().second);  // committed: counts no more
  }
  for (std::size_t k = 0; k < states.size(); ++k) {
    bool const rejected = is_rejected(arena, states[k].first, states[k].second);
    good = good && rejected == (k >= 3 && k < trials - 9);
    kept += !rejected;
  }
  check("trials of first steps: the latest that fit, and all that are committed", kept, good && kept == 3 + 9);
  check("a key that was never written is rejected", 1, is_rejected(arena, arena.new_key(), 1));
}
