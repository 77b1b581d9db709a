// SPDX-License-Identifier: BSL-1.0
// What one rank throws ends all ranks with its words: `mpirun -np 3 failing_ranks WHO`, where WHO throws: "task" (of a
// point of rank 1), "first" (the root rank, while the others serve), "answer" (rank 2, when it is asked) or "nobody";
// "file": the root cannot write a file of a run, which stops on all ranks.
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests asks for the rest
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "runs/watched_block.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/solver/rank_executor.hpp"

namespace {

struct FullDisk {
  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const& report) {
    if (report.step == 2) throw scarp::FileError("cannot write 'rows.csv'");
  }
  bool wants_stop() const { return false; }

  template <class Self, class Visit>
  static void members(Self&, Visit&&) {}
};

void stop_by_file() {
  scarp::SerialExecutor serial;
  scarp::RankExecutor executor(serial);
  auto problem = watched::block(scarp::LinearElastic<2>::from_young_poisson(1e7, 0.3), executor);
  scarp::OnRootRank observer(executor, [] { return FullDisk{}; });
  watched::NoNotes notes;
  scarp::CheckpointFiles files;
  scarp::CheckpointedRun run(files, observer, notes);
  scarp::LoadStepping const stepping{.first = 1e-4, .largest = 1e-4};
  run.stage([&] { return stepping.run(scarp::QuasiNewton<>{}, problem, 0.0, 1e-3, run); });
  if (run.report().verdict.reason != scarp::Reason::interrupted || run.report().steps != 2 || !run.stopped())
    throw std::logic_error("the run has not stopped");
  if (executor.rank() == 0 && run.trouble() != "cannot write 'rows.csv'") throw std::logic_error("the words are lost");
}

void run(std::string_view who) {
  scarp::SerialExecutor serial;
  scarp::RankExecutor executor(serial);
  std::vector<scarp::Response<2>> answers(7);
  executor.together([&] {
    for (int point = 0; point < 7; ++point) {
      if (!executor.owns(point)) continue;
      if (who == "task" && point == 1) throw std::runtime_error("point 1 has no packing");
      answers[static_cast<std::size_t>(point)] = {scarp::VoigtStress<2>::Constant(point), {}};
    }
  });
  executor.share(answers);
  std::vector<long> works(7, executor.rank());
  executor.share(works);
  for (int point = 0; point < 7; ++point) {
    if (answers[static_cast<std::size_t>(point)].stress(1) != point) throw std::logic_error("an answer is lost");
    if (works[static_cast<std::size_t>(point)] != point % executor.ranks()) throw std::logic_error("a number is lost");
  }
  executor.on_first(
      [&] {
        if (who == "first") throw std::runtime_error("the log cannot be written");
        if (executor.fetch(2) != "2") throw std::logic_error("an answer is wrong");
      },
      [&](int point) {
        if (who == "answer") throw std::runtime_error("the state cannot be read");
        return std::to_string(point);
      });
}

}  // namespace

int main(int argc, char** argv) {
  scarp::MpiSession const session(argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    std::string_view const who = argc > 1 ? argv[1] : "nobody";
    who == "file" ? stop_by_file() : run(who);
  } catch (std::exception const& error) {
    fmt::print("rank {}: {}\n", rank, error.what());
    return 1;
  }
  fmt::print("rank {}: done\n", rank);
}
