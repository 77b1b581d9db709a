// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

#include "../../shared/device/made_device.hpp"
#include "../../shared/study/soils.hpp"

namespace fault_rupture {

ToDevice chosen_device(Choice const& choice, std::size_t points) {
  using OnDevice = scarp::DeviceRve<decltype(Sand::provider)>;
  return [on = examples::made_device<OnDevice>(choice.device, choice.grains, points)](Sand const& sand) {
    return scarp::StiffnessFloor<OnDevice>{{sand.provider, on}, sand.share, sand.shear_modulus};
  };
}

}  // namespace fault_rupture
