// SPDX-License-Identifier: BSL-1.0
// Rigid footings on springs and on elastic ground, blocks that become rigid, blocks that slide down an incline.
#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "block.hpp"

namespace {

using rigid_on_elastic::Layer;
using rigid_on_elastic::Motion;

/// A settlement and a tilt beside what they should be, one row each.
bool compare(std::string const& what, Motion const& found, Motion const& wanted, std::optional<double> gate) {
  bool good = true;
  for (bool const tilts : {false, true}) {
    examples::Series row{fmt::format("{}, {}", what, tilts ? "tilt" : "settlement"),
                         tilts ? wanted.tilt : wanted.settlement, gate};
    row.outcomes = {found.outcome};
    row.outcomes.front().result = tilts ? found.tilt : found.settlement;
    row.print();
    good &= row.holds();
  }
  return good;
}

bool winkler() {
  Layer const layer{.rigid = true};
  double const k = 50e6;
  scarp::LinearFrictional const springs{.normal_stiffness = k, .tangential_stiffness = k, .friction = 0.5};
  // Settlement W/(k B), tilt M/(k B^3/12): Winkler.
  Motion const exact{layer.force / (k * layer.width), 12.0 * layer.moment / (k * std::pow(layer.width, 3))};
  return compare("Winkler's bed", rigid_footing(layer, springs, true), exact, 1e-6);
}

/// The stiffer the interface, the nearer to nodes that move as one body.
bool elastic_layer(int levels) {
  bool good = true;
  for (int level = 0; level < levels; ++level) {
    Layer const layer{.cells = 8 << level};
    auto const tied = tied_nodes(layer);
    examples::print(stdout, "footing on the layer, {} cells below it, interface k = x E/B, against tied nodes\n",
                    layer.cells);
    for (double const factor : {1e2, 1e3, 1e4, 1e5}) {
      auto const law = rigid_on_elastic::bonded(factor * layer.young / layer.width);
      std::optional<double> gate;
      if (factor == 1e5) gate = 1e-3;
      good &= compare(fmt::format("  x = {:g}", factor), rigid_footing(layer, law, false), tied, gate);
    }
  }
  return good;
}

bool stiff_block(int levels) {
  bool good = true;
  for (int level = 0; level < levels; ++level) {
    Layer const layer{.cells = 8 << level};
    auto const law = rigid_on_elastic::bonded(1e3 * layer.young / layer.width);
    auto const rigid = rigid_footing(layer, law, true);
    examples::print(stdout, "elastic block on the layer, {} cells below it, against the rigid footing\n", layer.cells);
    for (double const contrast : {1e3, 1e4, 1e5, 1e6}) {
      std::optional<double> gate;
      if (contrast == 1e6) gate = 1e-3;
      good &= compare(fmt::format("  contrast {:g}", contrast), elastic_block(layer, contrast, law), rigid, gate);
    }
  }
  return good;
}

bool incline(int levels, double gate) {
  bool good = true;
  for (double const friction : {0.2, 0.5, 0.8}) {
    examples::Series series{fmt::format("block slides, mu {:g}", friction), friction, gate};
    for (int level = 0; level < levels; ++level)
      series.outcomes.push_back(rigid_on_elastic::slide(friction, 4 << level));
    series.print();
    good &= series.holds();
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  int levels = 3;
  double gate = 0.1;
  CLI::App app{"Rigid and stiff footings on springs, on elastic ground and on an incline"};
  examples::declare_version(app);
  app.add_option("--levels", levels, "meshes, each with twice as many cells along a side")->check(CLI::Range(1, 5));
  app.add_option("--max-slide-error", gate, "largest error in per cent of the tangent at which a block slides")
      ->check(examples::number_from(1e-6, true, 100.0));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  examples::Series::print_head();
  bool good = winkler();
  good &= elastic_layer(levels);
  good &= stiff_block(levels);
  good &= incline(levels, gate / 100.0);
  return good ? 0 : 1;
}
