// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <vector>

#include "laboratory_run.hpp"
#include "packings.hpp"
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

/// Tests the packings of the files, or one that is prepared.
/// \return whether the test came to its end
template <class... Packings>
bool test_packings(examples::Built<Packings...> grains, Laboratory const& choice, scarp::RunFolder& own) {
  bool finished = false;
  with_packing(grains, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    PackingPerPoint<PackingType> source;
    for (auto const& file : choice.packings) source.packings.push_back(scarp::load_packing<PackingType>(file));
    if (choice.packings.empty()) source.packings.push_back(Preparation<PackingType>::printed(choice.sand, law));
    int const count = static_cast<int>(source.packings.size());
    scarp::DemRve<PackingType, PackingPerPoint<PackingType>> const sand{
        .law = law, .source = std::move(source), .strain_per_step = choice.strain_step};
    auto material = examples::to_json(choice.sand);
    material["packings"] = choice.packings;
    finished = test_material<PackingType::dim>(choice, sand, count, own, material);
  });
  return finished;
}

}  // namespace rve_lab
