// SPDX-License-Identifier: BSL-1.0
// Which elements lock when the material keeps its volume? Cook's membrane with Poisson's ratio 0.4999.

#include <CLI/CLI.hpp>
#include <vector>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "membrane.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"

namespace {

using Outcomes = std::vector<cook_membrane::Outcome>;

template <class Element, class Scheme>
Outcomes solve_all(int finest, cook_membrane::Panel const& panel) {
  Outcomes outcomes;
  for (int cells = 2; cells <= finest; cells *= 2) {
    outcomes.push_back(cook_membrane::solve<Element, Scheme>(cells, panel));
  }
  return outcomes;
}

/// Limit of three values on meshes that are halved each time, if they approach it at one rate (Richardson).
double limit(Outcomes const& outcomes) {
  auto const last = outcomes.rbegin();
  double const step = last[0].deflection - last[1].deflection;
  double const before = last[1].deflection - last[2].deflection;
  return last[0].deflection + step * step / (before - step);
}

void print(char const* name, Outcomes const& outcomes, double reference) {
  for (auto const& one : outcomes) {
    examples::print(stdout, "{:<15} {:5} {:7} {:12.7f} {:8.4f} {:8.3f}\n", name, one.cells, one.dofs, one.deflection,
                    one.deflection / reference, one.seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace scarp;
  int finest = 64;
  cook_membrane::Panel panel;
  CLI::App app{"Corner deflection of Cook's membrane in plane strain against mesh size"};
  examples::declare_version(app);
  app.add_option("--finest", finest, "cells along each side of the finest mesh (a power of two)")
      ->check(CLI::Range(8, 256));
  app.add_option("--poisson", panel.poisson, "Poisson's ratio")->check(examples::number_from(0.0, true, 0.499999));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  auto const reduced = solve_all<Quad8, ReducedIntegration>(finest, panel);
  auto const mean = solve_all<Quad4, BBar>(finest, panel);
  auto const locked = solve_all<Quad4, FullIntegration>(finest, panel);
  auto const triangles = solve_all<Tri6, FullIntegration>(finest, panel);
  double const reference = limit(reduced);
  examples::print(stdout,
                  "reference: {:.7f} m (limit of Quad8 reduced); limit of Quad4 B-bar {:.7f} m, of Tri6 {:.7f} m\n",
                  reference, limit(mean), limit(triangles));
  examples::print(stdout, "{:<15} {:>5} {:>7} {:>12} {:>8} {:>8}\n", "element", "cells", "dofs", "deflection", "ratio",
                  "seconds");
  print("Quad4 full", locked, reference);
  print("Quad4 B-bar", mean, reference);
  print("Quad8 reduced", reduced, reference);
  print("Tri6 full", triangles, reference);
  // Limits of two unlike elements agree; eight cells are enough for B-bar to come within a tenth.
  bool const agree = std::abs(limit(mean) / reference - 1.0) < 0.01;
  return agree && std::abs(mean[2].deflection / reference - 1.0) < 0.1 ? 0 : 1;
}
