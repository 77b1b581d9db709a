// SPDX-License-Identifier: BSL-1.0
#include "cuda/block_on_threads.hpp"

#include "scarp/cuda/cuda_team.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "dem/block/block_samples.hpp"
#include "scarp/dem/block/block_device.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "support/packings.hpp"

namespace {

using Grains = samples::Ellipses;
using Types = scarp::BlockTypesOf<Grains>;
using State = scarp::BlockState<Types>;
using Bytes = scarp::AlignedVector<std::byte>;

template <int Threads>
Bytes respond_on_block(Bytes& committed, scarp::BlockSize of_committed, scarp::BlockSize size,
                       scarp::BlockGrains<Types> const& grains, scarp::detail::SmallTensor<2> const& strain_step,
                       int steps) {
  Bytes trial(State::bytes(size));
  emulated::run(Threads, [&] {
    using Team = scarp::CudaTeam<Threads>;
    Team const team;
    scarp::BlockProgram<Types, scarp::LocalDamping, Team> program(team, size, grains, samples::study_law(), {},
                                                                  scarp::default_time_step_share);
    program.respond(State(committed.data(), of_committed), State(trial.data(), size), steps, strain_step);
  });
  return trial;
}

}  // namespace

TEST_CASE("a block of a card, emulated, has the bits of one thread") {
  auto packing = samples::consolidated<Grains>(60).packing;
  auto const law = samples::study_law();
  scarp::TimeStepper<Grains> stepper;
  scarp::StepObservation<2> seen;
  REQUIRE(stepper.observe(packing, law, seen).acceptable());
  auto const size = blocks::roomy(packing);
  auto const grains = scarp::block_grains<Types::Shape, Types::Law>(*packing.population);
  Bytes committed(State::bytes(size));
  scarp::to_block(packing, State(committed.data(), size));
  // Fast enough for new lists.
  scarp::detail::SmallTensor<2> const strain_step{3e-4, 2e-4, 0.0, -4e-4};
  constexpr int steps = 40;
  Bytes alone(committed.size());
  Bytes bench(scarp::BlockBench<Types, scarp::HostMemory>::bytes(size));
  scarp::OneThread const one{bench.data()};
  scarp::BlockProgram<Types, scarp::LocalDamping, scarp::OneThread> program(one, size, grains, law, {},
                                                                            scarp::default_time_step_share);
  program.respond(State(committed.data(), size), State(alone.data(), size), steps, strain_step);
  REQUIRE(State(alone.data(), size).header->trouble == scarp::Trouble::none);
  REQUIRE(State(alone.data(), size).header->lists > 0);
  CHECK(respond_on_block<32>(committed, size, size, grains, strain_step, steps) == alone);
  CHECK(respond_on_block<128>(committed, size, size, grains, strain_step, steps) == alone);
  // A state may come from a smaller room than its response goes to.
  scarp::BlockSize const smaller{size.grains, static_cast<int>(packing.pairs.count())};
  Bytes narrow(State::bytes(smaller));
  scarp::to_block(packing, State(narrow.data(), smaller));
  CHECK(respond_on_block<32>(narrow, smaller, size, grains, strain_step, steps) == alone);
}
