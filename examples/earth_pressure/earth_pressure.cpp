// SPDX-License-Identifier: BSL-1.0
// Rankine's earth pressures on a smooth wall, the steepest endless slope, the highest vertical cut in clay.
#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/version_option.hpp"
#include "cut.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"
#include "slope.hpp"
#include "wall.hpp"

namespace {

using scarp::FullIntegration;
using scarp::Quad8;
using scarp::ReducedIntegration;
using scarp::Tri6;

template <class Run>
bool block(std::string const& what, double formula, int levels, std::optional<double> gate, Run const& run) {
  examples::Series series{what, formula, gate};
  for (int level = 0; level < levels; ++level) series.outcomes.push_back(run(level));
  series.print();
  return series.holds();
}

bool walls(int levels, double gate) {
  bool good = true;
  for (bool const passive : {false, true}) {
    for (bool const rough_base : {false, true}) {
      for (double const cohesion : {0.0, 10e3}) {
        earth_pressure::Wall const wall{.cohesion = cohesion, .passive = passive, .rough_base = rough_base};
        auto const name = fmt::format("{}, c {:g} kPa, {} base", passive ? "passive" : "active", cohesion / 1e3,
                                      rough_base ? "rough" : "smooth");
        // On a smooth base the solution is exact on any mesh and the whole ground yields at once, which is slow on fine
        // ones; on a rough base the corner of wall and base is singular.
        int const meshes = rough_base ? levels : std::min(levels, 3);
        std::optional<double> wanted;
        if (!rough_base) wanted = gate;
        good &= block(name, wall.force(), meshes, wanted, [&](int level) {
          return earth_pressure::move_wall<Quad8, ReducedIntegration>(wall, 2 << level);
        });
      }
    }
  }
  return good;
}

bool slopes(int levels, double gate) {
  bool good = true;
  for (double const degrees : {20.0, 30.0, 40.0}) {
    double const friction = examples::radians(degrees);
    earth_pressure::EndlessSlope const slope{.friction = friction, .dilation = friction};
    good &= block(fmt::format("endless slope, phi {:g} deg", degrees), slope.steepest(), levels, gate,
                  [&](int level) { return earth_pressure::tilt<Quad8, ReducedIntegration>(slope, 2 << level); });
  }
  earth_pressure::EndlessSlope const coaxial{.dilation = 0.0};
  block("endless slope, phi 30 deg, psi 0", coaxial.steepest(), levels, std::nullopt,
        [&](int level) { return earth_pressure::tilt<Quad8, ReducedIntegration>(coaxial, 2 << level); });
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  int levels = 4;
  double gate = 1.0;
  double cut_gate = 2.0;
  CLI::App app{"Earth pressure, endless slope and vertical cut against mesh size and run time"};
  examples::declare_version(app);
  app.add_option("--levels", levels, "meshes, each with twice as many cells along a side")->check(CLI::Range(2, 6));
  app.add_option("--max-error", gate, "largest error in per cent of wall forces and slopes")
      ->check(examples::number_from(1e-6, true, 100.0));
  app.add_option("--max-cut-error", cut_gate,
                 "largest error in per cent of the vertical cut; twice as much on two meshes")
      ->check(examples::number_from(1e-6, true, 100.0));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  examples::Series::print_head();
  bool good = walls(levels, gate / 100.0);
  good &= slopes(levels, gate / 100.0);
  earth_pressure::VerticalCut const cut;
  int const cut_levels = std::min(levels, 3);
  good &= block("vertical cut, Quad8 reduced", cut.stability_number, cut_levels,
                cut_gate / 100.0 * (cut_levels > 2 ? 1.0 : 2.0),
                [&](int level) { return earth_pressure::load_cut<Quad8, ReducedIntegration>(cut, level); });
  block("vertical cut, Tri6", cut.stability_number, cut_levels, std::nullopt,
        [&](int level) { return earth_pressure::load_cut<Tri6, FullIntegration>(cut, level); });
  return good ? 0 : 1;
}
