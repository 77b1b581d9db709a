// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

#include "../../shared/study/soils.hpp"
#ifdef FAULT_RUPTURE_CUDA
#include "scarp/cuda/cuda_device.hpp"
#endif
#include "scarp/rve/device_rve.hpp"

namespace fault_rupture {

namespace {

using OnDevice = scarp::DeviceRve<decltype(Sand::provider)>;

std::shared_ptr<OnDevice::Device> made(Device device) {
  if (device == Device::threads) return std::make_shared<scarp::ProcessorDevice<OnDevice::Types, OnDevice::Damping>>();
#ifdef FAULT_RUPTURE_CUDA
  return scarp::cuda_device<OnDevice::Types, OnDevice::Damping>();
#else
  scarp::reject("--device cuda is given to a program without CUDA: configure with -D SCARP_CUDA=ON");
#endif
}

}  // namespace

ToDevice chosen_device(Device device) {
  return [on = made(device)](Sand const& sand) {
    return scarp::StiffnessFloor<OnDevice>{{sand.provider, on}, sand.share, sand.shear_modulus};
  };
}

}  // namespace fault_rupture
