// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/block/block_program.hpp"

#include <cstddef>
#include <limits>

#include "block_samples.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"

namespace {

using blocks::check;
using blocks::check_renewal;
using blocks::pressed;
using blocks::Sample;
using scarp::Tensor;

using Single = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional, float>;
using Rolling = scarp::RollingResistance<scarp::LinearFrictional>;
scarp::HertzMindlin<> const elastic{.reduced_modulus = 4e9, .reduced_shear_modulus = 1e9, .friction = 0.5};

template <class PackingType>
scarp::Trouble trouble_of(Sample<PackingType> const& sample, Tensor<2> const& strain) {
  blocks::Bytes committed = sample.state(sample.packing);
  blocks::Bytes trial = sample.respond(committed, strain, 50, 2);
  return sample.header(trial).trouble;
}

}  // namespace

TEST_CASE("a block of ellipses takes the steps of the vector kernel") {
  check<samples::Ellipses>(samples::study_law());
}

TEST_CASE("a block whose list changes takes the steps of the vector kernel") {
  check<samples::Ellipses>(samples::study_law(), 2e-4);
}

TEST_CASE("a block of discs without friction takes the steps of the vector kernel") {
  check<samples::SmoothDiscs>(scarp::Frictionless{.normal_stiffness = 6e6});
}

TEST_CASE("a block with rolling resistance takes the steps of the vector kernel") {
  check<scarp::Packing<scarp::Ellipse, Rolling>>(Rolling{samples::study_law(), 100.0, 0.1});
}

TEST_CASE("a block of spheres takes the steps of the vector kernel") {
  check<scarp::Packing<scarp::Sphere, scarp::HertzMindlin<>>>(elastic);
}

TEST_CASE("a block in single precision takes the steps of the vector kernel") {
  check<Single>(samples::study_law(), 1e-5, 400);
}

TEST_CASE("a block in single precision takes few steps of the vector kernel to round-off") {
  check<Single>(samples::study_law(), 1e-5, 100, 10);
}

TEST_CASE("a list that is made anew has the pairs, memory and critical step of the vector kernel") {
  // Sheared by more than half, a cell is reduced and pairs get other names.
  SUBCASE("sheared discs") {
    check_renewal(Sample(pressed<samples::Discs>(samples::study_law()), samples::study_law()), 1e-12, 0.7);
  }
  SUBCASE("ellipses") {
    check_renewal(Sample(pressed<samples::Ellipses>(samples::study_law()), samples::study_law()), 1e-12);
  }
  SUBCASE("ellipses with dashpots whose stiffness grows with the overlap") {
    using Law = scarp::HertzMindlin<scarp::HertzRestitution>;
    Law const law{.reduced_modulus = 4e9, .reduced_shear_modulus = 1e9, .friction = 0.5, .damping = {0.6}};
    check_renewal(Sample(pressed<scarp::Packing<scarp::Ellipse, Law>>(law), law), 1e-12);
  }
  SUBCASE("sheared spheres") {
    // Both tangents are alike, where the cosine formula of a largest principal value has half of the digits.
    check_renewal(Sample(pressed<scarp::Packing<scarp::Sphere, scarp::HertzMindlin<>>>(elastic), elastic), 1e-7, 0.7);
  }
}

TEST_CASE("a block ends with its trouble") {
  auto const law = samples::study_law();
  Sample<samples::Ellipses> sample(blocks::pressed<samples::Ellipses>(law), law);
  SUBCASE("velocities that are no numbers") {
    sample.packing.velocity(3, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK(trouble_of(sample, blocks::shear_step<2>(1e-5)) == scarp::Trouble::not_finite);
  }
  SUBCASE("velocities that are no numbers, of a grain without contacts") {
    sample.packing.velocity(0, 1) = std::numeric_limits<double>::quiet_NaN();
    sample.packing.pairs = {};
    sample.packing.pairs.skin = 1e-3;
    sample.packing.pairs.critical_step = 1e-6;
    CHECK(trouble_of(sample, Tensor<2>::Zero()) == scarp::Trouble::not_finite);
  }
  SUBCASE("a grain more than a million cells away, and one that is nowhere, when the list is made anew") {
    sample.packing.pairs.drift = std::numeric_limits<double>::infinity();
    sample.packing.position(3, 0) = 1e9;
    CHECK(trouble_of(sample, Tensor<2>::Zero()) == scarp::Trouble::lost_grain);
    sample.packing.position(3, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK(trouble_of(sample, Tensor<2>::Zero()) == scarp::Trouble::not_finite);
  }
  SUBCASE("a touch that needs a slow search") {
    sample.size.pairs *= 8;
    Tensor<2> strain = Tensor<2>::Zero();
    strain(0, 0) = -0.6;
    CHECK(trouble_of(sample, strain) == scarp::Trouble::unconverged_touch);
  }
  SUBCASE("a list that is too long") {
    sample.size.pairs = static_cast<int>(sample.packing.pairs.count());
    Tensor<2> strain = Tensor<2>::Zero();
    strain(0, 0) = strain(1, 1) = -1e-3;
    CHECK(trouble_of(sample, strain) == scarp::Trouble::list_full);
  }
}

TEST_CASE("a block ends when its cell becomes too narrow") {
  scarp::Frictionless const law{.normal_stiffness = 6e6};
  Sample<samples::SmoothDiscs> sample(blocks::pressed<samples::SmoothDiscs>(law), law);
  sample.size.pairs *= 8;
  Tensor<2> strain = Tensor<2>::Zero();
  strain(0, 0) = -0.6;
  CHECK(trouble_of(sample, strain) == scarp::Trouble::cell_collapsed);
}
