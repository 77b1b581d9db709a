// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, ElasticFreeField const&, scarp::CheckpointFiles&, Moment);
template int run(Choice const&, ElasticStickingFooting const&, scarp::CheckpointFiles&, Moment);
template int run(Choice const&, ElasticFrictionalFooting const&, scarp::CheckpointFiles&, Moment);
}  // namespace fault_rupture
