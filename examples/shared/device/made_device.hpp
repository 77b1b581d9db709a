// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>

#include "device.hpp"
#ifdef EXAMPLES_CUDA
#include "scarp/cuda/cuda_device.hpp"
#endif
#include "scarp/rve/device_rve.hpp"

namespace examples {

/// The device on which packings respond.
/// \tparam OnDevice a `DeviceRve`
/// \throws scarp::InputError for a device that this program or this machine does not have
template <class OnDevice>
std::shared_ptr<typename OnDevice::Device> made_device(Device device) {
  using Types = typename OnDevice::Types;
  using Damping = typename OnDevice::Damping;
  if (device == Device::threads) return std::make_shared<scarp::ProcessorDevice<Types, Damping>>();
#ifdef EXAMPLES_CUDA
  return scarp::cuda_device<Types, Damping>();
#else
  scarp::reject("--device cuda is given to a program without CUDA: configure with -D SCARP_CUDA=ON");
#endif
}

}  // namespace examples
