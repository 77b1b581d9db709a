// SPDX-License-Identifier: BSL-1.0
// The reference study's ellipses, a hundred steps of one loose packing: no finite elements.
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/shape/ellipse.hpp"

int main() {
  using Grains = scarp::Packing<scarp::Ellipse, scarp::LinearFrictional>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  scarp::Cloud<scarp::EllipseGrading> const cloud{.grading = {.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75},
                                                  .grains = 100,
                                                  .density = 2650.0,
                                                  .thickness = 0.2};
  Grains packing = cloud.make<Grains>();
  scarp::TimeStepper<Grains> stepper;
  scarp::Tensor<2> const squeeze = -1e-5 * scarp::Tensor<2>::Identity();
  for (int step = 0; step < 100; ++step) {
    if (!stepper.step(packing, law, squeeze).acceptable()) return 1;
  }
  return 0;
}
