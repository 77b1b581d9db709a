// SPDX-License-Identifier: BSL-1.0
// What does one DEM step of 400 grains cost for each shape with each contact law?
#include "kernel_steps.hpp"

namespace {

using namespace scarp_benchmark;

template <class Shape>
void declare_laws(std::string const& name) {
  using scarp::LinearFrictional;
  using scarp::Packing;
  declare_steps<Packing<Shape, scarp::Frictionless>>(name + "/frictionless/double", {400});
  declare_steps<Packing<Shape, LinearFrictional>>(name + "/linear_frictional/double", {400});
  declare_steps<Packing<Shape, scarp::HertzMindlin<>>>(name + "/hertz_mindlin/double", {400});
  declare_steps<Packing<Shape, scarp::RollingResistance<LinearFrictional>>>(name + "/rolling_resistance/double", {400});
  declare_steps<Packing<Shape, scarp::CohesiveBond<LinearFrictional>>>(name + "/cohesive_bond/double", {400});
}

}  // namespace

int main(int argc, char** argv) {
  declare_laws<scarp::Disc>("disc");
  declare_laws<scarp::Ellipse>("ellipse");
  declare_laws<scarp::Superellipse>("superellipse");
  declare_laws<scarp::Dumbbell>("dumbbell");
  declare_laws<scarp::Sphere>("sphere");
  return run(argc, argv, "rve_shapes_and_laws");
}
