// SPDX-License-Identifier: BSL-1.0
// What one rank throws ends all ranks with its words: `mpirun -np 3 failing_ranks WHO`, where WHO throws: "task" (of a point of rank 1),
// "first" (the root rank, while the others serve), "answer" (rank 2, when it is asked) or "nobody".
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests asks for the rest
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "scarp/solver/rank_executor.hpp"

namespace {

void run(std::string_view who) {
  scarp::SerialExecutor serial;
  scarp::RankExecutor<> executor(serial);
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
    run(argc > 1 ? argv[1] : "nobody");
  } catch (std::exception const& error) {
    fmt::print("rank {}: {}\n", rank, error.what());
    return 1;
  }
  fmt::print("rank {}: done\n", rank);
}
