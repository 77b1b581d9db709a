// SPDX-License-Identifier: BSL-1.0
#include "mean_curve.hpp"

#include "curve_test.hpp"
#include "packings.hpp"
#include "spheres.hpp"

namespace rve_lab {

Curve curve_of(Sand const& sand, CurveTest const& test) {
  if (is_in_space(sand)) return curve_of_spheres(sand, test);
  Curve curve;
  with_packing(Grains{}, sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    curve = tested(Preparation<PackingType>::nearest(sand, law), law, test, path_named(test.path));
  });
  return curve;
}

}  // namespace rve_lab
