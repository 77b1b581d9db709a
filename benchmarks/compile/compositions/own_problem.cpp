// SPDX-License-Identifier: BSL-1.0
// A strip on Mohr-Coulomb ground, loaded in steps.
#include "scarp/constitutive/mohr_coulomb.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/analysis.hpp"

using Soil = scarp::MohrCoulomb<2, scarp::GeostaticStress<2>>;

int main() {
  scarp::Model model(scarp::BoxMesh<scarp::Quad4>{.lengths = {10.0, 5.0}, .cells = {20, 10}}.generate());
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"});
  model.gravity(18e3);
  model.surcharge({"top"}, 30e3, scarp::TimeFunction::ramp(1.0, 2.0));
  model.material("soil", Soil{.elasticity = scarp::IsotropicElasticity::from_young_poisson(25e6, 0.25),
                              .strength = {{.cohesion = 5e3, .friction = 0.5}},
                              .initial = model.geostatic(0.5)});
  scarp::Analysis analysis(model, {.threads = 1});
  return analysis.to(2.0).verdict.acceptable() ? 0 : 1;
}
