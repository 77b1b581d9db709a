// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "scarp/core/process.hpp"
#include "scarp/run/root_rank.hpp"
#include "scarp/solver/thread_executor.hpp"
#ifdef SCARP_WITH_RANKS
#include "scarp/solver/rank_executor.hpp"
#endif

/// Who computes: the threads of one process or, in a build with ranks, those of several processes.
namespace fault_rupture {

#ifdef SCARP_WITH_RANKS
using Team = scarp::RankExecutor;
using Session = scarp::MpiSession;
inline int ranks() {
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}
inline int rank() {
  int own = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  return own;
}
/// Ranks share the machine's processors unless a number is requested.
inline int threads_of_a_process(int asked) {
  int const share = static_cast<int>(std::thread::hardware_concurrency()) / ranks();
  return asked > 0 ? asked : std::clamp(share, 1, scarp::usable_processors());
}
inline Team make_team(scarp::ThreadExecutor& threads) { return Team(threads); }
[[noreturn]] inline void give_up(int exit_code) { scarp::MpiSession::abort(exit_code); }  // others may be waiting
#else
using Team = scarp::ThreadExecutor;
struct Session {
  Session(int&, char**&) {}
};
inline int ranks() { return 1; }
inline int rank() { return 0; }
inline int threads_of_a_process(int asked) { return asked; }
inline Team& make_team(scarp::ThreadExecutor& threads) { return threads; }
[[noreturn]] inline void give_up(int exit_code) { std::exit(exit_code); }
#endif

}  // namespace fault_rupture
