// SPDX-License-Identifier: BSL-1.0
#include "spheres.hpp"

#include "curve_test.hpp"
#include "packing_output.hpp"
#include "packing_test.hpp"
#include "preparation.hpp"

namespace rve_lab {

void prepare_spheres(Test const& choice, scarp::RunFolder& own) {
  with_packing(Spheres{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    write_packing(choice, own, Preparation<PackingType>::printed(choice.sand, law), law);
  });
}

bool test_spheres(Laboratory const& choice, scarp::RunFolder& own) { return test_packings(Spheres{}, choice, own); }

Curve curve_of_spheres(Sand const& sand, CurveTest const& test) {
  return curve_of_built(Spheres{}, sand, test, triaxial_path());
}

}  // namespace rve_lab
