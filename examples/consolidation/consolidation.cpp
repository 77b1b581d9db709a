// SPDX-License-Identifier: BSL-1.0
// Settlement and pore pressure of saturated ground in time: Terzaghi's column, and a strip load on a half plane
// (McNamee and Gibson).
#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/convergence_table.hpp"
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "column.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#include "strip.hpp"

namespace {

template <class Element>
bool column(char const* name, consolidation::Column const& column, double gate) {
  auto const found = consolidation::consolidate<Element>(column);
  examples::print(stdout, "column, {:<11} {} rows, {} steps a stage: {} iterations in {} steps\n", name, column.rows,
                  column.steps, found.run.iterations, found.run.steps);
  examples::print(stdout, "  excess pressure over the load after T = {:g}: {:.4f} to {:.4f}\n", column.first,
                  found.least, found.most);
  double worst = found.run.verdict.acceptable() ? 0.0 : 1.0;
  for (auto const& stage : found.stages) {
    double const exact = consolidation::Column::degree(stage.time_factor);
    examples::print(stdout, "  T {:<6g} U {:.5f} (formula {:.5f})  pressure error {:.2e}  water lost {:.0e}\n",
                    stage.time_factor, stage.degree, exact, stage.pressure_error, stage.water_lost);
    if (stage.time_factor >= 0.1) worst = std::max({worst, stage.pressure_error, std::abs(stage.degree - exact)});
  }
  bool const near = worst <= gate;
  examples::print(stdout, "  largest error from T = 0.1 on {:.2e}, {} {:g}\n", worst, near ? "within" : "MISSES", gate);
  return near;
}

bool strip(consolidation::StripForms const& forms, consolidation::StripMesh const& mesh, double gate) {
  auto const found = consolidation::press<scarp::Quad8>(forms, mesh);
  examples::print(stdout, "strip, Poisson's ratio {:g}: {} unknowns, {} steps, {} iterations, {:.1f} s\n",
                  forms.poisson, found.dofs, found.run.steps, found.run.iterations, found.seconds);
  double const at_once = consolidation::StripForms::at_once(1.0);
  double worst = found.run.verdict.acceptable() ? std::abs(found.at_once - at_once) : 1.0;
  examples::print(stdout, "  at once     u/q {:.4f} (formula {:.4f})\n", found.at_once, at_once);
  for (std::size_t k = 0; k < found.pressure.size(); ++k) {
    examples::print(stdout, "  T {:<8g}  u/q {:.4f} (formula {:.4f})\n", forms.pressure_times[k], found.pressure[k],
                    forms.pressure[k]);
    worst = std::max(worst, std::abs(found.pressure[k] - forms.pressure[k]));
  }
  for (std::size_t k = 0; k < found.settlement.size(); ++k) {
    examples::print(stdout, "  T {:<8g}  G w/(q a) {:.4f} (formula {:.4f})\n", forms.settlement_times[k],
                    found.settlement[k], forms.settlement[k]);
    worst = std::max(worst, std::abs(found.settlement[k] - forms.settlement[k]));
  }
  bool const near = worst <= gate;
  examples::print(stdout, "  largest error {:.2e}, {} {:g}\n", worst, near ? "within" : "MISSES", gate);
  return near;
}

}  // namespace

int main(int argc, char** argv) {
  consolidation::Column of_column;
  consolidation::StripMesh of_strip;
  double column_gate = 6e-3;
  double strip_gate = 0.02;
  bool column_only = false;
  CLI::App app{"Consolidation of a column and below a strip load against closed forms"};
  examples::declare_version(app);
  app.add_option("--rows", of_column.rows, "elements of the column")->check(CLI::Range(2, 1000));
  app.add_option("--steps", of_column.steps, "time steps of each of the column's stages")->check(CLI::Range(2, 10000));
  app.add_option("--first", of_column.first, "time factor of the column's first step")
      ->check(examples::number_from(1e-12, true, 1e-2));
  app.add_option("--strip-cells", of_strip.within, "cells from the middle of the strip to its edge")
      ->check(CLI::Range(2, 64));
  app.add_option("--strip-steps", of_strip.steps, "time steps of the strip per factor of ten")
      ->check(CLI::Range(1, 1000));
  app.add_option("--distance", of_strip.distance, "of the mesh's end below the strip, in half widths")
      ->check(examples::number_from(5.0, true, 200.0));
  app.add_option("--max-column-error", column_gate,
                 "largest error of pressures and degrees of consolidation from T = 0.1 on")
      ->check(examples::number_from(1e-9, true, 1.0));
  app.add_option("--max-strip-error", strip_gate, "largest error of pressures over the load and of G w/(q a)")
      ->check(examples::number_from(1e-9, true, 1.0));
  app.add_flag("--column-only", column_only, "leave out the strip");
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  bool good = column<scarp::Tri6>("Tri6", of_column, column_gate);
  good &= column<scarp::Quad8>("Quad8", of_column, column_gate);
  good &= column<scarp::Quad4>("Quad4 B-bar", of_column, column_gate);
  good &= column<scarp::Tri3>("Tri3", of_column, column_gate);
  for (auto const& forms : consolidation::strips) {
    if (!column_only) good &= strip(forms, of_strip, strip_gate);
  }
  return good ? 0 : 1;
}
