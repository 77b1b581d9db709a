// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, SandFreeField const&, scarp::CheckpointFiles&, Moment);
template int run(Choice const&, SandStickingFooting const&, scarp::CheckpointFiles&, Moment);
template int run(Choice const&, SandFrictionalFooting const&, scarp::CheckpointFiles&, Moment);
}  // namespace fault_rupture
