// SPDX-License-Identifier: BSL-1.0
#include "commands.hpp"
#include "laboratory_run.hpp"
#include "packing_test.hpp"
#include "paths.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "spheres.hpp"

namespace rve_lab {

namespace {

/// The shape and law of the packings' files, which are to be one.
/// \throws InputError for packings of different grains or laws, and for options that their law has no use for
void read_sands(CLI::App const& app, Laboratory& choice) {
  Sand const before = choice.sand;
  auto const of_grains = [](Sand const& sand) {
    auto const json = examples::to_json(sand);
    nlohmann::json own;
    for (auto const* name : examples::grain_options)
      if (json.contains(name)) own[name] = json[name];
    return own;
  };
  for (auto const& file : choice.packings) {
    auto const own = examples::sand_of_packing(file, before, examples::given_in(app));
    examples::print_notes(examples::other_than_prepared(file, own));
    if (&file == &choice.packings.front()) choice.sand = own;
    if (of_grains(own) != of_grains(choice.sand))
      scarp::reject("'{}' has other grains or another law than '{}' (a test has one): test them one by one", file,
                    choice.packings.front());
  }
  examples::require_used(app, choice.sand);
}

template <int Dim>
bool test_continuum(Laboratory const& choice, scarp::RunFolder& own) {
  auto const elasticity = scarp::IsotropicElasticity::from_young_poisson(choice.young, choice.poisson);
  scarp::GeostaticStress<Dim> const start{.surcharge = choice.sand.pressure};
  nlohmann::json material{{"young", choice.young}, {"poissons_ratio", choice.poisson}};
  if (choice.provider == "elastic")
    return test_material<Dim>(choice, scarp::LinearElastic<Dim, scarp::GeostaticStress<Dim>>{elasticity, start}, 1, own,
                              material);
  material.update(
      {{"friction_angle", choice.friction}, {"dilation_angle", choice.dilation}, {"cohesion", choice.cohesion}});
  return test_material<Dim>(
      choice,
      scarp::MohrCoulomb<Dim, scarp::GeostaticStress<Dim>>{
          elasticity,
          {{.cohesion = choice.cohesion, .friction = choice.friction * degree, .dilation = choice.dilation * degree}},
          start},
      1, own, material);
}

}  // namespace

bool test(Laboratory& choice, CLI::App const& app) {
  require_used(app, choice);
  auto own = folder_of(choice.output, app, {"test.csv", "summary.json"});
  if (!choice.is_packing())
    return choice.dimension == 2 ? test_continuum<2>(choice, own) : test_continuum<3>(choice, own);
  if (choice.packings.empty()) {
    read_sand_file(choice, app);
  } else {
    read_sands(app, choice);
  }
  return is_in_space(choice.sand) ? test_spheres(choice, own) : test_packings(Grains{}, choice, own);
}

}  // namespace rve_lab
