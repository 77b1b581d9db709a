// SPDX-License-Identifier: BSL-1.0
// States of all kinds on MPI ranks: `mpirun -np 2 states_on_ranks FOLDER` pulls a block of each nesting of adaptors, in
// one go and in parts from checkpoints, both with observers on the root rank, and prints a hash of all that was seen.
#define DOCTEST_CONFIG_IMPLEMENT  // without doctest's main(), but what it shares with the tests asks for the rest
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <mpi.h>

#include <functional>

#include "runs/watched_block.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/solver/rank_executor.hpp"
#include "support/packings.hpp"

namespace {

using Discs = samples::Discs;

/// FNV-1a
std::uint64_t hash_of(watched::Outcome const& outcome) {
  std::uint64_t hash = 14695981039346656037ULL;
  auto const take = [&](std::string const& text) {
    for (char const letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  };
  take(outcome.states);
  for (auto const& [file, text] : outcome.files) {
    take(file);
    take(text);
  }
  return hash;
}

}  // namespace

int main(int argc, char** argv) {
  scarp::MpiSession const session(argc, argv);
  if (argc != 2) {
    fmt::print(stderr, "usage: states_on_ranks FOLDER\n");
    return 2;
  }
  scarp::SerialExecutor serial;
  scarp::RankExecutor executor(serial);
  int number = 0;
  auto const pull = [&](std::string const& name, auto const& provider, watched::Pull const& wanted) {
    auto const folder = std::filesystem::path(argv[1]) / std::to_string(number++);
    auto const whole = watched::pull(provider, executor, folder / "whole", wanted);
    auto const parts = watched::pull_in_parts(provider, executor, folder / "parts", wanted);
    if (executor.rank() != 0) return;
    bool const same = parts.states == whole.states && parts.files == whole.files && parts.budget == whole.budget &&
                      !whole.states.empty();
    fmt::print("{}: {} in {} steps, hash {:016x}, in parts {}\n", name, scarp::name(whole.report.verdict.status),
               whole.report.steps, hash_of(whole), same ? "the same" : "another");
  };
  try {
    watched::for_each_case(pull);
    scarp::DemRve<Discs, scarp::SamePacking<Discs>> const packing{
        .law = samples::study_law(), .source = {samples::triangular_lattice<Discs>(4, 5e-3, 0.998e-2)}};
    pull("VariedParameters around packings, in the open", nestings::Varied::around(packing),
         {.to = 2e-4, .tolerance = 3e-2});
  } catch (std::exception const& error) {
    fmt::print(stderr, "rank {}: {}\n", executor.rank(), error.what());
    scarp::MpiSession::abort(1);
  }
}
