// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstdint>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/shape/ellipse.hpp"

namespace examples {

/// The contact law of the reference study's grains, section 3.1; its friction there is 0.55.
inline scarp::LinearFrictional study_law(double friction = 0.55) {
  return {.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = friction};
}

/// The reference study's grains: "radius between 4 mm and 6 mm" read as the semi-major axis; their aspect there is
/// 0.75.
/// aspect: semi-minor over semi-major axis
inline scarp::Cloud<scarp::EllipseGrading> study_cloud(int grains, std::uint64_t seed, double aspect = 0.75) {
  return {.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = aspect},
          .grains = grains,
          .density = 2650.0,
          .thickness = 0.2,
          .seed = seed};
}

}  // namespace examples
