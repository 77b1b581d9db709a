// SPDX-License-Identifier: BSL-1.0
// Microseconds per DEM step of 400 grains, the least of many short runs, and the stress that they lead to.
#include <fmt/core.h>

#include <chrono>
#include <limits>

#include "scarp/contact/linear_frictional.hpp"
#include "scarp/dem/cloud.hpp"
#include "scarp/dem/gradings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/shape/disc.hpp"
#include "scarp/shape/ellipse.hpp"

namespace {

template <class Grading>
bool measure(char const* name, Grading const& grading) {
  using Grains = scarp::Packing<typename Grading::Shape, scarp::LinearFrictional>;
  scarp::LinearFrictional const law{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  scarp::Cloud<Grading> const cloud{.grading = grading, .grains = 400, .density = 2650.0, .thickness = 0.2};
  auto const prepared = scarp::IsotropicPreparation{.pressure = 1e5}.prepare(cloud.template make<Grains>(), law);
  if (!prepared.verdict.acceptable()) return false;
  scarp::TimeStepper<Grains> stepper;
  scarp::Tensor<2> shear = scarp::Tensor<2>::Zero();
  shear(0, 1) = 1e-7;
  constexpr int steps = 1000;
  double least = std::numeric_limits<double>::infinity();
  scarp::StepObservation<2> seen;
  for (int run = 0; run < 20; ++run) {
    auto packing = prepared.packing;
    auto const started = std::chrono::steady_clock::now();
    for (int step = 0; step < steps; ++step) {
      if (!stepper.step(packing, law, shear).acceptable()) return false;
    }
    double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    least = std::min(least, seconds / steps);
    if (!stepper.observe(packing, law, seen).acceptable()) return false;
  }
  fmt::print("{} {:.3f} {:.17g}\n", name, 1e6 * least, seen.stress(0, 1));
  return true;
}

}  // namespace

int main() {
  bool const ellipses = measure("ellipses", scarp::EllipseGrading{.smallest = 4e-3, .largest = 6e-3, .aspect = 0.75});
  bool const discs = measure("discs", scarp::DiscGrading{.smallest = 4e-3, .largest = 6e-3});
  return ellipses && discs ? 0 : 1;
}
