// SPDX-License-Identifier: BSL-1.0
#include "scarp/io/state_bits.hpp"

#include <doctest/doctest.h>

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
