// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../../shared/study/any_soil.hpp"

namespace fault_rupture {

/// The sand with its packings on the chosen device; one of two sources defines it.
/// \throws scarp::InputError for a device that this program does not have
SandOnDevice sand_on_device;

}  // namespace fault_rupture
