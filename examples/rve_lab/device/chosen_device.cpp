// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

#include <utility>

#include "../../shared/device/made_device.hpp"

namespace rve_lab {

template <class PackingType>
ToDevice<PackingType> chosen_device(Device device) {
  using OnDevice = scarp::DeviceRve<Tested<PackingType>>;
  return [on = examples::made_device<OnDevice>(device)](Tested<PackingType> sand) {
    return OnDevice{std::move(sand), on};
  };
}

template ToDevice<Discs> chosen_device<Discs>(Device);
template ToDevice<Ellipses> chosen_device<Ellipses>(Device);

}  // namespace rve_lab
