// SPDX-License-Identifier: BSL-1.0
// How fast does the surface over a fault converge in every element, and what does the step at the tip do to it?
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "elastic_ground.hpp"
#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tri6.hpp"

namespace {

using surface_orders::Step;

struct Choice {
  int rows = 16;
  double poisson = 0.0;
};

/// One element on meshes that are halved each time; true if the last halving has the element's order, but for a
/// quarter.
template <class Element>
bool block(char const* name, Eigen::MatrixXd const& exact, Choice const& choice, Step step, char const* how) {
  constexpr int order = scarp::HasMidSides<Element> ? 3 : 2;
  double before = 0.0;
  double found = 0.0;
  for (int rows = 2; rows <= choice.rows; rows *= 2) {
    double const error = surface_orders::distance(
        surface_orders::surface<Element>({.rows = rows, .poisson = choice.poisson, .step = step}), exact);
    found = before > 0.0 ? std::log2(before / error) : 0.0;
    examples::print(stdout, "{:<6} {:<10} {:5} {:12.2e} {:>6}\n", name, how, rows, error,
                    before > 0.0 ? fmt::format("{:.2f}", found) : "");
    before = error;
  }
  return found > order - 0.25;
}

bool table(Choice const& choice) {
  using namespace scarp;
  auto const exact =
      surface_orders::surface<Quad8, FullIntegration>({.rows = 4 * choice.rows, .poisson = choice.poisson});
  examples::print(stdout, "{:<6} {:<10} {:>5} {:>12} {:>6}\n", "shape", "step", "rows", "error/throw", "order");
  bool good = true;
  auto const each = [&]<class Element>(Element, char const* name) {
    good &= block<Element>(name, exact, choice, Step::moments, "moments");
  };
  each(Tri3{}, "Tri3");
  each(Quad4{}, "Quad4");
  each(Tri6{}, "Tri6");
  each(Quad8{}, "Quad8");
  each(Tet4{}, "Tet4");
  each(Hex8{}, "Hex8");
  each(Tet10{}, "Tet10");
  each(Hex20{}, "Hex20");
  block<Tri3>("Tri3", exact, choice, Step::one_facet, "one facet");
  block<Quad8>("Quad8", exact, choice, Step::one_facet, "one facet");
  block<Quad8>("Quad8", exact, choice, Step::linear, "linear");
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app{"Errors of the surface of elastic ground over a fault, against quadratic elements four times finer"};
  examples::declare_version(app);
  app.add_option("--rows", choice.rows, "of the finest mesh, a power of two")->check(CLI::IsMember({8, 16, 32}));
  app.add_option(
         "--poisson", choice.poisson,
         "ratio; above 0 the upper corners, held at the sides and free above, are singular and spoil quadratic orders")
      ->check(examples::number_from(0.0, true, 0.45));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  bool const good = table(choice);
  return good || choice.poisson > 0.0 ? 0 : 1;
}
