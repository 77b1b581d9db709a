// SPDX-License-Identifier: BSL-1.0
#include "sand.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "../shared/packing_input.hpp"
#include "../shared/study/study_sand.hpp"
#include "scarp/io/packings/contact_reader.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/shape/disc.hpp"

namespace biaxial_specimen {

namespace {

template <class Shape>
using PackingOf = scarp::Packing<Shape, scarp::LinearFrictional>;
template <class Shape>
using Pool = scarp::RandomChoice<scarp::SamePacking<PackingOf<Shape>>>;
template <class Shape>
using Rve = scarp::DemRve<PackingOf<Shape>, Pool<Shape>>;

template <class Shape>
Rve<Shape> rve(Grains const& grains, double pressure, scarp::LinearFrictional const& law, Pool<Shape> pool) {
  return {.law = law,
          .source = std::move(pool),
          .strain_per_step = grains.strain_per_dem_step,
          .pressure_floor = pressure / 100.0};
}

scarp::AnyProvider<2> prepared(Grains const& grains, double pressure, int points, scarp::ThreadExecutor& executor) {
  auto const law = examples::study_law();
  auto cloud = examples::study_cloud(grains.prepared, grains.seed);
  cloud.density = grains.density;
  cloud.thickness = grains.thickness;
  scarp::IsotropicRecipe<PackingOf<scarp::Ellipse>, scarp::EllipseGrading> const recipe{
      .cloud = cloud,
      .preparation = {.pressure = pressure, .preparation_friction = grains.preparation_friction},
      .law = law};
  int const most = std::min(grains.pool, points);
  return rve<scarp::Ellipse>(grains, pressure, law, scarp::RandomPackings{recipe, grains.seed}.pool(most, executor));
}

template <class Shape>
Rve<Shape> read(Grains const& grains, double pressure, examples::PackingInput const& input,
                scarp::LinearFrictional const& law) {
  constexpr double tolerance = 1e-6;  // of the file's overlaps against the packing's, over the smallest radius
  auto named = scarp::read_packing<PackingOf<Shape>>(input.particles, input.cell, grains.density, grains.thickness);
  if (input.contacts && input.contacts->has("ftx")) scarp::read_contacts(named, *input.contacts, law, tolerance);
  return rve<Shape>(grains, pressure, law, {{{std::move(named.packing)}}});
}

}  // namespace

scarp::AnyProvider<2> sand(Grains const& grains, double pressure, int points, scarp::ThreadExecutor& executor) {
  if (grains.particles.empty()) return prepared(grains, pressure, points, executor);
  auto const input = examples::read_packing_input(grains.particles, grains.contacts, grains.cell);
  auto const of_contacts = [&](std::string_view column, double otherwise) {
    return input.contacts ? examples::only_value(*input.contacts, column).value_or(otherwise) : otherwise;
  };
  auto const usual = examples::study_law();
  auto const given = [&](std::optional<double> value, std::string_view column, double otherwise) {
    return value ? *value : of_contacts(column, otherwise);
  };
  scarp::LinearFrictional const law{
      .normal_stiffness = given(grains.normal_stiffness, "kn", usual.normal_stiffness),
      .tangential_stiffness = given(grains.tangential_stiffness, "ks", usual.tangential_stiffness),
      .friction = given(grains.friction, "tan_phi", usual.friction)};
  auto const shape = examples::shape_of(input.particles);
  if (shape == "disc") return read<scarp::Disc>(grains, pressure, input, law);
  if (shape == "ellipse") return read<scarp::Ellipse>(grains, pressure, input, law);
  scarp::reject("'{}' holds grains of the shape {} (discs and ellipses are built): take other grains", grains.particles,
                shape);
}

}  // namespace biaxial_specimen
