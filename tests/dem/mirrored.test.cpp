// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/mirrored.hpp"

#include <doctest/doctest.h>

#include "dem/sample_packings.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/homogenise/balance.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using scarp::Tensor;
using RollingLaw = scarp::RollingResistance<scarp::LinearFrictional>;
using RollingDiscs = scarp::Packing<scarp::Disc, RollingLaw>;

template <class PackingType>
typename PackingType::Law law() {
  if constexpr (std::is_same_v<PackingType, RollingDiscs>) {
    return {samples::study_law(), 0.05, 0.2};
  } else {
    return samples::study_law();
  }
}

template <class PackingType>
PackingType prepared() {
  auto made = scarp::IsotropicPreparation{.pressure = samples::pressure}.prepare(
      samples::loose_cloud<PackingType>(60, 3), law<PackingType>());
  REQUIRE(made.verdict.acceptable());
  return made.packing;
}

Tensor<2> strain() {
  Tensor<2> step;
  step << 1e-5, 2e-5, -0.5e-5, -2e-5;
  return step;
}

template <class PackingType>
void shear(PackingType& packing, Tensor<2> const& step, int steps) {
  scarp::TimeStepper<PackingType> stepper;
  for (int k = 0; k < steps; ++k) REQUIRE(stepper.step(packing, law<PackingType>(), step).acceptable());
}

}  // namespace

TEST_CASE_TEMPLATE("the mirror image of a packing answers the mirrored strain with the mirrored stress", PackingType,
                   Discs, Ellipses, RollingDiscs) {
  auto packing = prepared<PackingType>();
  shear(packing, strain(), 300);
  auto image = scarp::mirrored(packing);
  CHECK(scarp::mirrored(image) == packing);
  CHECK(image.volume() == packing.volume());
  Tensor<2> mirror = Tensor<2>::Identity();
  mirror(0, 0) = -1.0;
  auto const apart = [&] {
    Tensor<2> const stress = scarp::balance(packing, law<PackingType>()).stress;
    REQUIRE(std::abs(stress(0, 1)) > 0.01 * stress.norm());  // otherwise there is nothing to mirror
    return (scarp::balance(image, law<PackingType>()).stress - mirror * stress * mirror).norm() / stress.norm();
  };
  CHECK(apart() < 1e-13);  // nothing but the order of sums is another
  auto const go_on = [&](int steps) {
    shear(packing, strain(), steps);
    shear(image, mirror * strain() * mirror, steps);
  };
  go_on(40);
  CHECK(apart() < 1e-12);
  // A grain without contacts stands still, and Cundall's damping takes its +0 for forwards in both: 1e-5 once it is met.
  go_on(160);
  CHECK(apart() < 1e-3);
}
