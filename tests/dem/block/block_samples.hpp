// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "scarp/dem/block/block_packings.hpp"
#include "scarp/dem/block/block_program.hpp"
#include "scarp/dem/block/processor_team.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/sphere.hpp"
#include "scarp/simd/soa_array.hpp"
#include "support/approx.hpp"
#include "support/packings.hpp"

/// Packings whose steps by a block are compared with those of the vector kernel.
namespace blocks {

using scarp::Tensor;
using Bytes = scarp::AlignedVector<std::byte>;

/// Rows for a packing and a longer list.
template <class PackingType>
scarp::BlockSize roomy(PackingType const& packing) {
  auto const rounded_up = [](double number) { return static_cast<int>(std::ceil(number / 8.0)) * 8; };
  return {rounded_up(static_cast<double>(packing.grain_count())),
          rounded_up(1.4 * static_cast<double>(packing.pairs.count()))};
}

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
    size = roomy(packing);
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

/// Grains of a grading under pressure.
template <class PackingType, class Grading>
PackingType pressed(Grading const& grading, typename PackingType::Law const& law, int grains) {
  scarp::Cloud<Grading> cloud{.grading = grading, .grains = grains, .density = samples::density};
  if constexpr (PackingType::dim == 2) cloud.thickness = samples::thickness;
  return scarp::IsotropicPreparation{.pressure = samples::pressure}
      .prepare(cloud.template make<PackingType>(), law)
      .packing;
}

template <class PackingType>
PackingType pressed(typename PackingType::Law const& law, int grains = 100) {
  if constexpr (PackingType::dim == 3) {
    return pressed<PackingType>(scarp::SphereGrading{.smallest = 4e-3, .largest = 6e-3}, law, grains);
  } else {
    return pressed<PackingType>(samples::grading<PackingType>(), law, grains);
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
  // Additions in another order: round-off that colliding grains let grow. In single precision both are 2e-4 from a
  // packing in double after 100 steps and 2e-5 after ten (400 ellipses), where they are 1e-5 and 1e-7 from each other.
  CHECK((stress - seen.stress).norm() <= (in_double ? 1e-12 : steps > 10 ? 1e-4 : 1e-6) * seen.stress.norm());
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

template <class PackingType>
void check(typename PackingType::Law const& law, double size = 1e-5, int grains = 100, int steps = 100) {
  check_steps(Sample<PackingType>(pressed<PackingType>(law, grains), law), size, steps);
}

/// A list that is made anew, of a cell that was sheared before, against that of the vector kernel. bar: of the critical
/// step
template <class PackingType>
void check_renewal(Sample<PackingType> sample, double bar, double shear = 0.0) {
  sample.packing.cell.row(0) += shear * sample.packing.cell.row(1).eval();
  for (std::size_t i = 0; i < sample.packing.grain_count(); ++i)
    sample.packing.position(i, 0) += shear * sample.packing.position(i, 1);
  sample.size.pairs *= 2;
  sample.packing.pairs.drift = std::numeric_limits<double>::infinity();
  auto const strain = shear_step<PackingType::dim>(1e-5);
  Bytes committed = sample.state(sample.packing);
  Bytes trial = sample.respond(committed, strain, 1, 0);
  auto const& header = sample.header(trial);
  REQUIRE(header.trouble == scarp::Trouble::none);
  scarp::TimeStepper<PackingType> stepper;
  scarp::StepObservation<PackingType::dim> seen;
  REQUIRE(stepper.step(sample.packing, sample.law, strain).acceptable());
  REQUIRE(stepper.observe(sample.packing, sample.law, seen).acceptable());
  auto const moment = scarp::detail::as_tensor<PackingType::dim>(header.moment);
  CHECK((moment / sample.packing.volume() + seen.stress).norm() <= 1e-9 * seen.stress.norm());
  auto const cell = scarp::detail::as_tensor<PackingType::dim>(header.cell);
  CHECK((cell - sample.packing.cell).norm() <= 1e-12 * cell.norm());
  CHECK(header.lists == 1);
  CHECK(static_cast<std::size_t>(header.pairs) == sample.packing.pairs.count());
  CHECK(header.critical_step == samples::Approx(sample.packing.pairs.critical_step).epsilon(bar));
}

}  // namespace blocks
