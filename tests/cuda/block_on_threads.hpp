// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>
#include <barrier>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

/// As much of CUDA as `CudaTeam` uses, with a thread of the processor for each thread of one block: its own source runs
/// without a card.
namespace emulated {

struct Block {
  explicit Block(int threads) : gate(threads), exchange(static_cast<std::size_t>(threads)) {
    for (int warp = 0; warp < threads / 32; ++warp) warps.push_back(std::make_unique<std::barrier<>>(32));
  }
  std::barrier<> gate;
  std::vector<std::unique_ptr<std::barrier<>>> warps;
  std::vector<std::uint64_t> exchange;  ///< one number of each thread
};
inline Block* block = nullptr;

struct Index {
  unsigned x;
};
inline thread_local Index thread{};

/// Every lane of a warp gives a number and reads those of the others.
template <class T, class Reduce>
T of_warp(T value, Reduce const& reduce) {
  static_assert(sizeof(T) <= sizeof(std::uint64_t));
  std::size_t const me = thread.x;
  std::size_t const first = me / 32 * 32;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(T));
  block->exchange[me] = bits;
  block->warps[me / 32]->arrive_and_wait();
  reduce(value, [&](std::size_t lane) {
    T other;
    std::memcpy(&other, &block->exchange[first + lane], sizeof(T));
    return other;
  });
  block->warps[me / 32]->arrive_and_wait();
  return value;
}

/// Runs work() on so many threads of one block.
template <class Work>
void run(int threads, Work const& work) {
  Block own(threads);
  block = &own;
  std::vector<std::jthread> team;
  for (int k = 0; k < threads; ++k) {
    team.emplace_back([&work, k] {
      thread = {static_cast<unsigned>(k)};
      work();
    });
  }
}

}  // namespace emulated

#define __device__
#define __shared__ static
#define threadIdx emulated::thread

inline void __syncthreads() { emulated::block->gate.arrive_and_wait(); }
inline unsigned __reduce_max_sync(unsigned, unsigned value) {
  return emulated::of_warp(value, [](unsigned& most, auto const& of) {
    for (std::size_t lane = 0; lane < 32; ++lane) most = of(lane) > most ? of(lane) : most;
  });
}
inline double __shfl_xor_sync(unsigned, double value, int apart) {
  return emulated::of_warp(
      value, [&](double& own, auto const& of) { own = of((emulated::thread.x % 32) ^ static_cast<unsigned>(apart)); });
}
inline int atomicAdd(int* counter, int amount) { return std::atomic_ref<int>(*counter).fetch_add(amount); }

namespace scarp {
/// As large as that of a block.
struct SharedMemory {
  static std::byte* begin() {
    alignas(128) static std::byte bytes[232448];
    return bytes;
  }
  template <class T>
  T* at(int offset) const {
    return static_cast<T*>(static_cast<void*>(begin() + offset));
  }
};
}  // namespace scarp
