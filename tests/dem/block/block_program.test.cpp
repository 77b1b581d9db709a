// SPDX-License-Identifier: BSL-1.0
#include "scarp/dem/block/block_program.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/rolling_resistance.hpp"
#include "scarp/dem/block/block_packings.hpp"
#include "scarp/dem/block/processor_team.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/simd/soa_array.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

namespace {

using scarp::Tensor;
using Bytes = scarp::AlignedVector<std::byte>;

/// A packing under pressure whose list is of now.
template <class PackingType>
struct Sample {
  using Types = scarp::BlockTypesOf<PackingType>;
  using Law = typename PackingType::Law;

  PackingType packing;
  Law law;
  scarp::BlockSize size;

  Sample(PackingType prepared, Law const& of_contacts) : packing(std::move(prepared)), law(of_contacts) {
    scarp::TimeStepper<PackingType> stepper;
    scarp::StepObservation<PackingType::dim> seen;
    REQUIRE(stepper.observe(packing, law, seen).acceptable());
    size = scarp::block_size(packing, 1.4);
  }

  Bytes state(PackingType const& of) const {
    Bytes bytes(scarp::BlockState<Types>::bytes(size));
    scarp::to_block(of, scarp::BlockState<Types>(bytes.data(), size));
    return bytes;
  }

  /// threads: 0 for a team of one without barriers
  Bytes respond(Bytes& committed, Tensor<PackingType::dim> const& strain_step, int steps, int threads) const {
    Bytes trial(committed.size());
    Bytes bench(scarp::BlockBench<Types, scarp::HostMemory>::bytes(size));
    auto const grains = scarp::block_grains<typename Types::Shape, Law>(*packing.population);
    auto const work = [&]<class Team>(Team& team) {
      scarp::BlockProgram<Types, scarp::LocalDamping, Team> program(team, size, grains, law, {},
                                                                    scarp::default_time_step_share);
      program.respond({committed.data(), size}, {trial.data(), size}, steps,
                      scarp::detail::row_by_row<PackingType::dim>(strain_step));
    };
    if (threads == 0) {
      scarp::OneThread alone{bench.data()};
      work(alone);
    } else {
      scarp::ProcessorTeam::run(threads, bench.data(), work);
    }
    return trial;
  }

  scarp::BlockHeader<PackingType::dim> const& header(Bytes& state) const {
    return *scarp::BlockState<Types>(state.data(), size).header;
  }
};

template <int Dim>
Tensor<Dim> shear_step(double size) {
  Tensor<Dim> strain = Tensor<Dim>::Zero();
  strain(0, 0) = size;
  strain(1, 1) = -1.3 * size;
  strain(0, 1) = 0.7 * size;
  strain(1, 0) = -0.2 * size;
  return strain;
}

template <class PackingType, class Law>
PackingType pressed(Law const& law, int grains = 100) {
  if constexpr (PackingType::dim == 3) {
    scarp::Cloud<scarp::SphereGrading> const cloud{
        .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = grains, .density = samples::density};
    return scarp::IsotropicPreparation{.pressure = samples::pressure}.prepare(cloud.make<PackingType>(), law).packing;
  } else {
    return scarp::IsotropicPreparation{.pressure = samples::pressure}
        .prepare(samples::loose_cloud<PackingType>(grains, 1), law)
        .packing;
  }
}

/// Both take so many steps; the vector kernel is the reference.
template <class PackingType>
void check_steps(Sample<PackingType> const& sample, double size, int steps) {
  constexpr int dim = PackingType::dim;
  constexpr bool in_double = std::is_same_v<typename PackingType::Scalar, double>;
  auto const strain = shear_step<dim>(size);
  PackingType reference = sample.packing;
  scarp::TimeStepper<PackingType> stepper;
  scarp::StepObservation<dim> seen;
  for (int k = 0; k < steps; ++k) REQUIRE(stepper.step(reference, sample.law, strain).acceptable());
  REQUIRE(stepper.observe(reference, sample.law, seen).acceptable());

  Bytes committed = sample.state(sample.packing);
  Bytes trial = sample.respond(committed, strain, steps, 0);
  auto const& header = sample.header(trial);
  REQUIRE(header.trouble == scarp::Trouble::none);
  PackingType packing = sample.packing;
  scarp::from_block({trial.data(), sample.size}, packing);
  Tensor<dim> const stress = -scarp::detail::as_tensor<dim>(header.moment) / packing.volume();
  // Additions in another order: round-off that 100 steps of colliding grains let grow. In single precision the vector kernel's own sum
  // of a thousand forces has an error of 1e-5.
  CHECK((stress - seen.stress).norm() <= (in_double ? 1e-12 : 1e-4) * seen.stress.norm());
  CHECK(std::abs(header.contacts - seen.contacts) <= (in_double ? 0.0 : 2.0));
  CHECK(header.critical_step == samples::Approx(reference.pairs.critical_step).epsilon(in_double ? 1e-12 : 1e-5));
  CHECK(static_cast<std::size_t>(header.pairs) == reference.pairs.count());
  double const mean_force = header.force / header.contacts;
  CHECK(header.unbalanced / header.grains / mean_force ==
        samples::Approx(seen.unbalanced_ratio).epsilon(in_double ? 1e-7 : 0.1));

  SUBCASE("any number of threads gives the same bits") {
    for (int const threads : {1, 2, 3, 7}) {
      Bytes const several = sample.respond(committed, strain, steps, threads);
      CHECK(std::memcmp(several.data(), trial.data(), trial.size()) == 0);
    }
  }
  SUBCASE("a state that was a packing responds with the same bits") {
    Bytes again = sample.state(packing);
    Bytes const next = sample.respond(trial, strain, 20, 0);
    Bytes const after = sample.respond(again, strain, 20, 0);
    CHECK(std::memcmp(next.data(), after.data(), next.size()) == 0);
  }
}

template <class PackingType, class Law>
void check(Law const& law, double size = 1e-5, int grains = 100) {
  check_steps(Sample<PackingType>(pressed<PackingType>(law, grains), law), size, 100);
}

using Rolling = scarp::RollingResistance<scarp::LinearFrictional>;
using Bonded = scarp::CohesiveBond<scarp::LinearFrictional>;
scarp::HertzMindlin<> const elastic{.reduced_modulus = 4e9, .reduced_shear_modulus = 1e9, .friction = 0.5};

template <class PackingType>
scarp::Trouble trouble_of(Sample<PackingType> const& sample, Tensor<2> const& strain) {
  Bytes committed = sample.state(sample.packing);
  Bytes trial = sample.respond(committed, strain, 50, 2);
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
  check<scarp::Packing<scarp::Ellipse, scarp::LinearFrictional, float>>(samples::study_law(), 1e-5, 400);
}

TEST_CASE("a block ends with its trouble") {
  auto const law = samples::study_law();
  Sample<samples::Ellipses> sample(pressed<samples::Ellipses>(law), law);
  SUBCASE("velocities that are no numbers") {
    sample.packing.velocity(3, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK(trouble_of(sample, shear_step<2>(1e-5)) == scarp::Trouble::not_finite);
  }
  SUBCASE("a touch that needs a slow search") {
    sample.size.pairs *= 8;
    Tensor<2> strain = Tensor<2>::Zero();
    strain(0, 0) = -0.6;
    CHECK(trouble_of(sample, strain) == scarp::Trouble::unsettled_touch);
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
  Sample<samples::SmoothDiscs> sample(pressed<samples::SmoothDiscs>(law), law);
  sample.size.pairs *= 8;
  Tensor<2> strain = Tensor<2>::Zero();
  strain(0, 0) = -0.6;
  CHECK(trouble_of(sample, strain) == scarp::Trouble::cell_collapsed);
}
