// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "../shared/sliding_contacts.hpp"
#include "../shared/study/study_sand.hpp"
#include "halved_path.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/fabric.hpp"

namespace rve_biaxial {

using Packing = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;

/// What the user may choose; the rest is the reference study's material.
struct Choice {
  int grains = 400;
  double preparation_friction = 0.12;  ///< puts the void ratio in the reference study's range
  double pressure = 2e5;               ///< [Pa]
  double strain = 0.2;                 ///< axial logarithmic strain at the end
  double strain_per_step = 2e-6;       ///< axial, of one DEM step
};

/// Geotechnical view, compression positive, strains logarithmic. Stresses are means over the steps since the former
/// row, everything else is the state at the row's strain.
struct Row {
  double axial_strain = 0.0;
  double lateral_strain = 0.0;
  double volumetric_strain = 0.0;
  double axial_stress = 0.0;    ///< [Pa]
  double lateral_stress = 0.0;  ///< [Pa]
  double void_ratio = 0.0;
  double coordination = 0.0;
  double contact_fabric = 0.0;
  double particle_fabric = 0.0;
  double unbalanced_ratio = 0.0;
  double sliding_share = 0.0;
};

struct Result {
  double preparation_friction = 0.0;
  std::uint64_t seed = 0;
  scarp::Verdict prepared;
  scarp::Verdict sheared;
  Packing consolidated;
  std::vector<Row> rows;
  double inertial_number = 0.0;
  std::vector<double> halved;  ///< change of a row's stress in steps of half the strain, of sampled rows
};

using examples::study_law;

inline scarp::Prepared<Packing> consolidated_packing(Choice const& choice, std::uint64_t seed) {
  scarp::IsotropicPreparation const preparation{.pressure = choice.pressure,
                                                .preparation_friction = choice.preparation_friction};
  return preparation.prepare(examples::study_cloud(choice.grains, seed).make<Packing>(), study_law());
}

inline Row describe(Packing const& packing, double axial_strain, double volumetric_strain,
                    scarp::Tensor<2> const& stress) {
  auto const law = study_law();
  auto const network = scarp::contact_network(packing, law);
  return {.axial_strain = axial_strain,
          .lateral_strain = volumetric_strain - axial_strain,
          .volumetric_strain = volumetric_strain,
          .axial_stress = -stress(1, 1),
          .lateral_stress = -stress(0, 0),
          .void_ratio = packing.void_ratio(),
          .coordination = network.coordination.all,
          .contact_fabric = scarp::fabric_anisotropy(network.fabric),
          .particle_fabric = scarp::fabric_anisotropy(scarp::particle_fabric(packing)),
          .unbalanced_ratio = scarp::balance(packing, law).unbalanced_ratio,
          .sliding_share = examples::sliding_share(packing, law)};
}

/// Of compression at a constant rate.
inline double inertial_number(Packing const& packing, Choice const& choice, double time_step_share) {
  auto const& grains = *packing.population;
  double const rate = choice.strain_per_step / (time_step_share * packing.pairs.critical_step);
  return rate * 2.0 * grains.largest_radius() * std::sqrt(grains.density() / choice.pressure);
}

/// Drained biaxial compression: yy shortens at a constant rate, a servo keeps sigma_xx at the pressure, no shear
/// strain.
inline void compress(Packing packing, Choice const& choice, Result& result) {
  constexpr double strain_per_row = 2.5e-4;
  auto const law = study_law();
  scarp::TimeStepper<Packing> stepper;
  scarp::CellDriver<Packing> drive(packing, law,
                                   scarp::drained_compression<2>(choice.strain_per_step, choice.pressure));
  double const first_area = packing.cell.determinant();
  result.rows.push_back(describe(packing, 0.0, 0.0, scarp::balance(packing, law).stress));
  long const steps = std::lround(choice.strain / choice.strain_per_step);
  long const steps_per_row = std::max(1L, std::lround(strain_per_row / choice.strain_per_step));
  // One row of a hundred is gone through again in halved steps: two hundredths of the work.
  constexpr long rows_per_sample = 100;
  std::optional<HalvedPath<Packing>> sample;
  scarp::Tensor<2> sum = scarp::Tensor<2>::Zero();
  for (long step = 1; step <= steps; ++step) {
    if ((step - 1) % (rows_per_sample * steps_per_row) == rows_per_sample * steps_per_row / 2) sample.emplace(packing);
    result.sheared = drive.step(stepper);
    if (!result.sheared.acceptable()) return;
    sum += drive.seen().stress;
    if (sample) sample->add(drive.strain_step(), drive.seen().stress);
    if (step % steps_per_row != 0) continue;
    double const volumetric_strain = -std::log(packing.cell.determinant() / first_area);
    result.rows.push_back(describe(packing, static_cast<double>(step) * choice.strain_per_step, volumetric_strain,
                                   sum / static_cast<double>(steps_per_row)));
    sum.setZero();
    result.inertial_number =
        std::max(result.inertial_number, inertial_number(packing, choice, stepper.time_step_share));
    if (sample) result.halved.push_back(sample->difference(law, stepper));
    sample.reset();
  }
}

inline Result run_seed(Choice const& choice, std::uint64_t seed) {
  Result result{.preparation_friction = choice.preparation_friction,
                .seed = seed,
                .prepared = {},
                .sheared = {},
                .consolidated = {},
                .rows = {},
                .inertial_number = 0.0,
                .halved = {}};
  auto prepared = consolidated_packing(choice, seed);
  result.prepared = prepared.verdict;
  result.consolidated = prepared.packing;
  if (result.prepared.acceptable()) compress(std::move(prepared.packing), choice, result);
  return result;
}

}  // namespace rve_biaxial
