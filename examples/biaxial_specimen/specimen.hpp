// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <filesystem>

#include "../shared/budget_report.hpp"
#include "../shared/print.hpp"
#include "../shared/write_json.hpp"
#include "rectangle.hpp"
#include "run.hpp"
#include "sand.hpp"
#include "scarp/budget/error_budget.hpp"
#include "scarp/bvp/discretisation.hpp"
#include "scarp/bvp/following_pressure.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/solver/equilibrium_problem.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace biaxial_specimen {

/// Pores without water.
template <class ElementType>
struct Dry {
  using Element = ElementType;
  using Grid = scarp::Discretisation<Element, scarp::UpdatedLagrangian, scarp::FullIntegration>;
  using Lateral = scarp::FollowingPressure<typename Element::Facet>;
  static constexpr bool have_water = false;

  /// A specimen without a file.
  static scarp::Mesh<Element> own_mesh(Choice const& choice) requires std::is_same_v<Element, scarp::Tri3> {
    return crossed_rectangle(choice.width, choice.height, choice.columns, choice.rows);
  }
  static scarp::NoAttachment field(Choice const&, Grid const&, scarp::MaterialPoints<2> const&) { return {}; }
};

/// A body between smooth platens under lateral pressure. The load factor is the axial strain relative to the first
/// height; the middle of the bottom is held.
/// \tparam Pores `Dry`, or `Undrained` (water/undrained.cpp)
template <class Pores>
class Specimen {
 public:
  using Element = typename Pores::Element;
  using Grid = typename Pores::Grid;
  using Problem = scarp::EquilibriumProblem<Grid>;

  /// \throws InputError, PreparationError
  Specimen(Choice const& choice, scarp::Mesh<Element> mesh, scarp::ThreadExecutor& executor)
      : sides_(find_sides(mesh)),
        at_rest_(choice.confining - choice.effective()),
        problem_(make(choice, Grid(std::move(mesh), choice.grains.sand.thickness), executor)) {}

  Problem& problem() { return problem_; }
  Sides<Element> const& sides() const { return sides_; }

  /// Volume average of the grains' stress [Pa], tension positive.
  scarp::VoigtStress<2> mean_stress() const {
    auto const& grid = problem_.discretisation();
    auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
    scarp::VoigtStress<2> sum = scarp::VoigtStress<2>::Zero();
    double volume = 0.0;
    for (std::size_t k = 0; k < volumes.size(); ++k) {
      sum += volumes[k] * problem_.points().committed_stress(static_cast<int>(k));
      volume += volumes[k];
    }
    return sum / volume;
  }

  /// Force [N] of the top platen, on grains and water, positive when it presses.
  double top_force() const {
    auto const& grid = problem_.discretisation();
    Eigen::VectorXd forces;
    grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), problem_.committed_stresses(), forces);
    auto const verdict = problem_.template attached<typename Pores::Lateral>().add_forces(
        grid.positions(), Eigen::VectorXd::Zero(grid.dof_count()), forces);
    if (problem_.has_field()) forces += problem_.field()->ground_force();
    double sum = verdict.acceptable() ? at_rest_ * top_area() : std::nan("");
    for (int const node : sides_.top) sum -= forces(2 * node + 1);
    return sum;
  }

 private:
  Problem make(Choice const& choice, Grid grid, scarp::ThreadExecutor& executor) const {
    scarp::Constraints constraints(grid.mesh());
    for (int const node : sides_.bottom) constraints.fix(node, 1);
    constraints.fix(sides_.bottom_centre, 0);
    for (int const node : sides_.top) constraints.move(node, 1, -sides_.height);
    std::vector<scarp::Site<2>> sites;
    for (int point = 0; point < grid.point_count(); ++point) sites.push_back(grid.site(point, sides_.top_level));
    scarp::MaterialPoints<2> points(sand(choice.grains, choice.effective(), grid.point_count(), executor), sites);
    // Water at rest pushes the sides from within as far as it pushes them from without, and platens alike: it does no
    // work, and what is left of the lateral pressure acts on grains and excess pressures.
    typename Pores::Lateral lateral(sides_.lateral, choice.effective(), choice.grains.sand.thickness);
    auto field = Pores::field(choice, grid, points);
    if constexpr (Pores::have_water) constraints.add_dofs(field.extra_dofs());
    scarp::LoadHistory loads(Eigen::VectorXd::Zero(constraints.dof_count()));
    return {std::move(grid), std::move(points),  std::move(constraints), std::move(loads),
            executor,        std::move(lateral), std::move(field)};
  }
  double top_area() const {
    auto const& places = problem_.discretisation().positions();
    auto const x = [&](int node) { return places[static_cast<std::size_t>(node)].x(); };
    auto const [left, right] = std::ranges::minmax(sides_.top, {}, x);
    return (x(right) - x(left)) * problem_.discretisation().thickness();
  }

  Sides<Element> sides_;
  double at_rest_;  ///< pressure of the water [Pa]
  Problem problem_;
};

/// Counts over the attempts that one row of the table takes; draws when it is time to.
template <class Budget>
struct Watch : scarp::NeverStops {
  Budget& budget;
  std::optional<scarp::FieldSeries> series{};
  int iterations = 0;
  double residual = 0.0;  ///< of the last accepted attempt

  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    iterations += report.iterations();
    if (report.verdict.acceptable()) residual = report.residual();
    budget.attempted(problem, report);
    if (series) series->attempted(problem, report);
  }
};

/// Columns of the table. Stresses of the grains [Pa] are tension positive, axial strain (shortening over the first
/// height), top force [N] and the water's excess pressure [Pa] positive in compression; iterations count all attempts
/// at the row.
inline std::vector<std::string> columns(bool have_water) {
  std::vector<std::string> names{"step",     "axial_strain", "top_force",  "mean_sxx",
                                 "mean_syy", "mean_sxy",     "iterations", "residual"};
  if (have_water) names.emplace_back("mean_excess_pressure");
  return names;
}

/// Prints the error budget, first whether a bound is exceeded.
inline void report_budget(Choice const& choice, scarp::BudgetParts const& parts) {
  examples::print(stderr, "{}{}", scarp::budget_headline(parts), scarp::budget_table(parts));
  if (choice.fields.empty()) return;
  examples::write_json(std::filesystem::path(choice.fields) / "error_budget.json", examples::json_of(parts));
}

/// \return what the run of the last row ended with
template <class Pores, class Budget>
scarp::RunReport compress(Choice const& choice, Specimen<Pores>& specimen, Budget& budget) {
  using Solver = scarp::QuasiNewton<>;
  auto& problem = specimen.problem();
  Solver const solver{.tolerance = choice.residual, .max_iterations = choice.iterations};
  double const step = choice.axial_strain_step;
  scarp::LoadStepping const stepping{
      .first = step, .smallest = 0.99 * std::ldexp(step, -choice.halvings), .max_displacement_gradient = 0.05};
  Watch<Budget> watch{{}, budget};
  if (choice.begin) choice.begin();
  if (!choice.fields.empty()) {
    std::filesystem::create_directories(std::filesystem::path(choice.fields) / "fields");
    watch.series.emplace(
        choice.fields, scarp::LoadSchedule{.to = choice.steps * step, .count = std::min(choice.frames, choice.steps)});
  }
  scarp::CsvLog log(choice.table, columns(Pores::have_water));
  auto const write = [&](int row) {
    auto const mean = specimen.mean_stress();
    double const force = specimen.top_force();
    auto const add = [&](auto... of_water) {
      log.add(row, row * step, force, mean(0), mean(1), mean(2), watch.iterations, watch.residual, of_water...);
    };
    if constexpr (Pores::have_water) {
      add(Pores::mean_excess_pressure(problem));
    } else {
      add();
    }
    examples::print(stderr, "step {:3}  axial strain {:.5f}  top force {:.6g} N  iterations {:3}  residual {:.2e}\n",
                    row, row * step, force, watch.iterations, watch.residual);
    watch.iterations = 0;
  };
  auto const stopped = [&](scarp::RunReport const& report) {
    if (watch.series) watch.series->ended(problem, report.load);
    return report;
  };
  auto report = stepping.settle(solver, problem, 0.0, watch);
  if (!report.verdict.acceptable()) return stopped(report);
  write(0);
  typename Solver::template Session<typename Specimen<Pores>::Problem> session(solver, problem);
  for (int row = 1; row <= choice.steps; ++row) {
    report = stepping.advance(session, problem, (row - 1) * step, row * step, watch);
    if (!report.verdict.acceptable()) return stopped(report);
    write(row);
  }
  return report;
}

template <class Pores>
scarp::Mesh<typename Pores::Element> make_mesh(Choice const& choice) {
  if constexpr (requires { Pores::own_mesh(choice); })
    if (choice.mesh.empty()) return Pores::own_mesh(choice);
  return choice.mesh_file->mesh<typename Pores::Element>();
}

template <class Pores>
int run_with(Choice const& choice) {
  scarp::ThreadExecutor executor(choice.threads);
  Specimen<Pores> specimen(choice, make_mesh<Pores>(choice), executor);
  examples::print(stderr, "{:.6g} m x {:.6g} m, {} elements, {} packings, {} threads\n", specimen.sides().width,
                  specimen.sides().height, specimen.problem().discretisation().mesh().elements.size(),
                  specimen.problem().points().size(), executor.threads());
  scarp::ErrorBudget budget(specimen.problem(), examples::error_bounds(choice.budget),
                            {.pressure_floor = choice.effective() / 100.0});
  auto const report = compress(choice, specimen, budget);
  report_budget(choice, budget.parts());
  if (choice.end) choice.end(report.verdict.acceptable() ? "finished" : std::string(name(report.verdict.reason)));
  if (report.verdict.acceptable()) return 0;
  examples::print(
      stderr,
      "biaxial_specimen: stopped at the axial strain {} ({}; last rejected attempt: {}, point {}); the rows so far "
      "are in '{}'\n",
      report.load, name(report.verdict.reason), name(report.last_failure), report.worst_point, choice.table);
  return 3;
}

template <class Element>
int run(Choice const& choice) {
  return run_with<Dry<Element>>(choice);
}

}  // namespace biaxial_specimen
