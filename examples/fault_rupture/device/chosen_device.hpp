// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../../shared/study/any_soil.hpp"

namespace fault_rupture {

/// Puts packings on the device; one of two sources defines it.
/// \throws scarp::InputError for a device that this program or this machine does not have
ToDevice chosen_device(Device device);

}  // namespace fault_rupture
