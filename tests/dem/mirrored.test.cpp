// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/mirrored.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/shape/convex_shape.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using scarp::Tensor;
using RollingLaw = scarp::RollingResistance<scarp::LinearFrictional>;
using RollingDiscs = scarp::Packing<scarp::Disc, RollingLaw>;

/// A rounded triangle: half a turn makes another of it.
struct Triangle : scarp::ConvexShape<Triangle, 1> {
  template <class T>
  static constexpr T support(std::array<T, 1> const& size, T const& cosine, T const& sine) {
    return size[0] * (1.0 + 0.08 * cosine * (cosine * cosine - 3.0 * sine * sine));
  }
};

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
  // A grain without contacts stands still, and Cundall's damping takes its +0 for forwards in both: 1e-5 once it is
  // met.
  go_on(160);
  CHECK(apart() < 1e-3);
}

TEST_CASE_TEMPLATE("a packing is mirrored across any plane", PackingType, Discs, Ellipses, RollingDiscs) {
  auto packing = prepared<PackingType>();
  shear(packing, strain(), 300);
  scarp::Vector<2> const normal(std::cos(0.7), std::sin(0.7));
  Tensor<2> const mirror = scarp::reflection<2>(normal);
  auto image = scarp::mirrored(packing, normal);
  CHECK(std::abs(image.volume() - packing.volume()) < 1e-14 * packing.volume());
  auto const apart = [&](auto const& first, auto const& second, Tensor<2> const& turn) {
    Tensor<2> const stress = scarp::balance(first, law<PackingType>()).stress;
    return (scarp::balance(second, law<PackingType>()).stress - turn * stress * turn).norm() / stress.norm();
  };
  CHECK(apart(packing, image, mirror) < 1e-10);  // round-off of overlaps, which are small against places
  CHECK(apart(packing, scarp::mirrored(image, normal), Tensor<2>::Identity()) < 1e-10);
  shear(packing, strain(), 200);
  shear(image, mirror * strain() * mirror, 200);
  CHECK(apart(packing, image, mirror) < 0.02);  // local damping acts on components along fixed axes
}

TEST_CASE("grains without a point of symmetry are mirrored as they lie") {
  using Triangles = scarp::Packing<Triangle, scarp::LinearFrictional>;
  auto grains =
      samples::place<Triangles>(Tensor<2>{{0.2, 0.0}, {0.0, 0.2}}, {{5e-3}, {5e-3}}, {{0.1, 0.1}, {0.1098, 0.1}});
  grains.orientation(0, 0) = std::cos(0.3);  // a corner of one presses on a side of the other
  grains.orientation(0, 1) = std::sin(0.3);
  scarp::TimeStepper<Triangles> stepper;
  REQUIRE(stepper.refresh(grains, samples::study_law()).acceptable());
  Tensor<2> const stress = scarp::balance(grains, samples::study_law()).stress;
  REQUIRE(stress(0, 0) < 0.0);
  for (double const angle : {0.0, 0.7}) {
    scarp::Vector<2> const normal(std::cos(angle), std::sin(angle));
    Tensor<2> const mirror = scarp::reflection<2>(normal);
    Tensor<2> const image = scarp::balance(scarp::mirrored(grains, normal), samples::study_law()).stress;
    CHECK((image - mirror * stress * mirror).norm() < 1e-10 * stress.norm());
  }
}

TEST_CASE("spheres are mirrored across any axis, with their spins and contacts") {
  using Spheres = scarp::Packing<scarp::Sphere, scarp::RollingResistance<scarp::LinearFrictional>>;
  Spheres::Law const law{{.normal_stiffness = 1e6, .tangential_stiffness = 5e5, .friction = 0.5}, 0.05, 0.2};
  scarp::Cloud<scarp::SphereGrading> const cloud{
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 60, .density = 2650.0, .seed = 3};
  auto made = scarp::IsotropicPreparation{.pressure = samples::pressure}.prepare(cloud.make<Spheres>(), law);
  REQUIRE(made.verdict.acceptable());
  auto packing = made.packing;
  Tensor<3> step;
  step << 1e-5, 2e-5, -0.5e-5, -1e-5, 0.5e-5, 1e-5, 2e-5, -1.5e-5, -2e-5;
  scarp::TimeStepper<Spheres> stepper;
  for (int k = 0; k < 200; ++k) REQUIRE(stepper.step(packing, law, step).acceptable());
  for (int const axis : {0, 1, 2}) {
    scarp::Vector<3> const normal = scarp::Vector<3>::Unit(axis);
    auto image = scarp::mirrored(packing, normal);
    auto there = packing;
    CHECK(scarp::mirrored(image, normal) == packing);
    Tensor<3> mirror = Tensor<3>::Identity();
    mirror(axis, axis) = -1.0;
    auto const apart = [&] {
      Tensor<3> const stress = scarp::balance(there, law).stress;
      return (scarp::balance(image, law).stress - mirror * stress * mirror).norm() / stress.norm();
    };
    CHECK(apart() < 1e-13);  // nothing but the order of sums is another
    for (int k = 0; k < 40; ++k) {
      REQUIRE(stepper.step(there, law, step).acceptable());
      REQUIRE(stepper.step(image, law, (mirror * step * mirror).eval()).acceptable());
    }
    CHECK(apart() < 1e-4);  // 1e-7, or 1e-5 once a sphere without contacts is met, as above
  }
}

TEST_CASE("a normal of another length than one is rejected") {
  CHECK_REFUSED(scarp::mirrored(samples::triangular_lattice<Discs>(4, 5e-3, 1e-2), scarp::Vector<2>(1.0, 1.0)),
                "length of 1.41421");
}
