// SPDX-License-Identifier: BSL-1.0
#include "commands.hpp"
#include "laboratory_run.hpp"
#include "packings.hpp"
#include "paths.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/rve/dem_rve.hpp"

namespace rve_lab {

namespace {

/// A packing for each point.
template <class PackingType>
struct PackingPerPoint {
  std::vector<PackingType> packings;

  PackingType const& at(scarp::Site<PackingType::dim> const& site) const {
    return packings[static_cast<std::size_t>(site.index)];
  }
};

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
    if (&file == &choice.packings.front()) choice.sand = own;
    if (of_grains(own) != of_grains(choice.sand))
      scarp::reject("'{}' has other grains or another law than '{}' (a test has one): test them one by one", file,
                    choice.packings.front());
  }
  examples::require_used(app, choice.sand);
}

bool test_packings(Laboratory& choice, scarp::RunFolder& own) {
  bool finished = false;
  with_packing(Grains{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    PackingPerPoint<PackingType> source;
    for (auto const& file : choice.packings) source.packings.push_back(scarp::load_packing<PackingType>(file));
    if (choice.packings.empty()) source.packings.push_back(Preparation<PackingType>::printed(choice.sand, law));
    int const count = static_cast<int>(source.packings.size());
    scarp::DemRve<PackingType, PackingPerPoint<PackingType>> const sand{
        .law = law, .source = std::move(source), .strain_per_step = choice.strain_step};
    auto material = examples::to_json(choice.sand);
    material["packings"] = choice.packings;
    finished = test_material<2>(choice, sand, count, own, material);
  });
  return finished;
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
  return test_packings(choice, own);
}

}  // namespace rve_lab
