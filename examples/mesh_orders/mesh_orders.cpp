// SPDX-License-Identifier: BSL-1.0
// How fast does each element converge? A displacement wave with its body force on finer and finer bent meshes.

#include <CLI/CLI.hpp>
#include <optional>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/version_option.hpp"
#include "manufactured.hpp"
#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"

namespace {

struct Choice {
  int levels = 4;
  double distortion = 0.0;
};

/// Degree of the polynomials that an element holds. One volume change per element leaves the first order even to a
/// quadratic element.
template <class Element, class Scheme>
constexpr int degree = scarp::HasMidSides<Element> && !std::same_as<Scheme, scarp::BBar> ? 2 : 1;

/// One block of the table; true if the last refinement has the orders p + 1 and p, but for 0.25.
template <class Element, class Scheme>
bool block(char const* element, char const* integration, Choice const& choice) {
  constexpr int p = degree<Element, Scheme>;
  std::optional<mesh_orders::Outcome> last;
  mesh_orders::Orders order;
  int cells = Element::dim == 2 ? 4 : 2;
  for (int level = 0; level < choice.levels - (Element::dim - 2); ++level, cells *= 2) {
    auto const now = mesh_orders::solve<Element, Scheme>(cells, choice.distortion);
    examples::print(stdout, "{:<6} {:<8} {:8.5f} {:7} {:11.3e} {:11.3e}", element, integration, now.size, now.dofs,
                    now.error.value, now.error.gradient);
    if (last) {
      order = orders(*last, now);
      examples::print(stdout, " {:6.2f} {:6.2f}", order.value, order.gradient);
    } else {
      examples::print(stdout, "{:14}", "");
    }
    examples::print(stdout, " {:8.3f}\n", now.seconds);
    last = now;
  }
  return order.value > p + 0.75 && order.gradient > p - 0.25;
}

bool table(Choice const& choice) {
  using namespace scarp;
  examples::print(stdout, "{:<6} {:<8} {:>8} {:>7} {:>11} {:>11} {:>6} {:>6} {:>8}\n", "shape", "points", "h", "dofs",
                  "L2", "H1", "order", "order", "seconds");
  bool good = block<Tri3, FullIntegration>("Tri3", "full", choice);
  good &= block<Tri6, FullIntegration>("Tri6", "full", choice);
  good &= block<Tri6, BBar>("Tri6", "B-bar", choice);
  good &= block<Quad4, FullIntegration>("Quad4", "full", choice);
  good &= block<Quad4, BBar>("Quad4", "B-bar", choice);
  good &= block<Quad8, FullIntegration>("Quad8", "full", choice);
  good &= block<Quad8, ReducedIntegration>("Quad8", "reduced", choice);
  good &= block<Tet4, FullIntegration>("Tet4", "full", choice);
  good &= block<Tet10, FullIntegration>("Tet10", "full", choice);
  good &= block<Hex8, FullIntegration>("Hex8", "full", choice);
  good &= block<Hex8, BBar>("Hex8", "B-bar", choice);
  good &= block<Hex20, FullIntegration>("Hex20", "full", choice);
  good &= block<Hex20, ReducedIntegration>("Hex20", "reduced", choice);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app{"L2 and H1 errors of all elements for a manufactured solution of linear elasticity"};
  examples::declare_version(app);
  app.add_option("--levels", choice.levels, "meshes in the plane, each twice as fine; one fewer in space")
      ->check(CLI::Range(4, 6));
  app.add_option("--distortion", choice.distortion, "random moves of corners, as a part of the cell's size")
      ->check(examples::number_from(0.0, true, 0.2));
  app.option_defaults()->always_capture_default();
  CLI11_PARSE(app, argc, argv);
  bool const good = table(choice);
  // Random moves keep squares and cubes from becoming parallelograms: serendipity elements then lose an order.
  return good || choice.distortion > 0.0 ? 0 : 1;
}
