// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <atomic>
#include <barrier>
#include <thread>
#include <vector>

#include "scarp/dem/block/team.hpp"

namespace scarp {

/// Threads of the processor as a team: they run the program of a GPU's block, for machines without a card, for tests
/// and for race detectors.
class ProcessorTeam {
 public:
  using Memory = HostMemory;  ///< the processor's

  Memory memory() const { return {room_->shared}; }        ///< Memory that all threads share.
  int rank() const { return rank_; }                       ///< Number of the calling thread.
  int size() const { return room_->size; }                 ///< Number of threads.
  void barrier() const { room_->gate.arrive_and_wait(); }  ///< Returns when all threads have called it.
  int take(int& counter) const { return std::atomic_ref<int>(counter).fetch_add(1); }  ///< The former value.

  /// The largest of all threads' numbers.
  template <std::size_t Count>
  std::array<std::uint64_t, Count> largest(std::array<std::uint64_t, Count> const& bits) const {
    static_assert(Count <= Room::most_numbers);
    std::copy(bits.begin(), bits.end(), room_->numbers[static_cast<std::size_t>(rank_)].begin());
    barrier();
    auto most = bits;
    for (auto const& other : room_->numbers) {
      for (std::size_t k = 0; k < Count; ++k) most[k] = std::max(most[k], other[k]);
    }
    barrier();
    return most;
  }

  /// Sums over all groups of lanes, which the threads share out among themselves.
  template <std::size_t Count, class OfLane>
  std::array<double, Count> sum(OfLane const& of_lane) const {
    static_assert(Count <= Room::most_sums);
    auto& sums = room_->group_sums;
    for (int group = rank_; group < group_total; group += size()) {
      auto const own = OneThread::group_sum<Count>(of_lane, group);
      std::copy(own.begin(), own.end(), sums[static_cast<std::size_t>(group)].begin());
    }
    barrier();
    std::array<double, Count> total{};
    for (auto const& group : sums) {
      for (std::size_t k = 0; k < Count; ++k) total[k] += group[k];
    }
    barrier();
    return total;
  }

  /// Runs work(team) on so many threads, one of which is the caller. shared: has the size of a `BlockBench`
  template <class Work>
  static void run(int threads, std::byte* shared, Work const& work) {
    Room room(threads, shared);
    auto const as_member = [&](int rank) {
      ProcessorTeam team(room, rank);
      work(team);
    };
    std::vector<std::jthread> others;
    for (int rank = 1; rank < threads; ++rank) others.emplace_back(as_member, rank);
    as_member(0);
  }

 private:
  /// What the threads share.
  struct Room {
    static constexpr std::size_t most_numbers = 4;
    static constexpr std::size_t most_sums = 12;

    Room(int threads, std::byte* memory)
        : size(threads), shared(memory), gate(threads), numbers(static_cast<std::size_t>(threads)) {}

    int size;
    std::byte* shared;
    std::barrier<> gate;
    std::vector<std::array<std::uint64_t, most_numbers>> numbers;
    std::array<std::array<double, most_sums>, static_cast<std::size_t>(group_total)> group_sums{};
  };

  ProcessorTeam(Room& room, int rank) : room_(&room), rank_(rank) {}

  Room* room_;
  int rank_;
};

static_assert(WorksTogether<ProcessorTeam>);

}  // namespace scarp
