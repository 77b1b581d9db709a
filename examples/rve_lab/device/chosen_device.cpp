// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

#include <utility>

#include "../../shared/device/made_device.hpp"

namespace rve_lab {

template <class PackingType>
ToDevice<PackingType> chosen_device(Device device, int grains, std::size_t points) {
  using OnDevice = scarp::DeviceRve<Tested<PackingType>>;
  return [on = examples::made_device<OnDevice>(device, grains, points)](Tested<PackingType> sand) {
    return OnDevice{std::move(sand), on};
  };
}

template ToDevice<Discs> chosen_device<Discs>(Device, int, std::size_t);
template ToDevice<Ellipses> chosen_device<Ellipses>(Device, int, std::size_t);

}  // namespace rve_lab
