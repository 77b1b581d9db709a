// SPDX-License-Identifier: BSL-1.0
// How near do finite elements come to Prandtl's and Reissner's bearing capacity factors? Rigid strip footings on
// Mohr-Coulomb soil.
#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/version_option.hpp"
#include "footing.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"

namespace {

using scarp::BBar;
using scarp::FullIntegration;
using scarp::Quad4;
using scarp::Quad8;
using scarp::ReducedIntegration;
using scarp::Tri6;

struct Choice {
  int levels = 3;
  std::vector<double> only{0.0, 10.0, 20.0, 30.0, 35.0};
  double gate = 1.0;  ///< [%]
};

/// Presses a footing into finer and finer meshes; the result is divided by `unit` to a bearing capacity factor.
template <class Element, class Scheme>
bool block(std::string const& what, strip_footing::Footing const& footing, double formula, double unit, int levels,
           std::optional<double> gate) {
  examples::Series series{what, formula, gate};
  for (int level = 0; level < levels; ++level) {
    auto pressed = strip_footing::press<Element, Scheme>(footing, {.refinements = level});
    pressed.result /= unit;
    series.outcomes.push_back(pressed);
  }
  series.print();
  return series.holds();
}

bool factors(double degrees, Choice const& choice) {
  double const friction = examples::radians(degrees);
  // A third mesh brings the coarsest error down sixfold; fewer are only for a look.
  double const gate = choice.gate / 100.0 * (choice.levels > 2 ? 1.0 : 2.5);
  bool good = true;
  for (bool const rough : {true, false}) {
    strip_footing::Footing const footing{.friction = friction, .dilation = friction, .rough = rough};
    good &= block<Quad8, ReducedIntegration>(fmt::format("Nc {:g} deg, {}", degrees, rough ? "rough" : "smooth"),
                                             footing, footing.cohesion_factor(), 1.0, choice.levels, gate);
  }
  if (degrees == 0.0) return good;
  strip_footing::Footing const loaded{
      .cohesion = 1e-3, .friction = friction, .dilation = friction, .surcharge = 1.0, .rough = false};
  good &= block<Quad8, ReducedIntegration>(fmt::format("Nq + 0.001 Nc {:g} deg, smooth", degrees), loaded,
                                           loaded.bearing_pressure(), 1.0, choice.levels, gate);
  strip_footing::Footing const flowing{.friction = friction, .dilation = 0.0};
  block<Quad8, ReducedIntegration>(fmt::format("Nc {:g} deg, rough, no dilation", degrees), flowing,
                                   flowing.cohesion_factor(), 1.0, 1, std::nullopt);
  return good;
}

/// The same footing on clay with elements that lock and others that do not.
bool elements(Choice const& choice) {
  strip_footing::Footing const clay{};
  double const exact = clay.cohesion_factor();
  block<Quad4, FullIntegration>("Nc 0 deg, rough, Quad4 full", clay, exact, 1.0, choice.levels, std::nullopt);
  block<Quad4, BBar>("Nc 0 deg, rough, Quad4 B-bar", clay, exact, 1.0, choice.levels, std::nullopt);
  block<Tri6, FullIntegration>("Nc 0 deg, rough, Tri6", clay, exact, 1.0, choice.levels, std::nullopt);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app{"Bearing capacity factors Nc and Nq against mesh size and run time"};
  examples::declare_version(app);
  app.add_option("--levels", choice.levels, "meshes, each with cells of half the size")->check(CLI::Range(1, 5));
  app.add_option("--only", choice.only, "angles of friction in degrees, a,b,c")
      ->delimiter(',')
      ->check(examples::number_from(0.0, true, 40.0));
  app.add_option("--max-error", choice.gate,
                 "largest error in per cent on the finest mesh; 2.5 times as much without a third")
      ->check(examples::number_from(0.01, true, 100.0));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  examples::Series::print_head();
  bool good = true;
  for (double const degrees : choice.only) good &= factors(degrees, choice);
  elements(choice);
  return good ? 0 : 1;
}
