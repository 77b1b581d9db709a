// SPDX-License-Identifier: BSL-1.0
// A small fault in packings whose points are shared out among MPI ranks: `mpirun -np 3 ground_on_ranks THREADS LENGTH
// [FOLDER [ATTEMPTS]]`.
// Prints the bits of the result and what each rank holds. Points look LENGTH [m] around themselves, 0: they are local;
// "wet": they are, and water fills their pores. With a folder it saves checkpoints there after every attempt and goes
// on from them; with a number of attempts it stops after so many.
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests asks for the rest
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <mpi.h>

#include <bit>
#include <cstdint>
#include <string_view>

#include "scarp/fault/saturated.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/points/nonlocal.hpp"
#include "scarp/run/checkpointed_run.hpp"
#include "scarp/solver/rank_executor.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/ground.hpp"

namespace {

struct Stop {
  int attempts;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {
    --attempts;
  }
  bool wants_stop() const { return attempts <= 0; }

  SCARP_MEMBERS_EXCEPT((attempts))
};

struct NoNotes {
  template <class Self, class Visit>
  static void members(Self&, Visit&&) {}
};

template <class Scene>
void rupture(Scene const& scene, int threads_of_a_rank, scarp::CheckpointFiles files, int attempts) {
  scarp::ThreadExecutor threads(threads_of_a_rank);
  scarp::RankExecutor executor(threads);
  auto problem = scene.problem(executor);
  scarp::OnRootRank observer(executor, [&] { return Stop{attempts}; });
  NoNotes notes;
  bool const resumes = files.resumes();
  scarp::CheckpointedRun stages(files, observer, notes);
  stages.stage([&] { return scene.settle(problem, stages); });
  stages.stage([&] { return scene.rupture(problem, stages); });
  auto const& run = stages.report();
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
  for (int point = 0; point < problem.points().size(); ++point) {
    if (problem.points().template state<samples::Sand::State>(point).packing.population != nullptr) ++packings;
  }
  if (executor.rank() == 0) {
    fmt::print("{} hash {:016x} iterations {} DEM steps {}\n", scarp::name(run.verdict.status), hash, run.iterations,
               run.inner_steps);
  }
  fmt::print(stderr, "rank {} of {} holds {} of {} packings, waited {:.3f} s\n", executor.rank(), executor.ranks(),
             packings, problem.points().size(), executor.seconds_sharing());
  if (resumes) fmt::print(stderr, "rank {} went on from a checkpoint\n", executor.rank());
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc < 3) {
    fmt::print(stderr, "usage: ground_on_ranks THREADS LENGTH|wet [FOLDER [ATTEMPTS]]\n");
    MPI_Finalize();
    return 2;
  }
  int const threads = std::atoi(argv[1]);
  bool const wet = std::string_view(argv[2]) == "wet";
  double const length = wet ? 0.0 : std::atof(argv[2]);
  scarp::CheckpointFiles files;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (argc > 3) {
    files = {{.folder = argv[3], .resume = true, .every_attempts = 1, .locks = rank == 0},
             fmt::format("length = {}\n", length)};
  }
  int const attempts = argc > 4 ? std::atoi(argv[4]) : 1000;
  auto const& ground = samples::sandy_ground();
  if (wet) {
    constexpr double void_ratio = 0.7;
    scarp::FaultScene<samples::Sand, scarp::Saturated<scarp::NoStructure>> scene;
    scene.soil = ground.soil;
    scene.ground = ground.ground;
    scene.unit_weight = ground.unit_weight + scarp::Water{}.lift(void_ratio);
    scene.throw_to = ground.throw_to;
    scene.solver = ground.solver;
    scene.structure.flow = scarp::KozenyCarman::of_conductivity(1e-4, void_ratio);
    scene.structure.void_ratio = void_ratio;
    scene.structure.shear_modulus = 1e7;
    rupture(scene, threads, std::move(files), attempts);
  } else if (length == 0.0) {
    rupture(ground, threads, std::move(files), attempts);
  } else {
    scarp::FreeFieldFault<scarp::Nonlocal<samples::Sand>> scene;
    scene.soil = {.provider = ground.soil, .length = length};
    scene.ground = ground.ground;
    scene.throw_to = ground.throw_to;
    scene.solver = ground.solver;
    rupture(scene, threads, std::move(files), attempts);
  }
  MPI_Finalize();
}
