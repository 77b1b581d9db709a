// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>

#include "../../shared/study/to_device.hpp"

namespace fault_rupture {

struct Choice;

/// Puts the packings of so many points on the chosen device, before they are prepared; one of two sources defines it.
/// \throws scarp::InputError for a device that this program or this machine does not have, or without room for them
ToDevice chosen_device(Choice const& choice, std::size_t points);

}  // namespace fault_rupture
