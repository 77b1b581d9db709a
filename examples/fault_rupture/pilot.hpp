// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/study/choice.hpp"

namespace fault_rupture {

/// Where to refine for a scene: runs it on a coarse mesh of frictional ground, which takes seconds, and takes the
/// places that this strains most into the choice.
/// \throws scarp::InputError for choices that do not make a scene, and for a run that ends before the fault moves
void run_pilot(Choice& choice);

}  // namespace fault_rupture
