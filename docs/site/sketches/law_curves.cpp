// SPDX-License-Identifier: BSL-1.0
// Normal and shear force of single contacts by scarp's laws, for sketch_laws.png:
// g++ -std=c++20 -Iinclude -isystem /usr/include/eigen3 docs/site/sketches/law_curves.cpp -lfmt -o build/law_curves &&
// build/law_curves
#include <fmt/core.h>

#include "scarp/contact/cohesive_bond.hpp"
#include "scarp/contact/hertz_mindlin.hpp"
#include "scarp/contact/linear_frictional.hpp"

namespace {

/// A contact of two spheres of 5 mm, moved in small steps: overlap and slip [m] of the path, forces [N].
template <class Law>
void trace(char const* law_name, char const* path, Law const& law, bool bonded, double from, double to,
           double slip_amplitude) {
  scarp::ContactMemory<2, double> memory;
  if constexpr (scarp::Bonds<Law>) {
    if (bonded) Law::bond(memory);
  }
  constexpr int steps = 200;
  double slip = 0.0;
  for (int k = 0; k <= steps; ++k) {
    double const part = static_cast<double>(k) / steps;
    double const overlap = from + part * (to - from);
    double const next = slip_amplitude * (part < 0.25 ? 4.0 * part : part < 0.75 ? 2.0 - 4.0 * part : 4.0 * part - 4.0);
    auto const force = law.respond(
        scarp::ContactKinematics<2, double>{
            .overlap = overlap, .slip_increment = next - slip, .reduced_radius = 2.5e-3},
        memory);
    slip = next;
    if (k % 4 == 0)
      fmt::print("{},{},{:.4g},{:.4g},{:.5g},{:.5g}\n", law_name, path, overlap, slip, force.normal, force.shear);
  }
}

}  // namespace

int main() {
  scarp::LinearFrictional const linear{.normal_stiffness = 6e6, .tangential_stiffness = 6e6, .friction = 0.55};
  auto const hertz = scarp::HertzMindlin<>::of({.modulus = 70e9, .poisson = 0.25}, 0.55);
  scarp::CohesiveBond const bond{linear, 20.0, 30.0};
  fmt::print("law,path,overlap,slip,normal_force,shear_force\n");
  double const deepest = 1e-5;
  trace("LinearFrictional", "normal", linear, false, -deepest, deepest, 0.0);
  trace("HertzMindlin", "normal", hertz, false, -deepest, deepest, 0.0);
  trace("CohesiveBond", "normal", bond, true, deepest, -deepest, 0.0);
  trace("LinearFrictional", "shear", linear, false, 5e-6, 5e-6, deepest);
  trace("HertzMindlin", "shear", hertz, false, 5e-6, 5e-6, deepest);
  trace("CohesiveBond", "shear", bond, true, 5e-6, 5e-6, deepest);
}
