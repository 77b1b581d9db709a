// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"
#include "clock.hpp"
#include "scarp/bvp/default_integration.hpp"
#include "scarp/bvp/pore_water.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/solver/analysis.hpp"

namespace consolidation {

/// A load on a strip of half width 1 on a half plane that drains at its surface, incompressible water. T = c_v t.
/// McNamee and Gibson, Quart. J. Mech. Appl. Math. 13 (1960) 98 and 210, transforms inverted numerically to five digits
/// (Stehfest, twelve terms; Simpson's rule over wave numbers to 60).
struct StripForms {
  double poisson = 0.0;
  std::array<double, 6>
      pressure{};  ///< excess over the load on the axis at a depth of 1, at the times of `pressure_times`
  std::array<double, 4>
      settlement{};  ///< G w/q of the middle of the surface beyond the immediate one, at those of `settlement_times`
  static constexpr std::array<double, 6> pressure_times{0.001, 0.01, 0.1, 0.5, 1.0, 5.0};
  static constexpr std::array<double, 4> settlement_times{0.01, 0.1, 1.0, 10.0};

  /// At once: \f$ u/q = \frac{2}{\pi} \arctan\frac{1}{z} \f$, that is 1/2 at a depth of 1.
  static double at_once(double depth) { return 2.0 / std::numbers::pi * std::atan(1.0 / depth); }
};
inline constexpr std::array<StripForms, 2> strips{
    {{0.0, {0.5114, 0.5358, 0.5812, 0.3417, 0.2137, 0.0548}, {0.0565, 0.17794, 0.45995, 0.81495}},
     {0.2, {0.5085, 0.5263, 0.5493, 0.3044, 0.1856, 0.0456}, {0.04176, 0.12679, 0.30439, 0.51873}}}};

/// Half of the plane, cut off at a distance, between smooth walls.
struct StripMesh {
  double distance = 60.0;
  int within = 8;        ///< cells to the edge of the load
  double growth = 1.25;  ///< of the cells beyond it, and below a depth of 1.5
  int steps = 20;        ///< of a factor of ten in time

  std::vector<double> lines(double even) const {
    std::vector<double> places;
    double const size = 1.0 / within;
    for (int k = 0; k * size < even + 0.5 * size; ++k) places.push_back(k * size);
    for (double step = growth * size; places.back() + 1.5 * step < distance; step *= growth)
      places.push_back(places.back() + step);
    places.push_back(distance);
    return places;
  }
};

struct Found {
  double at_once = 0.0;  ///< excess pressure over the load at a depth of 1
  std::vector<double> pressure{};
  std::vector<double> settlement{};
  scarp::RunReport run{};
  int dofs = 0;
  double seconds = 0.0;
};

template <class Element>
Found press(StripForms const& forms, StripMesh const& of) {
  using namespace scarp;
  examples::Stopwatch const watch;
  constexpr double young = 1e7;
  constexpr double load = 1.0;
  std::vector<double> heights = of.lines(1.5);
  std::ranges::reverse(heights);
  for (double& depth : heights) depth = of.distance - depth;
  auto mesh = examples::mesh_of_lines<Element>(of.lines(1.0), heights);
  examples::split_boundary(mesh, "top", "loaded", 1.0);
  examples::PlaneGrid<Element, DefaultIntegration<Element>> const grid(std::move(mesh));
  auto const soil = LinearElastic<2>::from_young_poisson(young, forms.poisson);
  double const shear = soil.elasticity.shear_modulus;
  double const modulus = soil.elasticity.lame_lambda + 2.0 * shear;
  Water const incompressible{.bulk_modulus = std::numeric_limits<double>::infinity()};
  ConstantPermeability const flow{incompressible.unit_weight / modulus, incompressible};  // c_v = 1

  std::array const times{0.001, 0.01, 0.1, 0.5, 1.0, 5.0, 10.0};
  Clock clock(1e-4);
  std::vector<double> ends;
  double from = 1e-4;
  for (double const time : times) {
    ends.push_back(clock.add(time, static_cast<int>(std::ceil(of.steps * std::log10(time / from)))));
    from = time;
  }
  PoreWater const sealed(grid, flow, {.shear_modulus = shear, .clock = clock.time()});
  PoreWater water = sealed;
  water.drain({"top", "loaded"});
  auto const model_with = [&](auto const& pores) {
    Model model(grid);
    model.fix({"left", "right"}, 0);
    model.fix({"bottom"});
    model.surcharge({"loaded"}, load, TimeFunction::ramp(0.0, 1.0));
    model.material("soil", soil);
    model.attach(pores);
    return model;
  };

  int below = 0;
  int middle = 0;
  Vector<2> const top(0.0, of.distance);
  for (int node = 0; node < grid.node_count(); ++node) {
    auto const& place = grid.nodes()[static_cast<std::size_t>(node)];
    if ((place - top).norm() < 1e-9) middle = node;
    if ((place - top + Vector<2>(0.0, 1.0)).norm() < 1e-9) below = node;
  }
  auto const pressure = [&](auto const& analysis) {
    return analysis.problem().template attached<decltype(water)>().pressures()[static_cast<std::size_t>(below)] / load;
  };
  auto const settlement = [&](auto const& analysis) {
    auto const k = static_cast<std::size_t>(middle);
    return shear / load * (of.distance - analysis.problem().grid().positions()[k].y());
  };
  // No water has left at once: the first step of ground that drains shows a layer of one element that has drained
  // already.
  Analysis at_once(model_with(sealed), {.stepping = by_the_clock, .threads = 1});
  Analysis analysis(model_with(water), {.stepping = by_the_clock, .threads = 1});
  Found found{.run = joined(at_once.to(1.0), analysis.to(1.0)), .dofs = analysis.problem().dof_count()};
  found.at_once = pressure(at_once);
  double const immediate = settlement(at_once);
  for (std::size_t k = 0; k < ends.size() && found.run.verdict.acceptable(); ++k) {
    found.run = joined(found.run, analysis.to(ends[k]));
    auto const is_now = [&](double time) { return time == times[k]; };
    if (std::ranges::any_of(StripForms::pressure_times, is_now)) found.pressure.push_back(pressure(analysis));
    if (std::ranges::any_of(StripForms::settlement_times, is_now))
      found.settlement.push_back(settlement(analysis) - immediate);
  }
  found.seconds = watch.seconds();
  return found;
}

}  // namespace consolidation
