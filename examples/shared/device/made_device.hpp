// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <memory>

#include "device.hpp"
#ifdef EXAMPLES_CUDA
#include "scarp/cuda/cuda_device.hpp"
#endif
#include "scarp/run/resources.hpp"
#include "scarp/rve/device_rve.hpp"

namespace examples {

/// \throws scarp::InputError for a device that this program or this machine does not have
template <class Types, class Damping>
std::shared_ptr<scarp::BlockDevice<Types, Damping>> device_named(Device device) {
  if (device == Device::threads) return std::make_shared<scarp::ProcessorDevice<Types, Damping>>();
#ifdef EXAMPLES_CUDA
  return scarp::cuda_device<Types, Damping>();
#else
  scarp::reject("--device cuda is given to a program without CUDA: configure with -D SCARP_CUDA=ON");
#endif
}

/// The device on which the packings of so many points respond, each of so many grains.
/// \tparam OnDevice a `DeviceRve`
/// \throws scarp::InputError for a device that this program or this machine does not have, or that has no room for them
template <class OnDevice>
std::shared_ptr<typename OnDevice::Device> made_device(Device device, int grains, std::size_t points) {
  auto const made = device_named<typename OnDevice::Types, typename OnDevice::Damping>(device);
  constexpr int pairs_of_a_grain = 3;
  auto const room = made->room(grains, pairs_of_a_grain * grains);
  if (!room) scarp::reject("packings have {} grains (the device has no such room): take fewer grains", grains);
  constexpr std::size_t states = 2;  // committed and trial
  auto const free = made->free_bytes();
  if (auto const wanted = states * points * scarp::BlockState<typename OnDevice::Types>::bytes(*room); wanted > free) {
    scarp::reject("packings of {} grains at {} points need {} (the device has {} left): take fewer points or grains",
                  grains, points, scarp::memory_text(static_cast<double>(wanted)),
                  scarp::memory_text(static_cast<double>(free)));
  }
  return made;
}

}  // namespace examples
