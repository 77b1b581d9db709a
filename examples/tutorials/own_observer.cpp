// SPDX-License-Identifier: BSL-1.0
// User-defined observer: records the curve of load over settlement and ends the run at a settlement.
#include "scarp/bvp/default_grid.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/mesh/box_mesh.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/quasi_newton.hpp"

#include "lattice.hpp"

/// Settlement of the last node over the load factor.
struct SettlementCurve {
  double start = 0.0;  // level of the node at the start [m]
  double limit = 0.0;  // settlement at which the run ends [m]
  std::vector<std::pair<double, double>> rows{};

  /// Called after every attempt at a step; a rejected attempt has been rolled back already.
  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    rows.emplace_back(report.load, start - problem.discretisation().positions().back().y());
  }
  /// Asked before every attempt.
  bool wants_stop() const { return !rows.empty() && rows.back().second >= limit; }
};

int main() {
  double const height = 2.0, young = 20e6, poisson = 0.3, pressure = 1e3;
  auto const mesh = scarp::BoxMesh<scarp::Quad4>{.lengths = {1.0, height}, .cells = {1, 4}}.generate();
  scarp::DefaultGrid<scarp::Quad4> const grid(mesh);
  scarp::Constraints fixed(mesh);  // an oedometer: nothing moves sideways
  for (int node = 0; node < grid.node_count(); ++node) fixed.fix(node, 0);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) fixed.fix(node, 1);
  scarp::LoadHistory loads;
  loads.add(grid.traction("top", {0.0, -pressure}), scarp::TimeFunction::ramp(0.0, 1.0));
  auto const soils =
      boost::hana::make_tuple(scarp::Region{"soil", scarp::LinearElastic<2>::from_young_poisson(young, poisson)});
  scarp::SerialExecutor serial;
  auto problem = scarp::make_problem(grid, height, soils, fixed, loads, serial);

  double const modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  double const whole = pressure * height / modulus;
  SettlementCurve curve{.start = height, .limit = 0.45 * whole};
  static_assert(scarp::ObservesSteps<SettlementCurve, decltype(problem)>);
  scarp::QuasiNewton<> const newton{.tolerance = 1e-8};
  scarp::LoadStepping const steps{.first = 0.1, .largest = 0.1};
  auto const run = steps.run(newton, problem, 0.0, 1.0, curve);

  bool good = run.verdict.reason == scarp::Reason::interrupted;
  good &= tutorials::agree("steps that were seen", static_cast<double>(curve.rows.size()), run.steps, 0.0);
  good &= tutorials::agree("load factor at the end", run.load, 0.5, 1e-12);  // the first of 0.1, 0.2, ... beyond 0.45
  // Linear in the load up to half the strain of 4e-5.
  return tutorials::agree("settlement there [m]", curve.rows.back().second, 0.5 * whole, 1e-4) && good ? 0 : 1;
}
