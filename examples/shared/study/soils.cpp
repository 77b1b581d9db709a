// SPDX-License-Identifier: BSL-1.0
#include "soils.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "../sand/ground.hpp"
#include "../sand/sand_file.hpp"
#include "any_soil.hpp"
#include "scarp/dem/mirrored.hpp"
#include "scarp/io/packings/packing_tables.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace fault_rupture {

namespace {

/// Level ground, by default at the reference study's K0 of about 0.4.
scarp::GeostaticStress<2> ground_at_rest(Choice const& choice) {
  return {
      .surcharge = choice.surcharge, .unit_weight = choice.unit_weight, .k0 = choice.k0, .buoyancy = choice.buoyancy()};
}

scarp::IsotropicElasticity soil_elasticity(Choice const& choice) {
  return scarp::IsotropicElasticity::from_young_poisson(choice.young_modulus, 0.25);
}

/// What all soils' scenes share.
template <class Soil>
AnySoil solved(Choice const& choice, Soil const& soil, scarp::QuasiNewton<> solver = {}) {
  double const tolerance = choice.tolerance.value_or(Soil::tolerance(choice));
  solver.tolerance = tolerance;
  solver.max_iterations = choice.max_iterations;
  return {.provider = soil,
          .solver = solver,
          .tolerance = tolerance,
          .max_displacement_gradient =
              choice.max_displacement_gradient.value_or(Soil::max_displacement_gradient(choice.quick)),
          .pressure_floor = choice.least_pressure() / 2.0,
          .shear_modulus = soil_elasticity(choice).shear_modulus};
}

/// \throws scarp::InputError
void require_angles_in_order(Choice const& choice, double residual_friction_angle) {
  if (choice.peak_dilation_angle > choice.peak_friction_angle)
    scarp::reject(
        "--peak-dilation-angle {} is above --peak-friction-angle {} degrees (flow would create energy): give less "
        "dilation",
        choice.peak_dilation_angle, choice.peak_friction_angle);
  if (residual_friction_angle > choice.peak_friction_angle)
    scarp::reject(
        "--residual-friction-angle {} is above --peak-friction-angle {} degrees (the soil would harden): give less",
        residual_friction_angle, choice.peak_friction_angle);
}

std::size_t images_of(Choice const& choice) { return choice.mirrored_packings ? 2 : 1; }

/// All sands of the ground from the surface down, with the choice's grains and seed.
std::vector<Layer> layers_of(Choice const& choice) {
  std::vector<Layer> layers{{0.0, sand_of(choice)}};
  for (auto layer : choice.layers) {
    layer.sand.grains = choice.grains;
    layer.sand.seed = choice.seed;
    layers.push_back(std::move(layer));
  }
  return layers;
}

/// No more than what points draw, at the same time where threads are requested.
Columns make_columns(Choice const& choice, std::vector<scarp::Site<2>> const& sites) {
  auto const layers = layers_of(choice);
  auto depths = drawn_depths(choice, sites);
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    bool is_drawn = false;
    for (std::size_t k = layer; k < depths.size(); k += layers.size()) is_drawn = is_drawn || !depths[k].empty();
    if (!is_drawn)
      scarp::reject("the layer from {} m down has no integration point (the mesh is coarser than it): refine the mesh",
                    layers[layer].top);
  }
  std::vector<scarp::PackingsByDepth<Grains>> parts(depths.size());
  scarp::ThreadExecutor executor(depths.size() > 1 ? choice.threads : 1);
  executor.for_each(static_cast<int>(depths.size()), [&](int number) {
    auto const k = static_cast<std::size_t>(number);
    if (depths[k].empty()) return;
    auto const& sand = layers[k % layers.size()].sand;
    auto const column = k / layers.size();
    auto const seed = column > 0 ? scarp::family_seed(sand.seed, column) : sand.seed;
    parts[k] = examples::level_ground<Grains>(sand, examples::law_of<Grains::Law>(sand), seed, choice.unit_weight,
                                              choice.surcharge, std::move(depths[k]), choice.buoyancy());
  });
  std::size_t const count = parts.size() / layers.size();
  Columns columns{std::vector<scarp::PackingsByDepth<Grains>>(images_of(choice) * count), choice.seed};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    auto& column = columns.sources[k / layers.size()];
    column.depths.insert(column.depths.end(), parts[k].depths.begin(), parts[k].depths.end());
    std::ranges::move(parts[k].packings, std::back_inserter(column.packings));
  }
  for (std::size_t k = count; k < columns.sources.size(); ++k) {
    columns.sources[k] = columns.sources[k - count];
    for (auto& packing : columns.sources[k].packings) packing = scarp::mirrored(std::move(packing));
  }
  return columns;
}

/// What a sand is, without the number of grains and the state of the ground.
std::string material_of(Choice const& choice) {
  auto sand = sand_of(choice);
  Choice const study;
  sand.grains = study.grains;
  sand.seed = study.seed;
  sand.overconsolidation_ratio = study.overconsolidation_ratio;
  sand.conductivity = study.sand.conductivity;
  sand.calibrated_on = sand.misfit = {};
  return examples::text_of(sand);
}

}  // namespace

bool repeats_study(Choice const& choice) {
  Choice const study;
  auto const same = [&](auto... members) {
    return ((std::abs(choice.*members - study.*members) <= 1e-6 * study_depth) &&
            ...);  // what files with seven digits hold
  };
  if (!same(&Choice::depth, &Choice::left, &Choice::width, &Choice::unit_weight, &Choice::surcharge, &Choice::dip,
            &Choice::tip) ||
      choice.reverse || choice.water_table || !choice.layers.empty())
    return false;
  if (choice.study) return true;
  if (choice.soil == Soil::dem) return material_of(choice) == material_of(study);
  return choice.soil == Soil::mohr_coulomb && !choice.residual_friction_angle &&
         same(&Choice::peak_friction_angle, &Choice::peak_dilation_angle, &Choice::k0);
}

examples::Sand sand_of(Choice const& choice) {
  auto sand = choice.sand;
  sand.grains = choice.grains;
  sand.seed = choice.seed;
  sand.preparation_friction = choice.preparation_friction;
  sand.overconsolidation_ratio = choice.overconsolidation_ratio;
  sand.aspect = choice.grain_aspect;
  sand.friction = choice.grain_friction;
  with_packing(examples::Built<Grains>{}, sand, [](auto, auto const&) {});
  return sand;
}

std::vector<std::vector<double>> drawn_depths(Choice const& choice, std::vector<scarp::Site<2>> const& sites) {
  auto const count = static_cast<std::size_t>(choice.packings);
  auto const& layers = choice.layers;
  std::vector<std::vector<double>> depths(count * (1 + layers.size()));
  for (auto const& site : sites) {
    auto const below = std::ranges::find_if(layers, [&](auto const& layer) { return site.depth < layer.top; });
    auto const column = Columns::drawn(choice.seed, site.index, images_of(choice) * count) % count;
    depths[column * (1 + layers.size()) + static_cast<std::size_t>(below - layers.begin())].push_back(site.depth);
  }
  for (auto& column : depths) {
    std::ranges::sort(column);
    auto const is_same = [](double a, double b) { return b - a < 1e-6; };
    column.erase(std::unique(column.begin(), column.end(), is_same), column.end());
  }
  return depths;
}

Sand make_sand(Choice const& choice, std::vector<scarp::Site<2>> const& sites) {
  Sand sand;
  auto& packings = sand.provider;
  packings.law = examples::law_of<Grains::Law>(sand_of(choice));
  packings.source = make_columns(choice, sites);
  packings.strain_per_step = choice.strain_per_step;
  packings.min_steps = choice.min_dem_steps;
  packings.unbalanced_tolerance = choice.unbalanced_tolerance;
  packings.pressure_floor = choice.least_pressure();
  return sand;
}

FrictionalSoil make_frictional_soil(Choice const& choice) {
  constexpr double degree = std::numbers::pi / 180.0;
  double const residual_friction_angle =
      choice.residual_friction_angle.value_or(choice.peak_friction_angle - 0.8 * choice.peak_dilation_angle);
  require_angles_in_order(choice, residual_friction_angle);
  scarp::Strength const peak{.cohesion = 1e3,
                             .friction = choice.peak_friction_angle * degree,
                             .dilation = choice.peak_dilation_angle * degree};
  scarp::Strength const residual{.cohesion = 1e3, .friction = residual_friction_angle * degree, .dilation = 0.0};
  return {{soil_elasticity(choice),
           {.peak = peak, .residual = residual, .softening_strain = choice.softening_strain},
           ground_at_rest(choice)}};
}

ElasticSoil make_elastic_soil(Choice const& choice) { return {{soil_elasticity(choice), ground_at_rest(choice)}}; }

AnySoil any_soil(Choice const& choice, std::vector<scarp::Site<2>> const& sites, ToDevice const& to_device) {
  switch (choice.soil) {
    case Soil::dem: {
      auto const sand = make_sand(choice, sites);
      auto soil = solved(choice, sand, {});
      soil.pressure_floor = sand.provider.pressure_floor;
      if (to_device) soil.provider = to_device(sand);
      auto const& columns = sand.provider.source.sources;
      auto const& packings =
          std::ranges::find_if(columns, [](auto const& column) { return !column.packings.empty(); })->packings;
      soil.write_packing = [packing = packings[packings.size() / 2],
                            law = sand.provider.law](std::filesystem::path const& folder) {
        scarp::write_packing_tables(folder, packing, law);
      };
      return soil;
    }
    case Soil::mohr_coulomb: {
      scarp::QuasiNewton<> solver;
      solver.rule.exact.floor = FrictionalSoil::tangent_floor;
      return solved(choice, make_frictional_soil(choice), solver);
    }
    case Soil::elastic: break;
  }
  return solved(choice, make_elastic_soil(choice));
}

}  // namespace fault_rupture
