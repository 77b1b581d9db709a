// SPDX-License-Identifier: BSL-1.0
// Discs without friction and observers, a hundred steps of one loose packing: no finite elements.
#include "scarp/contact/frictionless.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/disc.hpp"

int main() {
  using Grains = scarp::Packing<scarp::Disc, scarp::Frictionless>;
  scarp::Frictionless const law{.normal_stiffness = 6e6};
  scarp::Cloud<scarp::DiscGrading> const cloud{
      .grading = {.smallest = 4e-3, .largest = 6e-3}, .grains = 100, .density = 2650.0, .thickness = 0.2};
  Grains packing = cloud.make<Grains>();
  scarp::TimeStepper<Grains> stepper;
  scarp::Tensor<2> const squeeze = -1e-5 * scarp::Tensor<2>::Identity();
  for (int step = 0; step < 100; ++step) {
    if (!stepper.step(packing, law, squeeze).acceptable()) return 1;
  }
  return 0;
}
