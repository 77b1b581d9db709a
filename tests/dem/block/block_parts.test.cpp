// SPDX-License-Identifier: BSL-1.0
// Each shape and law that a block program may meet takes the steps of the vector kernel.
#include "block_samples.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/law_per_species.hpp"
#include "scarp/dem/bonded_packing.hpp"
#include "scarp/shape/clump.hpp"
#include "scarp/shape/convex_shape.hpp"
#include "scarp/shape/superellipse.hpp"
#include "scarp/shape/with_species.hpp"

namespace {

using blocks::check_renewal;
using blocks::check_steps;
using blocks::pressed;
using blocks::Sample;

/// As the tutorial's.
struct Oval : scarp::ConvexShape<Oval, 2> {
  template <class T>
  static constexpr T support(std::array<T, 2> const& size, T const& cosine, T const& sine) {
    return size[0] * (1.0 + size[1] * (cosine * cosine - sine * sine));
  }
};

struct OvalGrading {
  using Shape = Oval;
  scarp::SizeOf<Oval> sample(scarp::Random& random) const { return {random.uniform(4e-3, 6e-3), 0.15}; }
};

using TwoSpecies = scarp::WithSpecies<scarp::Ellipse, 2>;

struct SpeciesGrading {
  using Shape = TwoSpecies;
  scarp::SizeOf<TwoSpecies> sample(scarp::Random& random) const {
    double const major = random.uniform(4e-3, 6e-3);
    return {major, 0.75 * major, random.uniform(0.0, 1.0) < 0.5 ? 1.0 : 2.0};
  }
};

}  // namespace

TEST_CASE("a block of superellipses takes the steps of the vector kernel") {
  using Grains = scarp::Packing<scarp::Superellipse, scarp::LinearFrictional>;
  auto const law = samples::study_law();
  scarp::SuperellipseGrading const grading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75, .exponent = 0.8};
  Sample<Grains> const sample(pressed<Grains>(grading, law, 60), law);
  SUBCASE("without a new list") { check_steps(sample, 1e-5, 100); }
  SUBCASE("with one") { check_renewal(sample, 1e-12); }
}

TEST_CASE("corners that meet: the list of a block of superellipses is that of the vector kernel") {
  using Grains = scarp::Packing<scarp::Superellipse, scarp::LinearFrictional>;
  auto const law = samples::study_law();
  for (double const exponent : {0.4, 1.4}) {
    scarp::SuperellipseGrading const grading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.6, .exponent = exponent};
    check_renewal(Sample<Grains>(pressed<Grains>(grading, law, 100), law), 1e-12);
  }
}

TEST_CASE("a block of dumbbells takes the steps of the vector kernel") {
  using Grains = scarp::Packing<scarp::Dumbbell, scarp::LinearFrictional>;
  auto const law = samples::study_law();
  scarp::RadiusGrading<scarp::Dumbbell> const grading{.smallest = 4e-3, .largest = 6e-3};
  check_steps(Sample<Grains>(pressed<Grains>(grading, law, 60), law), 1e-5, 100);
}

TEST_CASE("a block of an own convex shape takes the steps of the vector kernel") {
  using Grains = scarp::Packing<Oval, scarp::LinearFrictional>;
  auto const law = samples::study_law();
  Sample<Grains> const sample(pressed<Grains>(OvalGrading{}, law, 60), law);
  SUBCASE("without a new list") { check_steps(sample, 1e-5, 100); }
  SUBCASE("with one") { check_renewal(sample, 1e-12); }
}

TEST_CASE("a block of two species takes the steps of the vector kernel") {
  using Grains = scarp::Packing<TwoSpecies, scarp::LawPerSpecies<scarp::LinearFrictional, 2>>;
  Grains::Law law;
  law.between(1, 1) = samples::study_law();
  law.between(1, 2) = {.normal_stiffness = 2e6, .tangential_stiffness = 1e6, .friction = 0.4};
  law.between(2, 2) = {.normal_stiffness = 1e6, .tangential_stiffness = 1e6, .friction = 0.7};
  check_steps(Sample<Grains>(pressed<Grains>(SpeciesGrading{}, law, 80), law), 1e-5, 100);
}

TEST_CASE("a block of bonded grains takes the steps of the vector kernel") {
  using Bond = scarp::CohesiveBond<scarp::LinearFrictional>;
  double const strength = samples::pressure * 1e-2 * samples::thickness;
  Bond const law{.law = samples::study_law(), .tensile_strength = strength, .shear_strength = strength};
  auto const bonded = scarp::bonded(samples::consolidated<samples::Ellipses>(80).packing, samples::study_law(), law);
  REQUIRE(bonded.verdict.acceptable());
  check_steps(Sample<scarp::Packing<scarp::Ellipse, Bond>>(bonded.packing, law), 1e-5, 100);
}

TEST_CASE("a block with dashpots takes the steps of the vector kernel") {
  using Law = scarp::HertzMindlin<scarp::HertzRestitution>;
  using Grains = scarp::Packing<scarp::Ellipse, Law>;
  Law const law{
      .reduced_modulus = 4e9, .reduced_shear_modulus = 1e9, .friction = 0.5, .damping = scarp::HertzRestitution{0.6}};
  check_steps(Sample<Grains>(pressed<Grains>(law, 80), law), 1e-5, 100);
}
