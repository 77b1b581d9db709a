// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/loading.hpp"

#include <doctest/doctest.h>

TEST_CASE("a stress that is held without a target is held at zero") {
  scarp::StressControl<2> const side{.direction = scarp::Tensor<2>::Identity()};
  CHECK(side.missing(scarp::Tensor<2>::Zero()) == 0.0);
  CHECK(side.missing(scarp::Tensor<2>::Identity()) == -1.0);
}
