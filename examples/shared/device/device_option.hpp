// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../run_options.hpp"
#include "device.hpp"

namespace examples {

inline CLI::Option* declare_device(CLI::App& app, Device& device) {
  return add_named<Device>(app, "--device", device,
                           "where packings respond: none (the vector kernel), threads (the block program of cards, on "
                           "the processor) or cuda",
                           {{"none", Device::none}, {"threads", Device::threads}, {"cuda", Device::cuda}});
}

}  // namespace examples
