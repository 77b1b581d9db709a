// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laboratory_run.hpp"
#include "preparation.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "scarp/rve/dem_rve.hpp"

namespace rve_lab {

/// A packing for each point.
template <class PackingType>
struct PackingPerPoint {
  std::vector<PackingType> packings;

  PackingType const& at(scarp::Site<PackingType::dim> const& site) const {
    return packings[static_cast<std::size_t>(site.index)];
  }
};

/// The material of the packings' files, which is to be one.
/// \throws InputError for packings of different materials
inline void read_materials(CLI::App const& app, Laboratory& choice) {
  auto const given = [&](std::string const& name) { return is_given(app, name); };
  Material const before = choice.grains;
  for (auto const& file : choice.packings) {
    Material own = before;
    read_material(file, given, own);
    if (&file == &choice.packings.front()) choice.grains = own;
    if (to_json(own) != to_json(choice.grains))
      scarp::reject("'{}' is of another material than '{}' (a test has one): test them one by one", file,
                    choice.packings.front());
  }
}

inline bool test_packings(Laboratory& choice, scarp::RunFolder& own) {
  bool finished = false;
  with_material(choice.grains, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    PackingPerPoint<PackingType> source;
    for (auto const& file : choice.packings) source.packings.push_back(scarp::load_packing<PackingType>(file));
    if (choice.packings.empty()) source.packings.push_back(prepare_packing<PackingType>(choice.preparation, law));
    int const count = static_cast<int>(source.packings.size());
    scarp::DemRve<PackingType, PackingPerPoint<PackingType>> const sand{
        .law = law, .source = std::move(source), .strain_per_step = choice.strain_step};
    auto material = to_json(choice.grains);
    material["packings"] = choice.packings;
    finished = test_material<2>(choice, sand, count, own, material);
  });
  return finished;
}

template <int Dim>
bool test_continuum(Laboratory const& choice, scarp::RunFolder& own) {
  auto const elasticity = scarp::IsotropicElasticity::from_young_poisson(choice.young, choice.poisson);
  scarp::GeostaticStress<Dim> const start{.surcharge = choice.preparation.pressure};
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

/// Tests a material as a laboratory does.
/// \return whether the test came to its end
inline bool test(Laboratory& choice, CLI::App const& app, scarp::RunFolder own) {
  if (!choice.is_packing())
    return choice.dimension == 2 ? test_continuum<2>(choice, own) : test_continuum<3>(choice, own);
  read_materials(app, choice);
  require_used(app, choice.grains);
  return test_packings(choice, own);
}

}  // namespace rve_lab
