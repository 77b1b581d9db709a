// SPDX-License-Identifier: BSL-1.0
#pragma once

// For sources that nvcc compiles; a test gives its few words to the processor.
#include "scarp/dem/block/team.hpp"

namespace scarp {

#if defined(__CUDACC__)
/// Memory that the threads of a block share.
struct SharedMemory {
  /// What lies so many bytes behind the beginning.
  template <class T>
  __device__ T* at(int offset) const {
    extern __shared__ __align__(16) std::byte shared_bytes[];
    return reinterpret_cast<T*>(shared_bytes + offset);
  }
};
#endif

/// The threads of a block of a card, a whole number of warps, as a `WorksTogether`.
template <int Threads>
class CudaTeam {
  static_assert(Threads % lane_group == 0 && Threads <= lane_total);
  static constexpr int warps = Threads / lane_group;

 public:
  using Memory = SharedMemory;  ///< of the block

  __device__ Memory memory() const { return {}; }                             ///< Memory that all threads share.
  __device__ int rank() const { return static_cast<int>(threadIdx.x); }       ///< Number of the calling thread.
  __device__ int size() const { return Threads; }                             ///< Number of threads.
  __device__ void barrier() const { __syncthreads(); }                        ///< Returns when all have called it.
  __device__ int take(int& counter) const { return atomicAdd(&counter, 1); }  ///< The former value.

  /// The largest of all threads' numbers. Slots take turns, so that the next call's writes meet no reader of this
  /// one's.
  template <std::size_t Count>
  __device__ std::array<std::uint64_t, Count> largest(std::array<std::uint64_t, Count> const& bits) const {
    static_assert(Count <= 2);
    __shared__ std::uint64_t slots[2][2][warps];
    int const warp = rank() / lane_group;
    int const lane = rank() % lane_group;
    std::array<std::uint64_t, Count> most;
    for (std::size_t k = 0; k < Count; ++k) {
      most[k] = largest_of_warp(bits[k]);
      if (lane == 0) slots[turn_][k][warp] = most[k];
    }
    __syncthreads();
    for (std::size_t k = 0; k < Count; ++k) most[k] = largest_of_warp(slots[turn_][k][lane % warps]);
    turn_ = 1 - turn_;
    return most;
  }

  /// Sums over all groups of lanes, which the warps share out among themselves.
  template <std::size_t Count, class OfLane>
  __device__ std::array<double, Count> sum(OfLane const& of_lane) const {
    __shared__ double groups[group_total][Count];
    int const lane = rank() % lane_group;
    __syncthreads();
    for (int group = rank() / lane_group; group < group_total; group += warps) {
      auto own = of_lane(group * lane_group + lane);
      for (std::size_t k = 0; k < Count; ++k) {
        for (int apart = lane_group / 2; apart > 0; apart /= 2) own[k] += __shfl_xor_sync(~0u, own[k], apart);
        if (lane == 0) groups[group][k] = own[k];
      }
    }
    __syncthreads();
    std::array<double, Count> total{};
    for (int group = 0; group < group_total; ++group) {
      for (std::size_t k = 0; k < Count; ++k) total[k] += groups[group][k];
    }
    return total;
  }

 private:
  __device__ static std::uint64_t largest_of_warp(std::uint64_t bits) {
    auto const upper = static_cast<unsigned>(bits >> 32);
    unsigned const high = __reduce_max_sync(~0u, upper);
    unsigned const low = __reduce_max_sync(~0u, upper == high ? static_cast<unsigned>(bits) : 0u);
    return static_cast<std::uint64_t>(high) << 32 | low;
  }

  mutable int turn_ = 0;
};

}  // namespace scarp
