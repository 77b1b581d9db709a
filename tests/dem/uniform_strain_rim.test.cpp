// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/uniform_strain_rim.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "../../examples/shared/energy_ledger.hpp"
#include "scarp/dem/fire.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/rve/perturbation_tangent.hpp"
#include "scarp/shape/sphere.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"
#include "support/refusals.hpp"

namespace {

using samples::Discs;
using samples::Ellipses;
using scarp::LocalDamping;
using scarp::Periodic;
using scarp::Tensor;
using scarp::UniformStrainRim;
using scarp::Vector;

using Spheres = scarp::Packing<scarp::Sphere, scarp::LinearFrictional>;
template <class PackingType>
using RimStepper = scarp::TimeStepper<PackingType, LocalDamping, UniformStrainRim>;

static_assert(scarp::ConstrainsGrains<UniformStrainRim, Discs> && scarp::ConstrainsGrains<UniformStrainRim, Spheres>);
static_assert(!scarp::ConstrainsGrains<LocalDamping, Discs>);
static_assert(sizeof(scarp::TimeStepper<Discs>) + sizeof(UniformStrainRim) == sizeof(RimStepper<Discs>),
              "a periodic boundary takes no room");

constexpr UniformStrainRim everywhere{.width = 100.0};

Tensor<2> strain_step(double size) {
  Tensor<2> step;
  step << size, 0.3 * size, 0.2 * size, -2.0 * size;
  return step;
}

/// Grains that are glued together and hardly pressed: stiffness is that of the springs alone.
template <class PackingType>
struct Glued {
  scarp::LinearFrictional law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 1e6};
  PackingType packing;

  Glued() {
    auto sliding = law;
    sliding.friction = 0.5;
    auto made =
        scarp::IsotropicPreparation{.pressure = pressure}.prepare(samples::loose_cloud<PackingType>(100, 2), sliding);
    REQUIRE(made.verdict.acceptable());
    packing = made.packing;
  }

  template <class Boundary>
  scarp::VoigtTangent<2> tangent(Boundary const& boundary) const {
    scarp::PerturbationTangent<LocalDamping, Boundary> const trial{.strain = 1e-8, .boundary = boundary};
    auto const answer = trial.differentiate(packing, law);
    CHECK(answer.verdict.acceptable());
    return answer.tangent;
  }

  static constexpr double pressure = 1e3;  ///< [Pa], 3e-5 of the springs' modulus
};

/// Smallest eigenvalue of the symmetric part, over the largest entry of a scale.
double least(scarp::VoigtTangent<2> const& difference, scarp::VoigtTangent<2> const& scale) {
  scarp::VoigtTangent<2> const symmetric = (difference + difference.transpose()) / 2.0;
  Eigen::SelfAdjointEigenSolver<scarp::VoigtTangent<2>> const solver(symmetric);
  return solver.eigenvalues()(0) / scale.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE_TEMPLATE("a rim of all grains gives the stiffness of uniform strain, a narrower rim less, none the least",
                   PackingType, Discs, Ellipses) {
  Glued<PackingType> const glued;
  auto const uniform = scarp::to_voigt_tangent<2>(scarp::contact_tangent(glued.packing, glued.law));
  auto const all = glued.tangent(everywhere);
  // Analytic: Kruyt and Rothenburg (1998); terms of the order of the stress and overlap, 3e-5, and of the strain.
  CHECK((all - uniform).cwiseAbs().maxCoeff() < 3e-4 * uniform.cwiseAbs().maxCoeff());
  auto former = glued.tangent(Periodic{});
  auto const periodic = former;
  for (double const width : {0.5, 1.5}) {
    CAPTURE(width);
    auto const next = glued.tangent(UniformStrainRim{.width = width});
    MESSAGE("stiffness over that of periodic fluctuations: " << next(0, 0) / periodic(0, 0));
    CHECK(least(next - former, uniform) > -1e-4);  // what is held can only be stiffer, in every mode
    former = next;
  }
  CHECK(least(all - former, uniform) > -1e-4);
  CHECK(periodic(0, 0) < 0.9 * all(0, 0));
  // No rim holds nothing.
  CHECK(glued.tangent(UniformStrainRim{.width = 0.0}) == periodic);
}

TEST_CASE_TEMPLATE("grains of the rim follow the cell, the others are in balance", PackingType, Discs, Ellipses) {
  auto packing = samples::consolidated<PackingType>(200).packing;
  REQUIRE(scarp::TimeStepper<PackingType>{}.refresh(packing, samples::study_law()).acceptable());
  auto const before = packing;
  RimStepper<PackingType> stepper;
  stepper.boundary.width = 1.0;
  scarp::StepObservation<2> seen;
  Tensor<2> moved = Tensor<2>::Identity();
  for (int step = 0; step < 50; ++step) {
    REQUIRE(stepper.template step<scarp::Observe::balance>(packing, samples::study_law(), strain_step(1e-5), &seen)
                .acceptable());
    moved = (scarp::exponential_of_small<2>(strain_step(1e-5)) * moved).eval();
  }
  double const mean_diameter = std::sqrt(4.0 / std::numbers::pi * packing.population->content() / 200.0);
  int held = 0, fluctuating = 0;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    Vector<2> const place(before.position(i, 0), before.position(i, 1));
    Vector<2> share = before.cell.inverse() * place;
    share = (share.array() - share.array().floor()).eval();
    // Distance to the faces of a cell that has hardly tilted.
    double nearest = 1.0;
    for (int a = 0; a < 2; ++a)
      nearest = std::min({nearest, share(a) * before.cell(a, a), (1.0 - share(a)) * before.cell(a, a)});
    if (std::abs(nearest - mean_diameter) < 0.05 * mean_diameter) continue;  // may have drifted in, or the cell tilts
    Vector<2> const affine = moved * place;
    double const away = (Vector<2>(packing.position(i, 0), packing.position(i, 1)) - affine).norm();
    if (nearest < mean_diameter) {
      ++held;
      CHECK(away < 1e-13 * before.cell.norm());
      CHECK(packing.spin(i, 0) == 0.0);
    } else {
      fluctuating += away > 1e-9 * mean_diameter ? 1 : 0;  // some touch nothing
    }
  }
  CHECK(held > 40);
  CHECK(fluctuating > 40);
  REQUIRE(stepper.observe(packing, samples::study_law(), seen).acceptable());
  double const of_free = seen.unbalanced_ratio;
  REQUIRE(scarp::TimeStepper<PackingType>{}.observe(packing, samples::study_law(), seen).acceptable());
  CHECK(of_free < 0.5 * seen.unbalanced_ratio);
}

TEST_CASE("energy balances although grains are held") {
  auto packing = samples::consolidated<Discs>(100).packing;
  RimStepper<Discs> stepper;
  examples::EnergyLedger<2> ledger;
  for (int step = 0; step < 1000; ++step) {
    scarp::StepObservation<2> seen;
    double const volume = packing.volume();
    REQUIRE(stepper.step<scarp::Observe::energy>(packing, samples::study_law(), strain_step(5e-6), &seen).acceptable());
    ledger.enter(seen, volume, strain_step(5e-6));
  }
  double const turned_over = std::abs(ledger.stored) + ledger.contact_loss + ledger.damping_loss;
  CHECK(std::abs(ledger.gap()) < 1e-3 * turned_over);  // the bound of the study for the energy that steps make or lose
}

TEST_CASE("a packing with a rim answers as a material, and relaxes by FIRE without the grains that are held") {
  using Source = scarp::SamePacking<Discs>;
  using Soil = scarp::DemRve<Discs, Source, scarp::AffineTangent, LocalDamping, UniformStrainRim>;
  auto const& packing = samples::consolidated<Discs>(100).packing;
  Soil const soil{.law = samples::study_law(), .source = {packing}, .boundary = {.width = 1.0}};
  scarp::DemRve<Discs, Source> const periodic{.law = samples::study_law(), .source = {packing}};
  scarp::Gradient<2> const increment{{1e-4, 0.0}, {0.0, -2e-4}};
  auto const stress_after = [&](auto const& material) {
    auto const start = material.initial_state({});
    auto trial = start;
    auto const answer = material.respond(start, increment, trial);
    CHECK(answer.verdict.acceptable());
    return start.stress(1) - answer.stress(1);
  };
  CHECK(stress_after(soil) > 1.05 * stress_after(periodic));
  auto wrong = soil;
  wrong.boundary.width = -1.0;
  CHECK_REFUSED(wrong.initial_state({}), "width of the rim is -1");

  scarp::TimeStepper<Discs, scarp::Fire, UniformStrainRim> stepper;
  auto strained = packing;
  scarp::StepObservation<2> seen;
  REQUIRE(stepper.step(strained, samples::study_law(), strain_step(1e-4)).acceptable());
  for (int step = 0; step < 1000; ++step)
    REQUIRE(
        stepper.step<scarp::Observe::balance>(strained, samples::study_law(), Tensor<2>::Zero(), &seen).acceptable());
  CHECK(seen.unbalanced_ratio < 1e-4);
}

TEST_CASE("spheres are held at all six faces, and prepared so") {
  auto const grading = scarp::SphereGrading{.smallest = 4e-3, .largest = 6e-3};
  scarp::Cloud<scarp::SphereGrading> const cloud{.grading = grading, .grains = 100, .density = samples::density};
  scarp::LinearFrictional const law{.normal_stiffness = 3e5, .tangential_stiffness = 3e5, .friction = 0.5};
  auto const start = cloud.make<Spheres>();
  auto packing = start;
  scarp::TimeStepper<Spheres, LocalDamping, UniformStrainRim> stepper;
  for (std::size_t i = 0; i < 100; ++i) packing.velocity(i, 0) = 1.0;
  REQUIRE(stepper.step(packing, law, Tensor<3>::Zero()).acceptable());
  double const diameter = std::cbrt(6.0 / std::numbers::pi * packing.population->content() / 100.0);
  for (std::size_t i = 0; i < 100; ++i) {
    double nearest = 1.0;
    for (int a = 0; a < 3; ++a)
      nearest = std::min({nearest, start.position(i, a), start.cell(a, a) - start.position(i, a)});
    CHECK((packing.velocity(i, 0) == 0.0) == (nearest < diameter));
  }
  auto const made =
      scarp::IsotropicPreparation{.pressure = 1e5}.prepare(start, law, LocalDamping{}, UniformStrainRim{.width = 0.5});
  CHECK(made.verdict.acceptable());
}
