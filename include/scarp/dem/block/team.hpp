// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "scarp/core/host_device.hpp"

namespace scarp {

/// Memory of the processor that a team shares.
struct HostMemory {
  std::byte* base = nullptr;  ///< where it begins

  /// What lies so many bytes behind the beginning.
  template <class T>
  SCARP_HOST_DEVICE constexpr T* at(int offset) const {
    return static_cast<T*>(static_cast<void*>(base + offset));
  }
};

/// Threads that work on one packing together, as a block of a GPU does. All threads call all functions but `take` in
/// the same order.
/// - rank(), size(): number of the calling thread, number of threads
/// - barrier(): returns when all threads have called it; each then sees what the others wrote
/// - largest(bits): the largest of all threads' numbers, one by one
/// - take(counter): adds one to a shared counter and returns its former value
/// - sum<Count>(of_lane): Count sums over `lane_total` lanes, of_lane(lane) being one lane's terms, in an order that
///   does not depend
///   on the number of threads
/// - memory(): at<T>(offset [bytes]) of the memory that all threads share
template <class Team>
concept WorksTogether = requires(Team& team, std::array<std::uint64_t, 2> const& bits, int& counter) {
  typename Team::Memory;
  { team.memory() } -> std::same_as<typename Team::Memory>;
  { team.rank() } -> std::same_as<int>;
  { team.size() } -> std::same_as<int>;
  team.barrier();
  { team.largest(bits) } -> std::same_as<std::array<std::uint64_t, 2>>;
  { team.take(counter) } -> std::same_as<int>;
};

/// Partial sums of a sum, which is the largest number of threads that can share it.
inline constexpr int lane_total = 512;
/// Lanes that are added up as a butterfly, as many as a warp of a GPU has; the groups follow one after the other.
inline constexpr int lane_group = 32;
/// Groups of lanes.
inline constexpr int group_total = lane_total / lane_group;

/// Bits of a number that is not negative, ordered as the numbers are; not-a-number is above all.
SCARP_HOST_DEVICE constexpr std::uint64_t ordered_bits(double number) {
  return std::bit_cast<std::uint64_t>(number) & ~(1ULL << 63);
}

/// A team of one thread.
struct OneThread {
  using Memory = HostMemory;    ///< the processor's
  std::byte* shared = nullptr;  ///< has the size of a `BlockBench`

  SCARP_HOST_DEVICE constexpr Memory memory() const { return {shared}; }          ///< The one thread's memory.
  SCARP_HOST_DEVICE constexpr int rank() const { return 0; }                      ///< 0
  SCARP_HOST_DEVICE constexpr int size() const { return 1; }                      ///< 1
  SCARP_HOST_DEVICE constexpr void barrier() const {}                             ///< Returns at once.
  SCARP_HOST_DEVICE constexpr int take(int& counter) const { return counter++; }  ///< The former value.

  /// The numbers themselves.
  template <std::size_t Count>
  SCARP_HOST_DEVICE constexpr std::array<std::uint64_t, Count> largest(
      std::array<std::uint64_t, Count> const& bits) const {
    return bits;
  }

  /// Sums over all groups of lanes.
  template <std::size_t Count, class OfLane>
  SCARP_HOST_DEVICE constexpr std::array<double, Count> sum(OfLane const& of_lane) const {
    std::array<double, Count> total{};
    for (int group = 0; group < group_total; ++group) {
      auto const own = group_sum<Count>(of_lane, group);
      for (std::size_t k = 0; k < Count; ++k) total[k] += own[k];
    }
    return total;
  }

  /// Sums over one group of lanes, as a butterfly.
  template <std::size_t Count, class OfLane>
  static SCARP_HOST_DEVICE constexpr std::array<double, Count> group_sum(OfLane const& of_lane, int group) {
    constexpr auto lane_count = static_cast<std::size_t>(lane_group);
    std::array<std::array<double, Count>, lane_count> lanes{};
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      lanes[lane] = of_lane(group * lane_group + static_cast<int>(lane));
    for (std::size_t apart = lane_count / 2; apart > 0; apart /= 2) {
      auto const before = lanes;
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        for (std::size_t k = 0; k < Count; ++k) lanes[lane][k] = before[lane][k] + before[lane ^ apart][k];
      }
    }
    return lanes[0];
  }
};

static_assert(WorksTogether<OneThread>);

/// Calls visit(i) for every i below `count`; the threads of the team share the calls out among themselves.
template <class Team, class Visit>
SCARP_HOST_DEVICE constexpr void each(Team const& team, int count, Visit const& visit) {
#ifdef __CUDACC__
#pragma unroll 1  // a thread has few turns
#endif
  for (int i = team.rank(); i < count; i += team.size()) visit(i);
}

}  // namespace scarp
