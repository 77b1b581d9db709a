// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/solver/executor.hpp"

namespace scarp {

/// MPI for the life of a program; a program that fails on one rank calls abort, since the others wait for it.
/// \throws InputError for an MPI that cannot run beside threads
class MpiSession {
 public:
  MpiSession(int& argc, char**& argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
      MPI_Finalize();
      refuse(
          "MPI was asked to run beside threads of its ranks (this one cannot): take an MPI with MPI_THREAD_FUNNELED");
    }
  }
  MpiSession(MpiSession const&) = delete;
  MpiSession& operator=(MpiSession const&) = delete;
  ~MpiSession() { MPI_Finalize(); }

  [[noreturn]] static void abort(int exit_code) {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
  }
};

/// An MPI rank: all ranks run the same solver, each of them answers for every so-many-th point and holds the states of no others.
/// Gradients are known everywhere; only stresses, tangents and verdicts travel. Neighbouring points, whose packings
/// cost alike, belong to different ranks, so that work is shared out evenly. `Local` runs the tasks within the rank.
template <ExecutesTasks Local = SerialExecutor>
class RankExecutor {
 public:
  /// MPI must have been initialised (by MpiSession or by the program).
  explicit RankExecutor(Local& local, MPI_Comm communicator = MPI_COMM_WORLD)
      : local_(local), communicator_(communicator) {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised == 0)
      refuse("ranks were asked for before MPI was initialised (there is none yet): make an MpiSession");
    MPI_Comm_rank(communicator_, &rank_);
    MPI_Comm_size(communicator_, &ranks_);
  }

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  Local& local() const { return local_; }
  bool owns(int point) const { return point % ranks_ == rank_; }
  /// Wall time [s] that this rank has spent in share(), mostly waiting for slower ones.
  double seconds_sharing() const { return seconds_sharing_; }

  /// All tasks, on this rank.
  template <std::invocable<int> Task>
  void for_each(int count, Task&& task) const {
    local_.for_each(count, std::forward<Task>(task));
  }

  /// Values are sent as they lie in memory: ranks run the same binary on machines of one kind.
  template <class Value>
  void share(std::vector<Value>& values) {
    static_assert(std::is_trivially_destructible_v<Value>, "values that own memory cannot be sent as they lie in it");
    double const started = MPI_Wtime();
    auto const count = values.size();
    auto const ranks = static_cast<std::size_t>(ranks_);
    std::vector<int> lengths(ranks);
    std::vector<int> starts(ranks);
    for (std::size_t r = 0, at = 0; r < ranks; at += owned(count, r++)) {
      lengths[r] = static_cast<int>(owned(count, r) * sizeof(Value));
      starts[r] = static_cast<int>(at * sizeof(Value));
    }
    std::vector<std::byte> mine(detail::index(lengths[detail::index(rank_)]));
    std::byte* to = mine.data();
    for (auto k = detail::index(rank_); k < count; k += ranks, to += sizeof(Value)) {
      std::memcpy(to, &values[k], sizeof(Value));
    }
    std::vector<std::byte> all(count * sizeof(Value));
    MPI_Allgatherv(mine.data(), detail::count(mine), MPI_BYTE, all.data(), lengths.data(), starts.data(), MPI_BYTE,
                   communicator_);
    for (std::size_t r = 0; r < ranks; ++r) {
      std::byte const* from = all.data() + starts[r];
      for (std::size_t k = r; k < count; k += ranks, from += sizeof(Value)) {
        std::memcpy(static_cast<void*>(&values[k]), from, sizeof(Value));
      }
    }
    seconds_sharing_ += MPI_Wtime() - started;
  }

  /// What the first rank says.
  bool agree(bool said) const {
    int heard = said ? 1 : 0;
    MPI_Bcast(&heard, 1, MPI_INT, 0, communicator_);
    return heard != 0;
  }

  /// On the first rank: what the owner of a point answers while it serves.
  std::string ask(int point) const {
    int const owner = point % ranks_;
    MPI_Send(&point, 1, MPI_INT, owner, question, communicator_);
    MPI_Status status;
    MPI_Probe(owner, answer, communicator_, &status);
    int length = 0;
    MPI_Get_count(&status, MPI_BYTE, &length);
    std::string bytes(static_cast<std::size_t>(length), '\0');
    MPI_Recv(bytes.data(), length, MPI_BYTE, owner, answer, communicator_, MPI_STATUS_IGNORE);
    return bytes;
  }

  /// On the first rank: nothing more to ask, the others go on.
  void dismiss() const {
    int const nothing = -1;
    for (int other = 1; other < ranks_; ++other) MPI_Send(&nothing, 1, MPI_INT, other, question, communicator_);
  }

  /// On the others: answer(point) returns the bytes for each point that the first rank asks for, until it dismisses them.
  template <std::invocable<int> Answer>
  void serve(Answer const& answer_to) const {
    for (;;) {
      int point = -1;
      MPI_Recv(&point, 1, MPI_INT, 0, question, communicator_, MPI_STATUS_IGNORE);
      if (point < 0) return;
      std::string const bytes = answer_to(point);
      MPI_Send(bytes.data(), detail::count(bytes), MPI_BYTE, 0, answer, communicator_);
    }
  }

 private:
  static constexpr int question = 1;  // tags of messages
  static constexpr int answer = 2;

  /// Number of points among `count` that a rank owns.
  std::size_t owned(std::size_t count, std::size_t rank) const {
    auto const ranks = static_cast<std::size_t>(ranks_);
    return rank < count ? (count - rank + ranks - 1) / ranks : 0;
  }

  Local& local_;
  MPI_Comm communicator_;
  int rank_ = 0;
  int ranks_ = 1;
  double seconds_sharing_ = 0.0;
};

static_assert(SharesPoints<RankExecutor<>>);

}  // namespace scarp
