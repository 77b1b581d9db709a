// SPDX-License-Identifier: BSL-1.0
#include "../../examples/shared/sliding_contacts.hpp"

#include <doctest/doctest.h>

#include "homogenise/tangent_samples.hpp"
#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/homogenise/contact_tangent.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using samples::SmoothDiscs;
using samples::UniformStrain;
using scarp::Tensor;
using scarp::VoigtTangent;

template <class PackingType>
VoigtTangent<2> affine(PackingType const& packing, typename PackingType::Law const& law) {
  return scarp::to_voigt_tangent<2>(scarp::contact_tangent(packing, law));
}

}  // namespace

TEST_CASE_TEMPLATE("where nothing slides the tangent is eq. 6", PackingType, Discs, Ellipses) {
  auto const law = samples::study_law();
  auto packing = samples::sheared<PackingType>();
  for (std::size_t p = 0; p < packing.pairs.count(); ++p) packing.pairs.shear(p, 0) = 0.0;
  // Analytic: the same sum in the same order, round-off only.
  CHECK((UniformStrain{}(packing, law) - affine(packing, law)).norm() < 1e-12 * affine(packing, law).norm());
}

TEST_CASE_TEMPLATE("the share of sliding contacts goes linearly from none of their shear stiffness to eq. 6",
                   PackingType, Discs, Ellipses) {
  auto const law = samples::study_law();
  auto const& packing = samples::sheared<PackingType>();
  VoigtTangent<2> const all = UniformStrain{.sliding = {.shear_share = 1.0}}(packing, law);
  VoigtTangent<2> const half = UniformStrain{.sliding = {.shear_share = 0.5}}(packing, law);
  VoigtTangent<2> const none = UniformStrain{}(packing, law);
  CHECK((all - affine(packing, law)).norm() < 1e-12 * all.norm());   // analytic, round-off
  CHECK((half - (all + none) / 2.0).norm() < 1e-12 * all.norm());    // analytic, round-off
  CHECK((all - none).norm() > 1e-3 * all.norm());                    // something slides, or the case says nothing
  CHECK(samples::min_eigenvalue(all - none) > -1e-12 * all.norm());  // a spring taken away never stiffens
  CHECK((none - none.transpose()).norm() < 1e-12 * none.norm());
}

TEST_CASE("one sliding contact along x has the closed-form tangent") {
  // Two discs of a cell wide enough that they meet once, shear force at and below the limit.
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 2e6, .friction = 0.5};
  double const radius = 5e-3, overlap = 1e-5, branch = 2.0 * radius - overlap;
  auto packing =
      samples::place<Discs>(0.1 * Tensor<2>::Identity(), {{radius}, {radius}}, {{0.05, 0.05}, {0.05 + branch, 0.05}});
  scarp::TimeStepper<Discs> stepper;
  REQUIRE(stepper.refresh(packing, law).acceptable());
  REQUIRE(packing.pairs.count() == 1);
  double const limit = law.friction * law.normal_stiffness * overlap;
  double const unit = branch * branch / packing.volume();
  for (double const sign : {1.0, -1.0}) {
    packing.pairs.shear(0, 0) = sign * limit;  // t = (0, 1)
    // Analytic: l = (l, 0), so D_xxxx = k_n l^2/V; with sides averaged D_xyxy = k_t l^2/4V and, coupled, D_xyxx =
    // sign mu k_n l^2/2V: a sliding contact pushed together is pushed sideways too. Overlap 1e-5 of 0.1 m: 1e-10.
    VoigtTangent<2> expected = VoigtTangent<2>::Zero();
    expected(0, 0) = law.normal_stiffness * unit;
    CHECK((UniformStrain{}(packing, law) - expected).norm() < 1e-9 * expected.norm());
    expected(2, 0) = sign * law.friction * law.normal_stiffness * unit / 2.0;
    UniformStrain const coupled{.sliding = {.coupled = true}};
    CHECK((coupled(packing, law) - expected).norm() < 1e-9 * expected.norm());
    packing.pairs.shear(0, 0) = sign * 0.9 * limit;
    expected(2, 0) = 0.0;
    expected(2, 2) = law.tangential_stiffness * unit / 4.0;
    CHECK((coupled(packing, law) - expected).norm() < 1e-9 * expected.norm());
  }
}

TEST_CASE("a contact without friction gives no shear stiffness although its law has a tangential spring") {
  scarp::LinearFrictional const slippery{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.0};
  scarp::Frictionless const smooth{.normal_stiffness = 6e6};
  auto const packing = samples::listed(samples::triangular_lattice<Discs>(4, 5e-3, 9.999e-3), slippery);
  auto const bare = samples::listed(samples::triangular_lattice<SmoothDiscs>(4, 5e-3, 9.999e-3), smooth);
  VoigtTangent<2> const expected = affine(bare, smooth);
  for (bool const coupled : {false, true}) {
    UniformStrain const tangent{.sliding = {.coupled = coupled}};
    CHECK((tangent(packing, slippery) - expected).norm() < 1e-12 * expected.norm());  // round-off
    CHECK((tangent(bare, smooth) - expected).norm() < 1e-12 * expected.norm());
  }
}

TEST_CASE("a bond that holds does not slide, however large its shear force") {
  using Bonded = scarp::CohesiveBond<scarp::LinearFrictional>;
  Bonded const law{.law = samples::study_law(), .tensile_strength = 1e9, .shear_strength = 1e9};
  scarp::Contact<2> contact{};
  contact.touch = {1e-5, {1.0, 0.0}, {5e-3, 0.0}, {-5e-3, 0.0}};
  contact.approach = {.overlap = 1e-5, .slip_increment = 0.0};
  contact.stiffness = {.normal = 6e6, .tangential = 6e6};
  contact.normal_force = 60.0;
  contact.force = {60.0, 600.0};
  contact.memory.shear = 600.0;
  Bonded::bond(contact.memory);
  CHECK(!examples::slides(contact, law));
  contact.memory.scalars = {};
  contact.memory.shear = 33.0;
  contact.force = {60.0, 33.0};  // at Coulomb's limit 0.55 x 60 N
  CHECK(examples::slides(contact, law));
}

TEST_CASE("in space a sliding contact stays stiff across its direction of sliding") {
  scarp::LinearFrictional const law = samples::study_law();
  scarp::Contact<3> contact{};
  contact.touch = {1e-5, {1.0, 0.0, 0.0}, {5e-3, 0.0, 0.0}, {-5e-3, 0.0, 0.0}};
  contact.approach = {.overlap = 1e-5, .slip_increment = {}};
  contact.stiffness = law.stiffness(0.0, 0.0);
  contact.normal_force = 60.0;
  contact.memory.shear = {0.0, 0.0, -33.0};  // at Coulomb's limit
  contact.force = {60.0, 0.0, -33.0};
  Tensor<3> expected = Tensor<3>::Zero();  // analytic: k_n n n + k_t y y + mu k_n s n with s = -z
  expected.diagonal() << 6e6, 6e6, 0.0;
  expected(2, 0) = -0.55 * 6e6;
  CHECK((benchmarks::SlidingSprings{.coupled = true}.spring(contact, law) - expected).norm() < 1e-12 * 6e6);
}

TEST_CASE_TEMPLATE("the tangent of sliding contacts turns with the packing and leaves it alone", PackingType, Discs,
                   Ellipses) {
  auto const& packing = samples::sheared<PackingType>();
  samples::check_quarter_turn(UniformStrain{.sliding = {.coupled = true}}, packing, samples::study_law(), 1e-10);
  samples::check_purity(UniformStrain{.sliding = {.coupled = true}}, packing, samples::study_law());
}
