// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/state_bits.hpp"

#include <doctest/doctest.h>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/shape/disc.hpp"
#include "support/refusals.hpp"

namespace {

struct Inner {
  double value = 0.0;

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("value", self.value);
  }
  static std::shared_ptr<Inner const> restored(scarp::StateReader& reader) {
    auto inner = std::make_shared<Inner>();
    members(*inner, reader);
    return inner;
  }
};

/// Shares parts that are shared with others.
struct Outer {
  std::shared_ptr<Inner const> first, second;

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("first", self.first);
    visit("second", self.second);
  }
  static std::shared_ptr<Outer const> restored(scarp::StateReader& reader) {
    auto outer = std::make_shared<Outer>();
    members(*outer, reader);
    return outer;
  }
};

struct Large {
  std::array<double, 1000> numbers{};
  SCARP_MEMBERS(numbers)
};

struct State {
  std::shared_ptr<Inner const> none;
  std::shared_ptr<Outer const> outer;
  std::shared_ptr<Inner const> inner, other;

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("none", self.none);
    visit("outer", self.outer);
    visit("inner", self.inner);
    visit("other", self.other);
  }
};

}  // namespace

TEST_CASE("parts shared within shared parts are saved once and loaded as they were shared") {
  auto const a = std::make_shared<Inner const>(Inner{1.5});
  auto const b = std::make_shared<Inner const>(Inner{-2.5});
  State const saved{nullptr, std::make_shared<Outer const>(Outer{a, b}), b, a};
  scarp::StateWriter writer;
  writer("state", saved);
  State loaded{a, nullptr, nullptr, nullptr};
  scarp::StateReader reader(writer.bits());
  reader("state", loaded);
  CHECK(reader.at_end());
  CHECK(loaded.none == nullptr);
  REQUIRE(loaded.outer != nullptr);
  CHECK(loaded.outer->first->value == 1.5);
  CHECK(loaded.outer->second->value == -2.5);
  CHECK(loaded.inner == loaded.outer->second);
  CHECK(loaded.other == loaded.outer->first);
}

TEST_CASE("a truth value that is neither is refused") {
  scarp::StateWriter writer;
  writer("flag", true);
  bool flag = false;
  scarp::StateReader(writer.bits())("flag", flag);
  CHECK(flag);
  writer.bits().back() = 2;
  CHECK_REFUSED(scarp::StateReader(writer.bits())("flag", flag), "'flag' is 2", "0 or 1");
}

TEST_CASE("a false length of a list is refused before anything of that size is made") {
  scarp::StateWriter writer;
  writer("list", std::vector<Large>(1));
  constexpr std::size_t length_at = 1 + 4 + 4;  // behind the name and the bytes of an element
  std::uint64_t const many = 8000;              // as many as bytes follow
  std::memcpy(writer.bits().data() + length_at, &many, sizeof(many));
  std::vector<Large> list;
  CHECK_REFUSED(scarp::StateReader(writer.bits())("list", list), "ends inside");
  CHECK(list.capacity() < 8);
}

TEST_CASE("a packing within a state is refused where its numbers lead outside its arrays") {
  using Discs = scarp::Packing<scarp::Disc, scarp::LinearFrictional>;
  Discs packing;
  packing.population = std::make_shared<scarp::Population<scarp::Disc> const>(
      std::vector<std::array<double, 1>>{{1.0}, {1.0}}, 1.0, 1.0);
  packing.position.resize(2);
  packing.rest();
  packing.pairs.first = {0};
  packing.pairs.second = {1};
  packing.pairs.shear.resize(1);
  auto const reload = [&] {
    scarp::StateWriter writer;
    writer("packing", packing);
    Discs loaded;
    scarp::StateReader(writer.bits())("packing", loaded);
  };
  CHECK_NOTHROW(reload());
  packing.pairs.second = {2};
  CHECK_THROWS_WITH_AS(reload(), doctest::Contains("pairs name grains that are not there"), scarp::InputError);
  packing.pairs.second = {1};
  packing.velocity.resize(1);
  CHECK_THROWS_WITH_AS(reload(), doctest::Contains("arrays of grains differ in length"), scarp::InputError);
}
