// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, SandFreeField const&, std::chrono::steady_clock::time_point);
template int run(Choice const&, SandStickingFooting const&, std::chrono::steady_clock::time_point);
template int run(Choice const&, SandFrictionalFooting const&, std::chrono::steady_clock::time_point);
}  // namespace fault_rupture
