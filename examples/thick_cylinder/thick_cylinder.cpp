// SPDX-License-Identifier: BSL-1.0
// Lame's stiffness and the limit pressure of a thick cylinder; the plastic ring round an opening in the ground
// (Salencon).
#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "cylinder.hpp"
#include "opening.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri6.hpp"

namespace {

template <class Element, class Scheme>
bool cylinder(char const* name, int levels, std::optional<double> gate) {
  thick_cylinder::Cylinder const steel;
  examples::Series elastic{fmt::format("Lame p/u, {}", name), steel.elastic_stiffness(), gate};
  examples::Series limit{fmt::format("Tresca limit, {}", name), steel.limit_pressure(), gate};
  for (int level = 0; level < levels; ++level) {
    auto const found = thick_cylinder::expand<Element, Scheme>(steel, 2 << level);
    elastic.outcomes.push_back(found.elastic);
    limit.outcomes.push_back(found.limit);
  }
  elastic.print();
  limit.print();
  return elastic.holds() && limit.holds();
}

template <class Element, class Scheme>
bool opening(char const* name, thick_cylinder::Opening const& ground, int levels, double gate) {
  examples::Series radius{fmt::format("plastic radius, {}", name), ground.plastic_radius() / ground.radius, gate};
  std::vector<double> errors;
  for (int level = 0; level < levels; ++level) {
    auto const found = thick_cylinder::excavate<Element, Scheme>(ground, 3 << level);
    radius.outcomes.push_back(found.outcome);
    errors.push_back(100.0 * found.stress_error);
  }
  radius.print();
  bool const near = errors.back() <= 100.0 * gate;
  examples::print(stdout, "  stresses within three radii, root of the mean square error over p0:");
  for (double const error : errors) examples::print(stdout, " {:.3f} %", error);
  examples::print(stdout, "  {} {:g} %\n", near ? "within" : "MISSES", 100.0 * gate);
  return radius.holds() && near;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace scarp;
  int levels = 4;
  double cylinder_gate = 0.5;
  double opening_gate = 2.0;
  CLI::App app{"Thick cylinder and circular opening against mesh size and run time"};
  examples::declare_version(app);
  app.add_option("--levels", levels, "meshes, each with twice as many cells along a side")->check(CLI::Range(2, 6));
  app.add_option("--max-cylinder-error", cylinder_gate, "largest error in per cent of stiffness and limit pressure")
      ->check(examples::number_from(1e-6, true, 100.0));
  app.add_option("--max-opening-error", opening_gate,
                 "largest error in per cent of the plastic radius and the stresses")
      ->check(examples::number_from(1e-6, true, 100.0));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  examples::Series::print_head();
  bool good = cylinder<Quad8, ReducedIntegration>("Quad8 reduced", levels, cylinder_gate / 100.0);
  good &= cylinder<Tri6, FullIntegration>("Tri6", levels, cylinder_gate / 100.0);
  cylinder<Quad4, BBar>("Quad4 B-bar", levels, std::nullopt);
  cylinder<Quad4, FullIntegration>("Quad4 full", levels, std::nullopt);
  good &= opening<Quad8, ReducedIntegration>("flow with friction", {}, levels, opening_gate / 100.0);
  good &= opening<Quad8, ReducedIntegration>("no dilation", {.dilation = 0.0}, levels, opening_gate / 100.0);
  return good ? 0 : 1;
}
