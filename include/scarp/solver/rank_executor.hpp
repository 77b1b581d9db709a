// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// MPI for the life of a program; a program that fails on one rank calls abort, since the others wait for it.
/// \throws InputError for an MPI that cannot run with threads
class MpiSession {
 public:
  /// Initialises MPI, which may remove its own arguments from the program's.
  MpiSession(int& argc, char**& argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
      MPI_Finalize();
      reject("MPI was requested with threads of its ranks (this one cannot): use an MPI with MPI_THREAD_FUNNELED");
    }
  }
  MpiSession(MpiSession const&) = delete;
  MpiSession& operator=(MpiSession const&) = delete;
  ~MpiSession() { MPI_Finalize(); }

  /// Ends the program on all ranks.
  [[noreturn]] static void abort(int exit_code) {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
  }
};

/// An MPI rank: all ranks run the same solver, points are distributed cyclically, each rank holds the states of its
/// own. Gradients are known everywhere; only stresses, tangents and verdicts travel. Neighbouring points, whose
/// packings cost alike, belong to different ranks, so that work is shared out evenly. Another executor runs the tasks
/// within the rank.
class RankExecutor : public Executor {
 public:
  /// MPI must have been initialised (by MpiSession or by the program).
  explicit RankExecutor(Executor& local, MPI_Comm communicator = MPI_COMM_WORLD)
      : local_(local), communicator_(communicator) {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised == 0)
      reject("ranks were requested before MPI was initialised (there is none yet): make an MpiSession");
    MPI_Comm_rank(communicator_, &rank_);
    MPI_Comm_size(communicator_, &ranks_);
  }

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  int threads() const override { return local_.threads(); }
  /// Wall time [s] that this rank has spent in exchanges, mostly waiting for slower ones.
  double seconds_sharing() const { return seconds_sharing_; }

  /// All tasks, on this rank.
  void for_each(int count, std::function<void(int)> const& task) const override { local_.for_each(count, task); }

  /// Work that all ranks begin alike. What it throws on one of them is thrown on all: there as it is, elsewhere as
  /// InputError with the same words and the rank.
  void together(std::function<void()> const& work) const override {
    std::exception_ptr own;
    std::string words;
    try {
      work();
    } catch (std::exception const& error) {
      own = std::current_exception();
      words = error.what();
    } catch (...) {
      own = std::current_exception();
      words = "an exception without words";
    }
    int const mine = own ? rank_ : ranks_;
    int first = ranks_;
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, communicator_);
    if (first == ranks_) return;
    int length = detail::count(words);
    MPI_Bcast(&length, 1, MPI_INT, first, communicator_);
    words.resize(static_cast<std::size_t>(length));
    MPI_Bcast(words.data(), length, MPI_CHAR, first, communicator_);
    if (own) std::rethrow_exception(own);
    reject("rank {} has stopped ({}): see the messages of that rank", first, words);
  }

  bool agree(bool flag) const override {
    int roots = flag ? 1 : 0;
    MPI_Bcast(&roots, 1, MPI_INT, 0, communicator_);
    return roots != 0;
  }

  std::string fetch(int point) const override {
    int const owner = point % ranks_;
    MPI_Send(&point, 1, MPI_INT, owner, request, communicator_);
    MPI_Status status;
    MPI_Probe(owner, MPI_ANY_TAG, communicator_, &status);
    int length = 0;
    MPI_Get_count(&status, MPI_BYTE, &length);
    std::string bytes(static_cast<std::size_t>(length), '\0');
    MPI_Recv(bytes.data(), length, MPI_BYTE, owner, status.MPI_TAG, communicator_, MPI_STATUS_IGNORE);
    if (status.MPI_TAG == failure)
      reject("rank {} cannot return point {} ({}): see the messages of that rank", owner, point, bytes);
    return bytes;
  }

  void on_first(std::function<void()> const& task, std::function<std::string(int)> const& bytes_of) const override {
    together([&] {
      if (rank_ != 0) return serve(bytes_of);
      struct Dismissal {
        RankExecutor const& executor;
        ~Dismissal() {
          int const nothing = -1;
          for (int other = 1; other < executor.ranks_; ++other)
            MPI_Send(&nothing, 1, MPI_INT, other, request, executor.communicator_);
        }
      } const dismissal{*this};
      task();
    });
  }

 private:
  static constexpr int request = 1;  // tags of messages
  static constexpr int reply = 2;
  static constexpr int failure = 3;

  /// The bytes of numbers are sent: ranks run the same binary on machines of one kind.
  void exchange(Shared const& values) const override {
    double const started = MPI_Wtime();
    auto const ranks = static_cast<std::size_t>(ranks_);
    // Counted in values: of those there are no more than an int can count, of their bytes perhaps.
    std::vector<int> lengths(ranks);
    std::vector<int> starts(ranks);
    for (std::size_t r = 0, at = 0; r < ranks; at += owned(values.count, r++)) {
      lengths[r] = static_cast<int>(owned(values.count, r));
      starts[r] = static_cast<int>(at);
    }
    std::vector<std::byte> mine(owned(values.count, detail::index(rank_)) * values.bytes);
    std::byte* to = mine.data();
    for (auto k = detail::index(rank_); k < values.count; k += ranks, to += values.bytes) values.write(k, to);
    std::vector<std::byte> all(values.count * values.bytes);
    MPI_Datatype one;
    MPI_Type_contiguous(static_cast<int>(values.bytes), MPI_BYTE, &one);
    MPI_Type_commit(&one);
    MPI_Allgatherv(mine.data(), lengths[detail::index(rank_)], one, all.data(), lengths.data(), starts.data(), one,
                   communicator_);
    MPI_Type_free(&one);
    for (std::size_t r = 0; r < ranks; ++r) {
      std::byte const* from = all.data() + static_cast<std::size_t>(starts[r]) * values.bytes;
      for (std::size_t k = r; k < values.count; k += ranks, from += values.bytes) values.read(k, from);
    }
    seconds_sharing_ += MPI_Wtime() - started;
  }

  /// Until the root rank has no more requests; then what a request has thrown is thrown.
  void serve(std::function<std::string(int)> const& bytes_of) const {
    std::exception_ptr thrown;
    for (;;) {
      int point = -1;
      MPI_Recv(&point, 1, MPI_INT, 0, request, communicator_, MPI_STATUS_IGNORE);
      if (point < 0) break;
      std::string bytes;
      int tag = reply;
      try {
        bytes = bytes_of(point);
        if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
          reject("the state of point {} has {} bytes (MPI sends no more than {} at once): make it smaller", point,
                 bytes.size(), std::numeric_limits<int>::max());
        }
      } catch (std::exception const& error) {
        thrown = std::current_exception();
        bytes = error.what();
        tag = failure;
      }
      MPI_Send(bytes.data(), detail::count(bytes), MPI_BYTE, 0, tag, communicator_);
    }
    if (thrown) std::rethrow_exception(thrown);
  }

  /// Number of points among `count` that a rank owns.
  std::size_t owned(std::size_t count, std::size_t rank) const {
    auto const ranks = static_cast<std::size_t>(ranks_);
    return rank < count ? (count - rank + ranks - 1) / ranks : 0;
  }

  Executor const& local_;
  MPI_Comm communicator_;
  int rank_ = 0;
  int ranks_ = 1;
  mutable double seconds_sharing_ = 0.0;
};

}  // namespace scarp
