// SPDX-License-Identifier: BSL-1.0
#include "preparation.hpp"

namespace rve_lab {

template struct Preparation<Discs>;
template struct Preparation<HertzianDiscs>;
template struct Preparation<RollingDiscs>;
template struct Preparation<Ellipses>;
template struct Preparation<Superellipses>;

}  // namespace rve_lab
