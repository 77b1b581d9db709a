// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/loading.hpp"

#include <doctest/doctest.h>

#include <type_traits>

TEST_CASE("a stress that is held without a target is held at zero") {
  scarp::StressControl<2> const side{.direction = scarp::Tensor<2>::Identity()};
  CHECK(side.missing(scarp::Tensor<2>::Zero()) == 0.0);
  CHECK(side.missing(scarp::Tensor<2>::Identity()) == -1.0);
}

TEST_CASE("grains carry a deviator of either sign, also where the direction's trace is round-off") {
  scarp::StressControl<2> control{.target = 2e4};
  control.direction.diagonal() << 0.1 + 0.2, -0.3;  // a trace of 5.6e-17
  CHECK(control.reachable(false));
  control.direction(1, 1) = -0.2;  // a pressure across is enough
  CHECK(control.reachable(false));
  control.direction(1, 1) = 0.0;
  CHECK_FALSE(control.reachable(false));
  CHECK(control.reachable(true));
}

TEST_CASE_TEMPLATE("whether grains carry a mean stress does not depend on the sign of its direction", Dim,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  auto const identity = scarp::Tensor<Dim::value>::Identity();
  for (double const sign : {1.0, -1.0}) {
    scarp::StressControl<Dim::value> const pressure{sign * identity, -sign * 1e5}, tension{sign * identity, sign * 1e5};
    CHECK(pressure.reachable(false));
    CHECK_FALSE(tension.reachable(false));
    CHECK_FALSE(scarp::StressControl<Dim::value>{sign * identity, 0.0}.reachable(false));
  }
}
