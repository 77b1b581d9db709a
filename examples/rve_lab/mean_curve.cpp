// SPDX-License-Identifier: BSL-1.0
#include "mean_curve.hpp"

#include "curve_test.hpp"
#include "packings.hpp"
#include "spheres.hpp"

namespace rve_lab {

Curve curve_of(Sand const& sand, CurveTest const& test) {
  if (is_in_space(sand)) return curve_of_spheres(sand, test);
  return curve_of_built(Grains{}, sand, test, path_named(test.path));
}

}  // namespace rve_lab
