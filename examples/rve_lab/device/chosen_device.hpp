// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include "../packings.hpp"
#include "scarp/points/any_provider.hpp"
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

/// Packings that are tested.
template <class PackingType>
using Tested = scarp::DemRve<PackingType, PackingPerPoint<PackingType>>;

/// Puts the packings of a test where they respond.
template <class PackingType>
using ToDevice = std::function<scarp::AnyProvider<PackingType::dim>(Tested<PackingType>)>;

/// Whether packings are compiled for devices: each kind of grains costs kernels.
template <class PackingType>
inline constexpr bool runs_on_devices = std::is_same_v<PackingType, Discs> || std::is_same_v<PackingType, Ellipses>;

/// Puts the packings of so many points on the device; one of two sources defines it.
/// \throws scarp::InputError for a device that this program or this machine does not have, or that has no room for them
template <class PackingType>
ToDevice<PackingType> chosen_device(Device device, int grains, std::size_t points);

}  // namespace rve_lab
