// SPDX-License-Identifier: BSL-1.0
#include "sand.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "../shared/contact_reader.hpp"
#include "../shared/packing_input.hpp"
#include "../shared/sand/built.hpp"
#include "../shared/sand/preparation.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"

namespace biaxial_specimen {

namespace {

using examples::Sand;

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
  constexpr double off = 0.01;  // over such void ratios packings of few grains jump
  Sand sand = grains.sand;
  if (sand.vertical_pressure > 0.0 || sand.k0 > 0.0)
    scarp::reject(
        "the sand has vertical-pressure {} and k0 {} (the specimen begins under the confining pressure alone): leave "
        "both out",
        sand.vertical_pressure, sand.k0);
  double const of_density = sand.pressure;  // where void ratio and relative density are those of the sand
  bool const by_density = (sand.void_ratio > 0.0 || sand.relative_density > 0.0) && of_density != pressure;
  sand.pressure = pressure;
  scarp::AnyProvider<2> made;
  using examples::Linear;
  with_packing(
      examples::Built<Linear<scarp::Disc>, Linear<scarp::Ellipse>>{}, sand,
      [&]<class Packing>(std::type_identity<Packing>, auto const& law) {
        auto const recipe = [&](std::uint64_t seed) {
          Sand own = sand;
          if (by_density) {
            auto const cloud = examples::cloud_of<typename Packing::Shape>(sand, seed);
            examples::Consolidation<Packing> const there{cloud.template make<Packing>(), law, of_density, of_density};
            own.preparation_friction = examples::consolidated(there, sand, off).friction;
            own.void_ratio = own.relative_density = 0.0;
          }
          return scarp::Prepared<Packing>{examples::prepared<Packing>(own, law, seed, {}, off), {}};
        };
        int const most = std::min(grains.pool, points);
        made = rve<typename Packing::Shape>(grains, pressure, law,
                                            scarp::RandomPackings{recipe, sand.seed}.pool(most, executor));
      });
  return made;
}

template <class Shape>
Rve<Shape> read(Grains const& grains, double pressure, examples::PackingInput const& input,
                scarp::LinearFrictional const& law) {
  constexpr double tolerance = 1e-6;  // of the file's overlaps against the packing's, over the smallest radius
  auto named =
      scarp::read_packing<PackingOf<Shape>>(input.particles, input.cell, grains.sand.density, grains.sand.thickness);
  if (input.contacts && input.contacts->has("ftx")) examples::read_contacts(named, *input.contacts, law, tolerance);
  return rve<Shape>(grains, pressure, law, {{{std::move(named.packing)}}});
}

}  // namespace

scarp::AnyProvider<2> sand(Grains const& grains, double pressure, int points, scarp::ThreadExecutor& executor) {
  if (grains.particles.empty()) return prepared(grains, pressure, points, executor);
  auto const input = examples::read_packing_input(grains.particles, grains.contacts, grains.cell);
  auto const of_contacts = [&](std::string_view column, double otherwise) {
    return input.contacts ? examples::only_value(*input.contacts, column).value_or(otherwise) : otherwise;
  };
  examples::Sand const usual;
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
