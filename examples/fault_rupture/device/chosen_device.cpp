// SPDX-License-Identifier: BSL-1.0
#include "chosen_device.hpp"

#include "../../shared/study/soils.hpp"
#include "scarp/run/resources.hpp"
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

ToDevice chosen_device(Choice const& choice, std::size_t points) {
  auto const on = made(choice.device);
  constexpr int pairs_of_a_grain = 3;
  auto const state =
      scarp::BlockState<OnDevice::Types>::bytes(on->room(choice.grains, pairs_of_a_grain * choice.grains));
  if (auto const wanted = 2 * points * state; wanted > on->free_bytes()) {  // committed and trial states
    scarp::reject(
        "the packings of {} points need {} of the card (it has {} left): choose a larger --size, fewer --elements or "
        "fewer --grains",
        points, scarp::memory_text(static_cast<double>(wanted)),
        scarp::memory_text(static_cast<double>(on->free_bytes())));
  }
  return [on](Sand const& sand) {
    return scarp::StiffnessFloor<OnDevice>{{sand.provider, on}, sand.share, sand.shear_modulus};
  };
}

}  // namespace fault_rupture
