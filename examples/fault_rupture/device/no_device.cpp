// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

#include "scarp/core/error.hpp"

namespace fault_rupture {

ToDevice chosen_device(Choice const&, std::size_t) {
  scarp::reject(
      "--device is given to a program without devices: start it by ./examples/run, which builds fault_rupture_device");
}

}  // namespace fault_rupture
