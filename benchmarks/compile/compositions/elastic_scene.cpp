// SPDX-License-Identifier: BSL-1.0
// Linear elastic ground over a fault.
#include <fmt/core.h>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/solver/thread_executor.hpp"

int main() {
  using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  scarp::FreeFieldFault<Soil> scene;
  scene.soil = Soil::from_young_poisson(20e6, 0.3, {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4});
  scene.throw_to = 0.25;  // [m]

  scarp::ThreadExecutor executor;
  scarp::NoObserver nobody;
  auto problem = scene.problem(executor);
  auto report = scene.settle(problem, nobody);
  if (report.verdict.acceptable()) report = scene.rupture(problem, nobody);
  fmt::print("{}: throw {} m\n", name(report.verdict.status), report.load);
  return report.verdict.acceptable() ? 0 : 1;
}
