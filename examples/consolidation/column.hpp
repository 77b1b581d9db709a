// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "clock.hpp"
#include "scarp/bvp/pore_water.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/analysis.hpp"

namespace consolidation {

/// Terzaghi's column of height 1 on an impermeable base under a load on its drained top, with incompressible water.
/// T = c_v t/h^2, c_v = k M/gamma_w; Terzaghi, Theoretical Soil Mechanics (1943), ch. 13.
struct Column {
  double load = 1.0;                                       ///< on the top [Pa]
  double modulus = 1e6;                                    ///< M, constrained, without Poisson's effect [Pa]
  double mobility = 1e-9;                                  ///< k/mu [m2/(Pa s)]
  double first = 1e-4;                                     ///< T of the first step
  int rows = 20;                                           ///< of elements, as wide as high
  int steps = 40;                                          ///< of each stage
  std::vector<double> stages{0.01, 0.1, 0.197, 0.5, 1.0};  ///< T at their ends

  double consolidation() const { return mobility * modulus; }  ///< c_v [m2/s]

  /// \f$ u/q = \sum_j \frac{4}{(2j-1)\pi} (-1)^{j-1} \cos\frac{(2j-1)\pi z}{2}\,e^{-(2j-1)^2\pi^2 T/4} \f$, z from the
  /// base
  static double pressure(double time_factor, double height) {
    return sum(time_factor, [&](double root, double sign) { return sign * 2.0 / root * std::cos(root * height); });
  }
  /// Degree of consolidation \f$ U = 1 - \sum_j \frac{8}{(2j-1)^2\pi^2} e^{-(2j-1)^2\pi^2 T/4} \f$.
  static double degree(double time_factor) {
    return 1.0 - sum(time_factor, [](double root, double) { return 2.0 / (root * root); });
  }

 private:
  template <class Term>
  static double sum(double time_factor, Term const& term) {
    double total = 0.0;
    for (int j = 1; j < 2000; ++j) {
      double const root = (2 * j - 1) * std::numbers::pi / 2.0;
      total += term(root, j % 2 == 1 ? 1.0 : -1.0) * std::exp(-root * root * time_factor);
    }
    return total;
  }
};

/// A column at the end of a stage.
struct Consolidated {
  double time_factor = 0.0;
  double pressure_error = 0.0;  ///< largest of any corner, over the load
  double degree = 0.0;          ///< mean settlement of the top over that at the end
  double water_lost = 0.0;      ///< volume of the settlement less that of the expelled water, over the former
};
struct ColumnRun {
  std::vector<Consolidated> stages{};
  double most = 0.0;  ///< excess pressure after the first step in which time passes, over the load
  double least = 0.0;
  scarp::RunReport run{};
};

template <class Element, class Motion = scarp::SmallStrain>
ColumnRun consolidate(Column const& column) {
  using namespace scarp;
  double const width = 1.0 / column.rows;
  Discretisation<Element, Motion> const grid(
      BoxMesh<Element>{.lengths = Vector<2>(width, 1.0), .cells = {1, column.rows}}.generate());
  Clock clock(column.first / column.consolidation());
  std::vector<double> ends;
  for (double const stage : column.stages) ends.push_back(clock.add(stage / column.consolidation(), column.steps));

  Water const incompressible{.bulk_modulus = std::numeric_limits<double>::infinity()};
  ConstantPermeability const flow{column.mobility * incompressible.unit_weight, incompressible};
  PoreWater water(grid, flow, {.shear_modulus = column.modulus / 2.0, .clock = clock.time()});
  water.drain({"top"});
  Model model(grid);
  model.fix({"left", "right"}, 0);
  model.fix({"bottom"}, 1);
  model.surcharge({"top"}, column.load, TimeFunction::ramp(0.0, 1.0));
  model.material("soil", LinearElastic<2>::from_young_poisson(column.modulus, 0.0));
  model.attach(water);
  Analysis analysis(model, {.stepping = by_the_clock, .threads = 1});

  using Pores = decltype(water);
  auto const pressures = [&] { return analysis.problem().template attached<Pores>().pressures(); };
  auto const at_top = grid.boundary_nodes("top");
  ColumnRun result;
  result.run = analysis.to(2.0);
  auto const after_first = pressures();
  result.most = *std::max_element(after_first.begin(), after_first.end()) / column.load;
  result.least = *std::min_element(after_first.begin(), after_first.end()) / column.load;
  for (std::size_t stage = 0; stage < ends.size() && result.run.verdict.acceptable(); ++stage) {
    result.run = joined(result.run, analysis.to(ends[stage]));
    Consolidated now{.time_factor = column.stages[stage]};
    auto const found = pressures();
    for (auto const& element : grid.mesh().elements) {
      for (int a = 0; a < LinearOf<Element>::nodes; ++a) {
        auto const node = static_cast<std::size_t>(element[static_cast<std::size_t>(a)]);
        double const exact = Column::pressure(now.time_factor, grid.nodes()[node].y());
        now.pressure_error = std::max(now.pressure_error, std::abs(found[node] / column.load - exact));
      }
    }
    auto const& moved = analysis.problem().grid().positions();
    Eigen::VectorXd const per_length =
        grid.traction("top", {0.0, 1.0 / width});  // N of a traction: means of the settlement
    double settlement = 0.0;
    for (int const node : at_top) {
      auto const k = static_cast<std::size_t>(node);
      settlement -= per_length(2 * node + 1) * (moved[k].y() - grid.nodes()[k].y());
    }
    now.degree = settlement * column.modulus / column.load;
    double const expelled = analysis.problem().template attached<Pores>().expelled();
    now.water_lost = std::abs(settlement * width - expelled) / expelled;
    result.stages.push_back(now);
  }
  return result;
}

}  // namespace consolidation
