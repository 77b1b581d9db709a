// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "scarp/core/one_version.hpp"

namespace scarp {

/// xoshiro256++ seeded by splitmix64: the same numbers with every compiler and standard library.
/// Blackman and Vigna, "Scrambled linear pseudorandom number generators", ACM TOMS 47 (2021) 36.
class Random {
 public:
  /// The stream of a seed, which may be any number, also zero.
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) {
      seed += 0x9e3779b97f4a7c15ULL;
      std::uint64_t mixed = seed;
      mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9ULL;
      mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebULL;
      word = mixed ^ (mixed >> 31U);
    }
  }

  /// Next 64 random bits of the stream.
  std::uint64_t next() {
    std::uint64_t const result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    std::uint64_t const shifted = state_[1] << 17U;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1) with 53 random bits.
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

  /// Uniform in [low, high); rounding may give high itself unless low is 0.
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace scarp
