// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "device/chosen_device.hpp"
#include "laboratory_run.hpp"
#include "packings.hpp"
#include "scarp/io/packings/packing_file.hpp"

namespace rve_lab {

/// \throws InputError for grains that no device takes, and for a device that this program or this machine does not have
template <class PackingType>
ToDevice<PackingType> to_device(Laboratory const& choice) {
  if (choice.device == Device::none) return [](Tested<PackingType> sand) { return sand; };
  if constexpr (runs_on_devices<PackingType>) {
    return chosen_device<PackingType>(choice.device, choice.sand.grains,
                                      std::max(choice.packings.size(), static_cast<std::size_t>(choice.seeds)));
  } else {
    scarp::reject(
        "--device is given for '{}' grains with law '{}' (devices have disc linear and ellipse linear): choose one of "
        "these, or leave --device out",
        choice.sand.shape, choice.sand.law);
  }
}

/// Tests the packings of the files, or those that are prepared.
/// \return whether the test came to its end
template <class... Packings>
bool test_packings(examples::Built<Packings...> grains, Laboratory const& choice, scarp::RunFolder& own) {
  bool finished = false;
  with_packing(grains, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    auto const onto = to_device<PackingType>(choice);
    auto material = examples::to_json(choice.sand);
    material["packings"] = choice.packings;
    PackingPerPoint<PackingType> source;
    for (auto const& file : choice.packings) source.packings.push_back(scarp::load_packing<PackingType>(file));
    if (choice.packings.empty() && choice.seeds == 1)
      source.packings.push_back(Preparation<PackingType>::printed(choice.sand, law));
    if (choice.packings.empty() && choice.seeds > 1) {
      std::vector<std::uint64_t> seeds;
      for (int k = 0; k < choice.seeds; ++k) seeds.push_back(seed_of(choice.sand, k));
      source.packings = Preparation<PackingType>::of_seeds(choice.sand, law, seeds, choice.threads_for(choice.seeds));
      material["seeds"] = seeds;
    }
    int const count = static_cast<int>(source.packings.size());
    Tested<PackingType> sand{.law = law, .source = std::move(source), .strain_per_step = choice.strain_step};
    finished = test_material<PackingType::dim>(choice, onto(std::move(sand)), count, own, material);
  });
  return finished;
}

}  // namespace rve_lab
