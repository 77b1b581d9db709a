// SPDX-License-Identifier: BSL-1.0
#include "materials.hpp"

#include <numbers>

#include "../rve_lab/choices.hpp"
#include "../rve_lab/material_file.hpp"
#include "entries.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/random_packings.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"
#include "scarp/shape/sphere.hpp"

namespace points_library {
namespace {

using rve_lab::Preparation;

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
  entries.require_all_taken(kind);
  if (kind == "elastic") return tried(scarp::LinearElastic<Dim, scarp::GeostaticStress<Dim>>{elastic, initial});
  return tried(scarp::MohrCoulomb<Dim, scarp::GeostaticStress<Dim>>{elastic, {.strength = bounds}, initial});
}

template <class Shape>
Preparation preparation(Entries& entries) {
  Preparation choice;
  entries.take("smallest", choice.smallest);
  entries.take("largest", choice.largest);
  if constexpr (std::is_same_v<Shape, scarp::Ellipse>) entries.take("aspect", choice.aspect);
  entries.take("grains", choice.grains);
  entries.take("seed", choice.seed);
  entries.take("density", choice.density);
  if constexpr (Shape::dim == 2) entries.take("thickness", choice.thickness);
  entries.take("pressure", choice.pressure);
  entries.take("preparation-friction", choice.friction);
  return choice;
}

template <class Packing, class Grading>
Packing prepared(Preparation const& choice, scarp::LinearFrictional const& law, Grading const& grading) {
  scarp::IsotropicRecipe<Packing, Grading> const recipe{
      .cloud = {.grading = grading,
                .grains = choice.grains,
                .density = choice.density,
                .thickness = Packing::dim == 2 ? choice.thickness : 1.0},
      .preparation = {.pressure = choice.pressure, .preparation_friction = choice.friction},
      .law = law};
  auto made = recipe(choice.seed);
  if (!made.verdict.acceptable())
    scarp::reject("the packing was not prepared ({}): try another seed, pressure or stiffness",
                  scarp::name(made.verdict.reason));
  return std::move(made.packing);
}

/// grading_of(Preparation): sizes of this shape's grains
template <class Shape, class GradingOf>
scarp::AnyProvider<Shape::dim> packing(Entries& entries, rve_lab::Material const& parameters,
                                       std::filesystem::path const& file, GradingOf const& grading_of) {
  using Packing = scarp::Packing<Shape, scarp::LinearFrictional>;
  scarp::DemRve<Packing, scarp::SamePacking<Packing>> rve{
      .law = {.normal_stiffness = parameters.normal_stiffness,
              .tangential_stiffness = parameters.tangential_stiffness,
              .friction = parameters.friction}};
  entries.take("strain-per-step", rve.strain_per_step);
  entries.take("unbalanced-tolerance", rve.unbalanced_tolerance);
  if (file.empty()) {
    Preparation const choice = preparation<Shape>(entries);
    entries.require_all_taken("packing");
    rve.source.packing = prepared<Packing>(choice, rve.law, grading_of(choice));
  } else {
    entries.require_all_taken("packing from a file");
    rve.source.packing = scarp::load_packing<Packing>(file);
  }
  return tried(rve);
}

Material packing(Entries& entries, int dimension, std::filesystem::path const& folder) {
  rve_lab::Material parameters;
  std::map<std::string, bool> given;
  std::string name;
  entries.take("file", name);
  std::filesystem::path file;
  if (!name.empty()) file = folder / name;
  auto const built = rve_lab::parameters_of("linear");
  rve_lab::for_each_parameter(parameters, [&](char const* key, auto& value, char const*) {
    if (std::ranges::find(built, key) == built.end()) return;
    given[key] = entries.has(key);
    entries.take(key, value);
  });
  if (!file.empty())
    rve_lab::read_material(
        file, [&](std::string const& key) { return given[key]; }, parameters, "");
  if (parameters.law != "linear")
    scarp::reject("the law of the contacts is '{}' (linear is built): use law linear", parameters.law);
  if (dimension == 3 && parameters.shape == "sphere")
    return packing<scarp::Sphere>(entries, parameters, file, [](Preparation const& choice) {
      return scarp::SphereGrading{.smallest = choice.smallest, .largest = choice.largest};
    });
  if (dimension == 2 && parameters.shape == "disc")
    return packing<scarp::Disc>(entries, parameters, file, [](Preparation const& choice) {
      return scarp::DiscGrading{.smallest = choice.smallest, .largest = choice.largest};
    });
  if (dimension == 2 && parameters.shape == "ellipse")
    return packing<scarp::Ellipse>(entries, parameters, file, [](Preparation const& choice) {
      return scarp::EllipseGrading{.smallest = choice.smallest, .largest = choice.largest, .aspect = choice.aspect};
    });
  scarp::reject("shape is '{}' in dimension {} (disc and ellipse are built in 2, sphere in 3): choose one of these",
                parameters.shape, dimension);
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
  if (kind == "packing") return packing(entries, dimension, folder);
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
