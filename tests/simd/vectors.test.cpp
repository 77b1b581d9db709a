// SPDX-License-Identifier: BSL-1.0
#include "scarp/simd/vectors.hpp"

#include <doctest/doctest.h>

#include <array>

namespace {

using Plane = std::array<double, 2>;
using Space = std::array<double, 3>;

constexpr Space a{2.0, 3.0, 5.0};
constexpr Space b{7.0, -11.0, 13.0};

}  // namespace

TEST_CASE("products of vectors in the plane and in space") {
  CHECK(scarp::dot(3.0, 5.0) == 15.0);
  CHECK(scarp::dot(Plane{2.0, 3.0}, Plane{7.0, -11.0}) == -19.0);
  CHECK(scarp::dot(a, b) == 46.0);
  CHECK(scarp::cross(Plane{2.0, 3.0}, Plane{7.0, -11.0}) == -43.0);
  CHECK(scarp::cross(a, b) == Space{94.0, 9.0, -43.0});
}

TEST_CASE("multiples, sums and differences of numbers and vectors") {
  CHECK(scarp::scaled(3.0, 5.0) == 15.0);
  CHECK(scarp::scaled(a, 5.0) == Space{10.0, 15.0, 25.0});
  CHECK(scarp::sum(3.0, 5.0) == 8.0);
  CHECK(scarp::sum(a, b) == Space{9.0, -8.0, 18.0});
  CHECK(scarp::difference(3.0, 5.0) == -2.0);
  CHECK(scarp::difference(a, b) == Space{-5.0, 14.0, -8.0});
}
