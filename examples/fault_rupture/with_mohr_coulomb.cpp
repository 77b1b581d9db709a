// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, MohrCoulombFreeField const&, std::chrono::steady_clock::time_point);
template int run(Choice const&, MohrCoulombStickingFooting const&, std::chrono::steady_clock::time_point);
template int run(Choice const&, MohrCoulombFrictionalFooting const&, std::chrono::steady_clock::time_point);
}  // namespace fault_rupture
