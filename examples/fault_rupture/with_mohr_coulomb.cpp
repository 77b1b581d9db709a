// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, MohrCoulombFreeField const&, scarp::CheckpointFiles&, Moment);
template int run(Choice const&, MohrCoulombStickingFooting const&, scarp::CheckpointFiles&, Moment);
template int run(Choice const&, MohrCoulombFrictionalFooting const&, scarp::CheckpointFiles&, Moment);
}  // namespace fault_rupture
