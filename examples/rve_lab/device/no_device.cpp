// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

namespace rve_lab {

template <class PackingType>
ToDevice<PackingType> chosen_device(Device, int, std::size_t) {
  scarp::reject(
      "--device is given to a program without devices: start it by ./examples/run, which builds rve_lab_device");
}

template ToDevice<Discs> chosen_device<Discs>(Device, int, std::size_t);
template ToDevice<Ellipses> chosen_device<Ellipses>(Device, int, std::size_t);

}  // namespace rve_lab
