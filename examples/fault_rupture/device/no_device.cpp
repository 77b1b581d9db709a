// SPDX-License-Identifier: BSL-1.0
#include "device_sand.hpp"

#include "scarp/core/error.hpp"

namespace fault_rupture {

scarp::AnyProvider<2> sand_on_device(Choice const&, Sand const&) {
  scarp::reject(
      "--device is given to a program without devices: run ./examples/run, which builds fault_rupture_device");
}

}  // namespace fault_rupture
