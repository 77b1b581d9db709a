// SPDX-License-Identifier: BSL-1.0
#include "scarp/rve/perturbation_tangent.hpp"

#include <doctest/doctest.h>

#include "../../benchmarks/shared/condensed_tangent.hpp"
#include "homogenise/tangent_samples.hpp"
#include "homogenise/yade_packing.hpp"
#include "scarp/dem/fire.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "support/approx.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using samples::SmoothDiscs;
using scarp::PerturbationTangent;
using scarp::VoigtTangent;

constexpr double radius = 5e-3;
constexpr double spacing = 2.0 * radius * (1.0 - 1e-3);

int complaints = 0;
void count_complaint(std::string_view, scarp::Verdict) { ++complaints; }

}  // namespace

TEST_CASE_TEMPLATE("a lattice moved by trial has its closed-form moduli", PackingType, Discs, SmoothDiscs) {
  typename PackingType::Law law{.normal_stiffness = 6e6};
  double kt = 0.0;
  if constexpr (scarp::Frictional<typename PackingType::Law>) {
    law.tangential_stiffness = kt = 2.4e6;
    law.friction = 0.5;
  }
  auto const packing = samples::listed(samples::triangular_lattice<PackingType>(4, radius, spacing), law);
  auto const answer = PerturbationTangent{}.differentiate(packing, law);
  REQUIRE(answer.verdict.acceptable());
  double const kn = law.normal_stiffness;
  VoigtTangent<2> expected;  // analytic: see lattice.test.cpp
  expected << 3 * kn + kt, kn - kt, 0, kn - kt, 3 * kn + kt, 0, 0, 0, kn + kt;
  expected *= std::sqrt(3.0) / 4.0 / samples::thickness;
  // Pressure over modulus, 2 x 1e-3: terms of the present stress belong to the trial and not to the springs.
  CHECK((answer.tangent - expected).norm() < 4e-3 * expected.norm());
}

TEST_CASE("Yade's packing moved by trial has Yade's finite-difference moduli") {
  auto const law = samples::study_law();
  auto const packing = samples::listed(samples::yade_packing(), law);
  VoigtTangent<2> const tangent = PerturbationTangent{}(packing, law);
  // Another code: Yade 2023.02a, tests/reference/README.md. 2 %: it scatters by 0.5 % between strains of 1e-6 and
  // 1e-4, and C_xxyy is the small difference of large contributions.
  CHECK(tangent(0, 0) == samples::Approx(3.04e7).epsilon(0.02));
  CHECK(tangent(1, 1) == samples::Approx(3.04e7).epsilon(0.02));
  CHECK(tangent(0, 1) == samples::Approx(2.67e6).epsilon(0.02));
  CHECK(tangent(1, 0) == samples::Approx(2.67e6).epsilon(0.02));
  CHECK(tangent(2, 2) == samples::Approx(1.396e7).epsilon(0.02));
}

TEST_CASE("ellipses at rest under isotropic pressure answer to a trial as their own stiffness says") {
  auto const law = samples::study_law();
  auto const& prepared = samples::consolidated<Ellipses>(80);
  REQUIRE(prepared.verdict.acceptable());
  VoigtTangent<2> const trial = PerturbationTangent{}(prepared.packing, law);
  VoigtTangent<2> const condensed = benchmarks::CondensedTangent{}(prepared.packing, law);
  // Two methods: they differ by forces that turn with their contacts and by contacts left sliding.
  CHECK((condensed - trial).norm() < 0.05 * trial.norm());
}

TEST_CASE("a trial to one side only sees that side") {
  auto const law = samples::study_law();
  auto const& packing = samples::settled_after_shear<Discs>();
  PerturbationTangent<> const wide{.strain = 1e-4,
                                   .strain_steps = 100};  // settling drew contacts back from their limit
  scarp::EngineeringStrain<2> const onward(1.0, -1.0, 0.0);
  VoigtTangent<2> const loading = wide.differentiate(packing, law, onward).tangent;
  VoigtTangent<2> const unloading = wide.differentiate(packing, law, -onward).tangent;
  // Sliding contacts go on sliding in one direction and hold in the other: onward the packing is softer, by more
  // than a hundred times the 1e-4 to which a trial is settled.
  CHECK(onward.dot(loading * onward) < 0.98 * onward.dot(unloading * onward));
  // No side was given for this mode: the same central difference.
  CHECK(loading.col(2).isApprox(unloading.col(2), 1e-9));
}

TEST_CASE_TEMPLATE("trials that relax take fewer steps to the tangent of trials with local damping", PackingType, Discs,
                   Ellipses) {
  auto const& packing = samples::consolidated<PackingType>(80).packing;
  auto const either = scarp::EngineeringStrain<2>::Zero();
  long damped_steps = 0;
  long relaxed_steps = 0;
  auto const damped = PerturbationTangent{}.differentiate(packing, samples::study_law(), either, &damped_steps);
  PerturbationTangent<scarp::Fire> const relaxing;
  auto const relaxed = relaxing.differentiate(packing, samples::study_law(), either, &relaxed_steps);
  MESSAGE(relaxed_steps << " steps, with local damping " << damped_steps);
  REQUIRE(relaxed.verdict.acceptable());
  CHECK(relaxed_steps < damped_steps / 2);
  CHECK((relaxed.tangent - damped.tangent).norm() < 5e-3 * damped.tangent.norm());
}

TEST_CASE("a packing that does not settle within the most steps is complained of") {
  auto const law = samples::study_law();
  complaints = 0;
  PerturbationTangent<> const hasty{.max_steps = 10, .on_fallback = count_complaint};
  VoigtTangent<2> const tangent = hasty(samples::settled_after_shear<Discs>(), law);
  CHECK(complaints == 1);
  CHECK(tangent.allFinite());
  CHECK(hasty.differentiate(samples::settled_after_shear<Discs>(), law).verdict ==
        scarp::Verdict{scarp::Status::not_converged, scarp::Reason::unbalanced});
}

TEST_CASE_TEMPLATE("a trial turns with the packing and leaves it alone", PackingType, Discs, Ellipses) {
  auto const& packing = samples::settled_after_shear<PackingType>();
  // Unbalanced tolerance x stress over stiffness x strain is 1e-3, with a margin.
  samples::check_quarter_turn(PerturbationTangent{}, packing, samples::study_law(), 5e-3);
  samples::check_purity(PerturbationTangent{}, packing, samples::study_law());
}
