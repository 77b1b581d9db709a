// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/sand/built.hpp"
#include "../shared/sand/preparation.hpp"

namespace rve_lab {

/// Each pair of shape and law costs compile time, so curved and rolling contacts come with discs only.
using Grains = examples::Built<examples::Linear<scarp::Disc>, scarp::Packing<scarp::Disc, scarp::HertzMindlin<>>,
                               scarp::Packing<scarp::Disc, examples::Rolling>, examples::Linear<scarp::Ellipse>,
                               examples::Linear<scarp::Superellipse>>;

}  // namespace rve_lab
