// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/block/block_device.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "block_samples.hpp"

namespace {

using Grains = samples::Ellipses;
using Types = scarp::BlockTypesOf<Grains>;
using State = scarp::BlockState<Types>;
using Device = scarp::ProcessorDevice<Types, scarp::LocalDamping>;

}  // namespace

TEST_CASE("the processor in a card's place has room for grains and a longer list in whole packs") {
  Device const device;
  CHECK_FALSE(device.takes_many());
  CHECK(device.free_bytes() == std::numeric_limits<std::size_t>::max());
  auto const is = [&](int grains, int pairs, int of_grains, int of_pairs) {
    auto const room = device.room(grains, pairs);
    REQUIRE(room.has_value());
    CHECK(room->grains == of_grains);
    CHECK(room->pairs == of_pairs);
  };
  is(57, 200, 64, 256);  // a quarter more pairs
  is(64, 96, 64, 128);   // two pairs of each grain at least
  is(65'535, 32'760, 65'536, 32'760);
  CHECK_FALSE(device.room(65'536, 8));
  CHECK_FALSE(device.room(8, 32'761));
}

TEST_CASE("the processor in a card's place responds to every task as the block program does") {
  auto const law = samples::study_law();
  blocks::Sample<Grains> const sample(blocks::pressed<Grains>(law, 60), law);
  blocks::Bytes committed = sample.state(sample.packing);
  Device device;
  auto const grains = device.grains(sample.packing.population);
  auto const before = device.allocate(committed.size());
  device.write(committed, before.get());
  std::array const trials{device.allocate(committed.size()), device.allocate(committed.size())};
  std::array const strain_steps{blocks::shear_step<2>(1e-5), blocks::shear_step<2>(-2e-5)};
  std::vector<scarp::BlockTask<Types>> tasks;
  for (std::size_t k = 0; k < 2; ++k)
    tasks.push_back({State(before.get(), sample.size), State(trials[k].get(), sample.size), grains,
                     20 + static_cast<int>(k), scarp::detail::row_by_row<2>(strain_steps[k])});
  std::array<Device::Header, 2> headers;
  device.respond(tasks, {.law = law, .damping = {}, .time_step_share = scarp::default_time_step_share}, headers);
  for (std::size_t k = 0; k < 2; ++k) {
    blocks::Bytes found(committed.size());
    device.read(trials[k].get(), found);
    auto const expected = sample.respond(committed, strain_steps[k], 20 + static_cast<int>(k), 0);
    CHECK(std::memcmp(found.data(), expected.data(), expected.size()) == 0);
    CHECK(std::memcmp(&headers[k], found.data(), sizeof headers[k]) == 0);
  }
}
