// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, Scene<RigidFooting> const&, Start const&);
}  // namespace fault_rupture
