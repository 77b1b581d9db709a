// SPDX-License-Identifier: BSL-1.0
#include "run_scene.hpp"

namespace fault_rupture {
template int run(Choice const&, Scene<SlidingFooting> const&, Start const&);
template std::vector<scarp::Vector<2>> strained_by(Choice const&, Scene<SlidingFooting> const&);
}  // namespace fault_rupture
