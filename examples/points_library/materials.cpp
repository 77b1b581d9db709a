// SPDX-License-Identifier: BSL-1.0
#include "materials.hpp"

#include <numbers>
#include <set>

#include "../shared/sand/built.hpp"
#include "../shared/sand/preparation.hpp"
#include "../shared/sand/sand_file.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"

namespace points_library {
namespace {

using examples::Entries;
using examples::Linear;
using examples::Sand;

template <int Dim>
scarp::GeostaticStress<Dim> initial_stress(Entries& entries) {
  scarp::GeostaticStress<Dim> initial;
  entries.take("surcharge", initial.surcharge);
  entries.take("unit-weight", initial.unit_weight);
  entries.take("k0", initial.k0);
  return initial;
}

scarp::IsotropicElasticity elasticity(Entries& entries) {
  double young = 0.0, poisson = 0.0;
  entries.take("young", young);
  entries.take("poisson", poisson);
  return scarp::IsotropicElasticity::from_young_poisson(young, poisson);
}

scarp::Strength strength(Entries& entries) {
  scarp::Strength strength;
  entries.take("cohesion", strength.cohesion);
  entries.take("tension", strength.tension);
  auto const take_angle = [&](char const* key, double& angle) {
    entries.take(key, angle);
    angle = std::numbers::pi / 180.0 * scarp::require_between(fmt::format("{} [degrees]", key), angle, 0.0, 89.0);
  };
  take_angle("friction", strength.friction);
  take_angle("dilation", strength.dilation);
  return strength;
}

/// The provider, once it has made a state: parameters that cannot be are found now and not in a host's first step.
template <class Provider>
scarp::AnyProvider<Provider::dim> tried(Provider const& provider) {
  static_cast<void>(provider.initial_state({}));
  return provider;
}

template <int Dim>
scarp::AnyProvider<Dim> continuum(std::string const& kind, Entries& entries) {
  auto const initial = initial_stress<Dim>(entries);
  auto const elastic = elasticity(entries);
  scarp::Strength const bounds = kind == "elastic" ? scarp::Strength{} : strength(entries);
  entries.require_all_taken("a material of kind " + kind);
  if (kind == "elastic") return tried(scarp::LinearElastic<Dim, scarp::GeostaticStress<Dim>>{elastic, initial});
  return tried(scarp::MohrCoulomb<Dim, scarp::GeostaticStress<Dim>>{elastic, {.strength = bounds}, initial});
}

/// The packings that are built in the plane and in space.
template <int Dim>
using Grains = std::conditional_t<Dim == 2, examples::Built<Linear<scarp::Disc>, Linear<scarp::Ellipse>>,
                                  examples::Built<Linear<scarp::Sphere>>>;

/// folder: where relative names of files begin
template <int Dim>
Material packing(Entries& entries, std::filesystem::path const& folder) {
  std::string sand_file, file;
  entries.take("sand", sand_file);
  entries.take("file", file);
  if (!sand_file.empty() && !file.empty())
    scarp::reject("'sand' stands beside 'file' (the packing of '{}' has its own sand): leave one of them out", file);
  double strain_per_step = 1e-5, unbalanced_tolerance = 0.05;
  entries.take("strain-per-step", strain_per_step);
  entries.take("unbalanced-tolerance", unbalanced_tolerance);
  Sand sand{.shape = Dim == 2 ? "disc" : "sphere"};
  std::set<std::string> given;
  examples::for_each_option(sand, [&](char const* name, auto const&, examples::Range, char const*) {
    if (entries.has(name)) given.insert(name);
  });
  entries.take("shape", sand.shape);
  entries.take("law", sand.law);
  auto const is_given = [&](std::string const& name) { return given.contains(name); };
  if (!file.empty()) examples::require_of_grains(sand, is_given, file);
  if (!sand_file.empty()) sand = examples::read_sand(folder / sand_file, sand, is_given);
  if (!file.empty()) sand = examples::sand_of_packing(folder / file, sand, is_given, "");
  if (given.contains("void-ratio") || given.contains("relative-density") || given.contains("preparation-friction"))
    sand.preparation_friction = sand.void_ratio = sand.relative_density = 0.0;
  examples::take(entries, sand);
  entries.require_all_taken("a material of kind packing");
  Material made;
  with_packing(Grains<Dim>{}, sand, [&]<class Packing>(std::type_identity<Packing>, auto const& law) {
    scarp::DemRve<Packing, scarp::SamePacking<Packing>> rve{
        .law = law, .strain_per_step = strain_per_step, .unbalanced_tolerance = unbalanced_tolerance};
    rve.source.packing = file.empty() ? examples::prepared<Packing>(sand, law, sand.seed, {}, sand.void_ratio_tolerance)
                                      : scarp::load_packing<Packing>(folder / file);
    made = tried(rve);
  });
  return made;
}

}  // namespace

Material material_of(std::string_view text, std::filesystem::path const& folder) {
  Entries entries(text);
  std::string kind;
  int dimension = 2;
  entries.take("kind", kind);
  entries.take("dimension", dimension);
  if (dimension != 2 && dimension != 3)
    scarp::reject("the dimension is {} (2 or 3 is expected): correct it", dimension);
  if (kind == "packing") return dimension == 2 ? packing<2>(entries, folder) : packing<3>(entries, folder);
  if (kind != "elastic" && kind != "mohr-coulomb")
    scarp::reject("the kind of a material is '{}' (elastic, mohr-coulomb or packing is expected): give one", kind);
  if (dimension == 2) return continuum<2>(kind, entries);
  return continuum<3>(kind, entries);
}

Material read_material(std::filesystem::path const& path) {
  std::string const text = scarp::read_file(path);
  return scarp::with_context(fmt::format("material '{}'", path.string()),
                             [&] { return material_of(text, path.parent_path()); });
}

}  // namespace points_library
