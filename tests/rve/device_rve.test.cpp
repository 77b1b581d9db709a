// SPDX-License-Identifier: BSL-1.0
#include "scarp/rve/device_rve.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <optional>
#include <stdexcept>

#include "scarp/constitutive/stiffness_floor.hpp"
#include "scarp/constitutive/varied_parameters.hpp"
#include "scarp/core/interruption.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using Grains = samples::Ellipses;
using Rve = scarp::DemRve<Grains, scarp::SamePacking<Grains>>;
using OnDevice = scarp::DeviceRve<Rve>;
using Processor = scarp::ProcessorDevice<OnDevice::Types, OnDevice::Damping>;

/// The processor behind a device of which a test changes one thing.
struct Behind : scarp::BlockDevice<OnDevice::Types, OnDevice::Damping> {
  Processor processor;
  bool takes_many() const override { return false; }
  std::optional<scarp::BlockSize> room(int grains, int pairs) const override { return processor.room(grains, pairs); }
  std::size_t free_bytes() const override { return processor.free_bytes(); }
  Bytes allocate(std::size_t bytes) override { return processor.allocate(bytes); }
  void write(std::span<std::byte const> from, std::byte* to) override { processor.write(from, to); }
  void read(std::byte const* from, std::span<std::byte> to) override { processor.read(from, to); }
  scarp::BlockGrains<Types> grains(std::shared_ptr<Grains const> const& population) override {
    return processor.grains(population);
  }
  void respond(std::span<scarp::BlockTask<Types> const> tasks, scarp::BlockParameters<Types, Damping> const& parameters,
               std::span<Header> headers) override {
    processor.respond(tasks, parameters, headers);
  }
};

/// Wants all points at once, and counts them.
struct TakesMany final : Behind {
  std::size_t most = 0;
  bool takes_many() const override { return true; }
  void respond(std::span<scarp::BlockTask<Types> const> tasks, scarp::BlockParameters<Types, Damping> const& parameters,
               std::span<Header> headers) override {
    most = std::max(most, tasks.size());
    Behind::respond(tasks, parameters, headers);
  }
};

/// Has room for no longer list, and counts the lists that were too long.
struct Narrow final : Behind {
  int most = 1'000'000;  // pairs that it has room for
  int full = 0;
  std::optional<scarp::BlockSize> room(int grains, int pairs) const override {
    if (pairs > most) return std::nullopt;
    return scarp::BlockSize{processor.room(grains, pairs)->grains, pairs};
  }
  void respond(std::span<scarp::BlockTask<Types> const> tasks, scarp::BlockParameters<Types, Damping> const& parameters,
               std::span<Header> headers) override {
    Behind::respond(tasks, parameters, headers);
    for (auto const& header : headers) full += header.trouble == scarp::Trouble::list_full ? 1 : 0;
  }
};

/// Forgets the friction.
struct Wrong final : Behind {
  void respond(std::span<scarp::BlockTask<Types> const> tasks, scarp::BlockParameters<Types, Damping> const& parameters,
               std::span<Header> headers) override {
    auto without_shear = parameters;
    without_shear.law.tangential_stiffness = 0.0;
    Behind::respond(tasks, without_shear, headers);
  }
};

Rve rve(int grains = 80) {
  return {.law = samples::study_law(), .source = {samples::consolidated<Grains>(grains).packing}};
}

scarp::Gradient<2> increment(double size) {
  scarp::Gradient<2> gradient;
  gradient << size, 0.4 * size, 0.2 * size, -1.5 * size;
  return gradient;
}

std::vector<scarp::Site<2>> sites(int count) {
  std::vector<scarp::Site<2>> made(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) made[static_cast<std::size_t>(k)].index = k;
  return made;
}

/// Load steps of points that all have another increment; the points as they are in the end.
template <class Material>
scarp::MaterialPoints<2> strained(Material const& material, int count, int load_steps, scarp::Executor& executor) {
  scarp::MaterialPoints<2> points(material, sites(count));
  for (int step = 0; step < load_steps; ++step) {
    for (int k = 0; k < count; ++k) points.gradient(k) = increment(1e-4 * (k + 1));
    REQUIRE(points.respond(executor).verdict.acceptable());
    points.commit();
  }
  return points;
}

double difference(scarp::MaterialPoints<2> const& a, scarp::MaterialPoints<2> const& b) {
  double most = 0.0;
  for (int k = 0; k < a.size(); ++k)
    most = std::max(most, (a.committed_stress(k) - b.committed_stress(k)).norm() / a.committed_stress(k).norm());
  return most;
}

bool are_equal(scarp::MaterialPoints<2> const& a, scarp::MaterialPoints<2> const& b) {
  for (int k = 0; k < a.size(); ++k) {
    if (a.committed_stress(k) != b.committed_stress(k) || a.pack(k) != b.pack(k)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("points on a device plan, respond, show and are tangent as on the processor") {
  scarp::ThreadExecutor executor(2);
  auto const reference = strained(rve(), 3, 4, executor);
  OnDevice const on_device{rve(), std::make_shared<Processor>()};
  auto const points = strained(on_device, 3, 4, executor);
  CHECK(difference(reference, points) < 1e-9);
  for (int k = 0; k < 3; ++k) {
    CHECK(points.work(k) == reference.work(k));
    auto const tangent = reference.committed_tangent(k);
    CHECK((points.committed_tangent(k) - tangent).norm() < 1e-6 * tangent.norm());
    auto const expected = reference.quantities(k);
    auto const found = points.quantities(k);
    REQUIRE(found.size() == expected.size());
    for (std::size_t q = 0; q < found.size(); ++q) {
      CHECK(found[q].first == expected[q].first);
      CHECK(found[q].second == samples::Approx(expected[q].second).epsilon(1e-6));
    }
    CHECK(points.packing_balance(k).has_packing);
    CHECK(points.packing_balance(k).unbalanced_ratio ==
          samples::Approx(reference.packing_balance(k).unbalanced_ratio).epsilon(1e-5));
    CHECK(points.picture<scarp::PackingPicture>(k).has_value());
  }
}

TEST_CASE("a device that takes many points gets all of them in one call, also through adaptors") {
  scarp::ThreadExecutor executor(2);
  OnDevice on_device{rve(), std::make_shared<Processor>()};
  auto const alone = strained(scarp::StiffnessFloor<OnDevice>{on_device}, 4, 2, executor);
  auto const device = std::make_shared<TakesMany>();
  on_device.device = device;
  auto const together = strained(scarp::StiffnessFloor<OnDevice>{on_device}, 4, 2, executor);
  CHECK(are_equal(alone, together));
  CHECK(device->most == 4);
  SUBCASE("with parameters of each point") {
    scarp::VariedParameters<OnDevice> const varied{on_device, [](OnDevice common, scarp::Site<2> const& site) {
                                                     common.rve.law.friction = 0.4 + 0.05 * site.index;
                                                     return common;
                                                   }};
    auto const points = strained(varied, 3, 2, executor);
    scarp::VariedParameters<Rve> const reference{rve(), [](Rve common, scarp::Site<2> const& site) {
                                                   common.law.friction = 0.4 + 0.05 * site.index;
                                                   return common;
                                                 }};
    CHECK(difference(strained(reference, 3, 2, executor), points) < 1e-9);
  }
}

TEST_CASE("points go on from what was saved on a device or on the processor") {
  scarp::SerialExecutor executor;
  auto const source = rve();
  OnDevice const on_device{source, std::make_shared<Processor>()};
  auto const go_on = [&](auto const& material, std::string const& bits) {
    scarp::MaterialPoints<2> points(material, sites(1));
    points.unpack(0, bits);
    points.gradient(0) = increment(2e-4);
    REQUIRE(points.respond(executor).verdict.acceptable());
    points.commit();
    return points;
  };
  auto points = strained(on_device, 1, 2, executor);
  auto const bits = points.pack(0);
  points.gradient(0) = increment(2e-4);
  REQUIRE(points.respond(executor).verdict.acceptable());
  points.commit();
  CHECK(are_equal(points, go_on(on_device, bits)));
  CHECK(difference(points, go_on(source, bits)) < 1e-9);
  auto const of_processor = strained(source, 1, 2, executor).pack(0);
  CHECK(difference(points, go_on(on_device, of_processor)) < 1e-8);
}

TEST_CASE("a mirrored packing goes to the device as its image") {
  scarp::SerialExecutor executor;
  OnDevice const on_device{rve(), std::make_shared<Processor>()};
  auto points = strained(on_device, 2, 2, executor);
  auto const stress = points.committed_stress(1);
  points.copy(0, points, 1, true);
  CHECK((points.committed_stress(0) - stress).norm() < 1e-9 * stress.norm());
  points.gradient(0) = points.gradient(1) = increment(1e-4);
  REQUIRE(points.respond(executor).verdict.acceptable());
  points.commit();
  CHECK(points.committed_stress(0) != points.committed_stress(1));
  CHECK((points.committed_stress(0) - points.committed_stress(1)).norm() < 0.05 * stress.norm());
}

TEST_CASE("verdicts of a device are the provider's") {
  auto source = rve();
  source.inertial_number = 1.0;
  source.unbalanced_tolerance = 0.5;
  OnDevice const on_device{source, std::make_shared<Processor>()};
  auto const state = on_device.initial_state({});
  OnDevice::State trial;
  auto const verdict = [&](scarp::Gradient<2> const& gradient, int steps) {
    auto const found = on_device.respond(state, gradient, trial, steps).verdict;
    Rve::State own;
    CHECK(found == on_device.rve.respond(state.whole(), gradient, own, steps).verdict);
    return found;
  };
  CHECK(verdict(increment(1e-4), 20) == scarp::Verdict{});
  CHECK(verdict(increment(1e-2), 20).reason == scarp::Reason::too_few_steps);
  CHECK(verdict(increment(std::nan("")), 20).reason == scarp::Reason::not_finite);
  scarp::Gradient<2> apart = scarp::Gradient<2>::Zero();
  apart(0, 0) = apart(1, 1) = 0.02;
  CHECK(verdict(apart, 200).status == scarp::Status::fluid);
  scarp::Gradient<2> deep = scarp::Gradient<2>::Zero();
  deep(0, 0) = deep(1, 1) = -0.3;
  CHECK(verdict(deep, 2000).status == scarp::Status::failed);
}

TEST_CASE("a packing whose list the device has no room for responds on the processor, and returns to the device") {
  auto const device = std::make_shared<Narrow>();
  OnDevice const on_device{rve(), device};
  auto state = on_device.initial_state({});
  auto own = state.whole();
  scarp::Gradient<2> const compressed = -1e-2 * scarp::Gradient<2>::Identity();
  for (int step = 0; step < 4; ++step) {
    REQUIRE(scarp::advance(on_device, state, compressed).verdict.acceptable());
    REQUIRE(scarp::advance(on_device.rve, own, compressed).verdict.acceptable());
    CHECK((on_device.stress(state) - own.stress).norm() < 1e-6 * own.stress.norm());
  }
  CHECK(device->full > 0);
  CHECK(device->full < 4);
}

TEST_CASE("a packing that outgrows the device responds on the processor from then on") {
  auto const device = std::make_shared<Narrow>();
  OnDevice const on_device{rve(), device};
  auto state = on_device.initial_state({});
  device->most = static_cast<int>(state.whole().packing.pairs.count());
  auto own = state.whole();
  scarp::Gradient<2> const compressed = -1e-2 * scarp::Gradient<2>::Identity();
  for (int step = 0; step < 6; ++step) {
    REQUIRE(scarp::advance(on_device, state, compressed).verdict.acceptable());
    REQUIRE(scarp::advance(on_device.rve, own, compressed).verdict.acceptable());
    CHECK((on_device.stress(state) - own.stress).norm() < 1e-6 * own.stress.norm());
    CHECK((on_device.tangent(state) - on_device.rve.tangent(own)).norm() < 1e-6 * on_device.tangent(state).norm());
  }
  CHECK(static_cast<int>(state.whole().packing.pairs.count()) > device->most);
  device->most = 10;
  CHECK_THROWS_WITH_AS(on_device.initial_state({}), doctest::Contains("the device has no such room"),
                       scarp::InputError);
}

TEST_CASE("a device that responds otherwise than the processor is refused") {
  OnDevice const on_device{rve(), std::make_shared<Wrong>()};
  CHECK_THROWS_WITH_AS(on_device.initial_state({}), doctest::Contains("write `constexpr` before every function"),
                       scarp::InputError);
  CHECK_THROWS_WITH_AS((OnDevice{rve(), nullptr}.initial_state({})), doctest::Contains("no device"), scarp::InputError);
}

TEST_CASE("a state of a point with another law goes on by the law of its new point") {
  scarp::SerialExecutor serial;
  auto const device = std::make_shared<Processor>();
  Rve const soft = rve();
  Rve hard = soft;
  hard.law.tangential_stiffness *= 30.0;
  std::vector<int> const of{0, 1};
  std::vector<scarp::MaterialPoints<2>> found;
  for (bool const on_device : {false, true}) {
    using Any = scarp::AnyProvider<2>;
    std::vector<Any> const materials{on_device ? Any(OnDevice{soft, device}) : Any(soft),
                                     on_device ? Any(OnDevice{hard, device}) : Any(hard)};
    scarp::MaterialPoints<2> points(materials, of, sites(2), {}, [](int) { return true; });
    for (int step = 0; step < 2; ++step) {
      for (int k = 0; k < 2; ++k) points.gradient(k) = increment(1e-4);
      REQUIRE(points.respond(serial).verdict.acceptable());
      points.commit();
      if (step == 0) points.copy(1, points, 0);
    }
    found.push_back(points);
  }
  CHECK(difference(found[0], found[1]) < 1e-9);
  CHECK((found[0].committed_tangent(1) - found[1].committed_tangent(1)).norm() <
        1e-9 * found[0].committed_tangent(1).norm());
}

TEST_CASE("points with parameters of their own respond by these without a plan too") {
  scarp::SerialExecutor serial;
  scarp::VariedParameters<OnDevice> const soil{OnDevice{rve(), std::make_shared<Processor>()},
                                               [](OnDevice own, scarp::Site<2> const& site) {
                                                 own.rve.law.friction = site.index == 0 ? 0.2 : 0.6;
                                                 return own;
                                               }};
  std::vector<std::vector<scarp::VoigtStress<2>>> found;
  for (bool const is_planned : {true, false}) {
    scarp::MaterialPoints<2> points(soil, sites(2));
    points.set_gradients(std::vector(2, increment(5e-4)), serial);
    if (is_planned) points.plan();
    REQUIRE(points.evaluate(serial).verdict.acceptable());
    found.push_back(points.stresses());
  }
  CHECK(found[0][0] != found[0][1]);
  CHECK(found[0] == found[1]);
}

TEST_CASE("after a response that was interrupted the tangent is that of the committed packing") {
  scarp::SerialExecutor serial;
  scarp::MaterialPoints<2> points(OnDevice{rve(), std::make_shared<Processor>()}, sites(1));
  points.gradient(0) = increment(1e-4);
  std::function<void()> const stop = [] { throw std::runtime_error("stopped"); };
  {
    scarp::InterruptionCheck const check(&stop);
    CHECK_THROWS_WITH(static_cast<void>(points.respond(serial)), "stopped");
  }
  CHECK(points.tangent(0) == points.committed_tangent(0));
}
