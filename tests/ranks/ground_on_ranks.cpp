// SPDX-License-Identifier: BSL-1.0
// A small fault in packings whose points are shared out among MPI ranks: `mpirun -np 3 ground_on_ranks`. Prints the bits of the result
// and what each rank holds.
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests asks for the rest
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <mpi.h>

#include <bit>
#include <cstdint>

#include "scarp/solver/rank_executor.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "scene/sample_ground.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  {
    auto scene = sample::sandy_ground();
    scarp::ThreadExecutor threads(argc > 1 ? std::atoi(argv[1]) : 1);
    scarp::RankExecutor executor(threads);
    auto problem = scene.problem(executor);
    scarp::NoObserver observer;
    auto run = scene.settle(problem, observer);
    if (run.verdict.acceptable()) run = scarp::joined(run, scene.rupture(problem, observer));
    auto const tangents = problem.committed_tangents();
    auto const stresses = problem.committed_stresses();
    std::uint64_t hash = 0;
    auto const take = [&hash](auto const& values) {
      for (double const value : values.reshaped()) hash = std::rotl(hash, 5) ^ std::bit_cast<std::uint64_t>(value);
    };
    for (auto const& position : problem.discretisation().positions()) take(position);
    for (auto const& stress : stresses) take(stress);
    for (auto const& tangent : tangents) take(tangent);
    int packings = 0;
    for (int point = 0; point < problem.materials().point_count(); ++point) {
      problem.materials().visit(point, [&](auto const& field, int local) {
        if (field.committed(local).packing.population != nullptr) ++packings;
      });
    }
    if (executor.rank() == 0) {
      fmt::print("{} hash {:016x} iterations {} DEM steps {}\n", scarp::name(run.verdict.status), hash, run.iterations,
                 run.inner_steps);
    }
    fmt::print(stderr, "rank {} of {} holds {} of {} packings, waited {:.3f} s\n", executor.rank(), executor.ranks(),
               packings, problem.materials().point_count(), executor.seconds_sharing());
  }
  MPI_Finalize();
}
