// SPDX-License-Identifier: BSL-1.0
#include "scarp/core/described.hpp"

#include <doctest/doctest.h>

#include <string>

namespace {

struct NeverStops {};

class Half : public NeverStops {
 public:
  explicit Half(int const& scene) : scene_(scene) {}
  SCARP_MEMBERS_EXCEPT((scene_, buffer_), kept_, number)

  int number = 2;

 private:
  int const& scene_;
  double kept_ = 1.5;
  double buffer_ = 0.0;
};

struct Nothing {
  int follows_from_the_scene = 1;
  SCARP_MEMBERS_EXCEPT((follows_from_the_scene))
};

/// As many as a list may have.
struct Long {
  int a = 1, b = 2, c = 3, d = 4, e = 5, f = 6, g = 7, h = 8, i = 9, j = 10, k = 11, l = 12;
  int m = 13, n = 14, o = 15, p = 16, q = 17, r = 18, s = 19, t = 20, u = 21, v = 22, w = 23, x = 24;
  SCARP_MEMBERS(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
};

static_assert(scarp::Described<Half> && scarp::Described<Nothing> && scarp::Described<Long>);
static_assert(!scarp::Described<NeverStops>);

}  // namespace

TEST_CASE("members are visited in the order of their list, under their names without the underscore of private ones") {
  int const scene = 1;
  Half half(scene);
  std::string seen;
  auto const see = [&](std::string_view name, auto const& value) {
    seen += std::string(name) + " " + std::to_string(static_cast<int>(10.0 * static_cast<double>(value))) + "; ";
  };
  Half::members(half, see);
  Nothing const nothing;
  Nothing::members(nothing, see);
  CHECK(seen == "kept 15; number 20; ");
  Half::members(half, [](std::string_view, auto& value) { value += 1; });
  CHECK(half.number == 3);
}

TEST_CASE("a list has up to two dozen members") {
  int sum = 0;
  Long const many;
  Long::members(many, [&](std::string_view, int value) { sum += value; });
  CHECK(sum == 300);
}
