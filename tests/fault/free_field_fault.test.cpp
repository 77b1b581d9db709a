// SPDX-License-Identifier: BSL-1.0
#include "scarp/fault/free_field_fault.hpp"

#include <doctest/doctest.h>

#include <regex>

#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_measures.hpp"
#include "scarp/fault/surface_log.hpp"
#include "scarp/observe/convergence_log.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/observe/packing_series.hpp"
#include "scarp/observe/probe.hpp"
#include "scarp/run/time_limit.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "support/approx.hpp"
#include "support/files.hpp"
#include "support/ground.hpp"
#include "support/refusals.hpp"

namespace {

using samples::content;
using samples::ScratchFolder;

using scarp::Verdict;

static_assert(std::is_empty_v<scarp::StressFree<2>> && std::is_empty_v<scarp::NoObserver>);
static_assert(sizeof(samples::ElasticSoil::State) == sizeof(scarp::VoigtStress<2>), "elastic points carry stress only");

/// All that evolves in a run.
struct Outcome {
  scarp::RunReport report;
  std::vector<scarp::Vector<2>> positions;
  std::vector<scarp::VoigtStress<2>> stresses;
  std::vector<samples::Grains> packings;
};

template <class Observer>
Outcome run_sand(scarp::ThreadExecutor& executor, Observer& observer) {
  auto const& scene = samples::sandy_ground();
  auto problem = scene.problem(executor);
  REQUIRE(scene.settle(problem, observer).verdict == Verdict{});
  Outcome outcome{
      scene.rupture(problem, observer), problem.discretisation().positions(), problem.committed_stresses(), {}};
  for (int point = 0; point < problem.points().size(); ++point) {
    outcome.packings.push_back(problem.points().template state<samples::Sand::State>(point).packing);
  }
  return outcome;
}

void check_same_bits(Outcome const& a, Outcome const& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.stresses == b.stresses);
  CHECK(a.packings == b.packings);
  CHECK(a.report.steps == b.report.steps);
  CHECK(a.report.iterations == b.report.iterations);
  CHECK(a.report.inner_steps == b.report.inner_steps);
  CHECK(a.report.largest_residual == b.report.largest_residual);
}

Outcome const& serial_sand() {
  static Outcome const made = [] {
    scarp::ThreadExecutor executor(1);
    scarp::NoObserver no_observer;
    return run_sand(executor, no_observer);
  }();
  return made;
}

/// After every attempt all files of a series must be whole.
struct FilesAreWhole : scarp::NeverStops {
  std::filesystem::path folder;
  int* seen;

  template <class Problem>
  void attempted(Problem const&, scarp::StepReport const&) {
    std::string const list = content(folder / "fields.pvd");
    CHECK(list.ends_with("</Collection>\n</VTKFile>\n"));
    std::regex const entry("file=\"([^\"]+)\"");
    std::string const end = "</VTKFile>";
    *seen = 0;
    for (std::sregex_iterator found(list.begin(), list.end(), entry), none; found != none; ++found, ++*seen) {
      std::filesystem::path const file = (*found)[1].str();
      CHECK(file.is_relative());  // to the folder of the list, so that both can be moved together
      std::string const text = content(folder / file);
      CHECK(text.find(end, text.size() - std::min(text.size(), end.size() + 2)) != std::string::npos);
    }
    int files = 0;
    for (auto const& file : std::filesystem::directory_iterator(folder / "fields")) {
      CHECK(file.path().extension() == ".vtu");  // nothing half-written beside them
      ++files;
    }
    CHECK(files == *seen);
  }
};

}  // namespace

TEST_CASE("elastic ground starts in balance with the given stress ratio and the overburden") {
  auto const scene = samples::elastic_ground();
  scarp::ThreadExecutor executor(1);
  auto problem = scene.problem(executor);
  // Analytic: stress linear in depth balances weight and surcharge, and one point per triangle integrates it exactly.
  CHECK(problem.evaluate_committed().residual < 1e-13);
  scarp::NoObserver no_observer;
  auto const rest = scene.settle(problem, no_observer);
  CHECK(rest.verdict == Verdict{});
  CHECK(rest.iterations == 1);
  for (int point = 0; point < problem.discretisation().point_count(); ++point) {
    auto const stress = problem.points().committed_stress(point);
    double const depth = problem.discretisation().site(point, scene.ground.layer.depth).depth;
    double const overburden = scene.surcharge + scene.unit_weight * depth;
    CHECK(stress(1) == samples::Approx(-overburden).epsilon(1e-12));  // round-off of the settling solve
    CHECK(stress(0) == samples::Approx(-samples::k0 * overburden).epsilon(1e-12));
    CHECK(std::abs(stress(2)) < 1e-12 * overburden);
  }
}

TEST_CASE("the fault moves the hanging wall by the throw and leaves the footwall") {
  auto const scene = samples::elastic_ground();
  scarp::ThreadExecutor executor(1);
  auto problem = scene.problem(executor);
  scarp::NoObserver no_observer;
  REQUIRE(scene.settle(problem, no_observer).verdict == Verdict{});
  auto const rest = scarp::ground_at_rest(problem);
  auto const run = scene.rupture(problem, no_observer);
  REQUIRE(run.verdict == Verdict{});
  CHECK(run.load == scene.throw_to);
  CHECK(run.largest_residual <= 1e-6);  // of the default solver of elastic ground
  auto const& grid = problem.discretisation();
  auto const profile = scarp::surface_profile(grid.mesh(), rest.of(grid.nodes()), grid.positions());
  // Analytic: the sides are prescribed; a sum of some tens of increments, the last cut off at `smallest` = 1e-7 m.
  CHECK(std::abs(profile.front().settlement) < 1e-12);
  CHECK(profile.back().settlement == samples::Approx(scene.throw_to).epsilon(1e-6));
  CHECK(profile.back().x - profile.back().x_initial ==
        samples::Approx(scene.throw_to / std::tan(scene.fault.dip)).epsilon(1e-6));
  auto const found = scarp::outcrop(profile, {.hanging = run.load});
  CHECK(found.steepest_x > scene.ground.layer.left);
  CHECK(found.steepest_x < scene.ground.layer.right);
  CHECK(found.width > 0.0);
}

TEST_CASE("parts of a scene that make no sense are refused") {
  scarp::ThreadExecutor executor(1);
  auto const refused = [&](char const* what, auto const& change) {
    auto scene = samples::elastic_ground();
    change(scene);
    CHECK_REFUSED(scene.problem(executor), what);
  };
  refused("unit weight is -1", [](auto& scene) { scene.unit_weight = -1.0; });
  refused("surcharge is nan", [](auto& scene) { scene.surcharge = std::nan(""); });
  refused("throw is 0", [](auto& scene) { scene.throw_to = 0.0; });
  refused("tip is at x = 100", [](auto& scene) { scene.fault.tip = 100.0; });
  refused("dip is 60", [](auto& scene) { scene.fault.dip = 60.0; });
  refused("size is 0", [](auto& scene) { scene.ground.layer.size = 0.0; });
  // What the soil was prepared for and what the scene weighs.
  auto const soil_of = [](double surcharge, double unit_weight) {
    return samples::ElasticSoil::from_young_poisson(20e6, 0.3, {surcharge, unit_weight, samples::k0});
  };
  refused("the soil carries", [&](auto& scene) { scene.soil = soil_of(scene.surcharge, 0.98 * scene.unit_weight); });
  refused("the soil carries", [&](auto& scene) { scene.soil = soil_of(0.0, scene.unit_weight); });
  refused("the soil carries", [&](auto& scene) { scene.soil = soil_of(scene.surcharge + 5e3, scene.unit_weight); });
}

TEST_CASE("ground of packings ruptures to the asked throw") {
  auto const& outcome = serial_sand();
  CHECK(outcome.report.verdict == Verdict{});
  CHECK(outcome.report.load == samples::sandy_ground().throw_to);
  CHECK(outcome.report.iterations > outcome.report.steps);  // so that the comparisons below cover iterations
  MESSAGE(outcome.report.steps << " steps, " << outcome.report.iterations << " iterations, "
                               << outcome.report.inner_steps << " DEM steps");
}

TEST_CASE("any number of threads gives the same bits") {
  for (int const threads : {2, 4, 7}) {
    scarp::ThreadExecutor executor(threads);
    scarp::NoObserver no_observer;
    check_same_bits(run_sand(executor, no_observer), serial_sand());
  }
}

TEST_CASE("being observed changes no bit and leaves only whole files") {
  ScratchFolder const folder;
  std::filesystem::create_directory(folder / "fields");
  auto const& scene = samples::sandy_ground();
  scarp::ThreadExecutor executor(1);
  double const unit = scene.ground.layer.depth;
  int files = 0;
  FilesAreWhole whole;
  whole.folder = folder.path();
  whole.seen = &files;
  scarp::Observers observers(scarp::FieldSeries(folder.path(), {.to = scene.throw_to, .count = 4, .unit = unit}),
                             scarp::SurfaceLog(folder / "surface.csv", scene.throw_to, 4, unit),
                             scarp::RveProbe(folder / "probe.csv", 3, scarp::LoadMeasure{unit}),
                             scarp::PackingSeries(folder.path(), "probe", 3, scene.throw_to, {0.0, 0.5, 1.0}, {unit}),
                             scarp::ConvergenceLog(folder / "convergence.csv", scarp::LoadMeasure{unit}), whole,
                             scarp::TimeLimit(0.0));
  check_same_bits(run_sand(executor, observers), serial_sand());
  CHECK(files == 5);  // analytic: at rest and at each quarter of the throw
}

TEST_CASE("an element with one packing is that packing driven by the same gradient") {
  auto const& scene = samples::sandy_ground();
  scarp::Mesh<scarp::Tri3> mesh;
  mesh.nodes = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  mesh.elements = {{0, 1, 2}};
  mesh.element_region = {0};
  mesh.regions = {"soil"};
  scarp::Constraints constraints(mesh);
  for (int const node : {0, 1, 2}) constraints.fix(node);
  scarp::ThreadExecutor executor(1);
  scarp::Discretisation<scarp::Tri3> grid(mesh);
  auto const site = grid.site(0, 1.0);
  auto problem = scarp::make_problem(grid, 1.0, boost::hana::make_tuple(scarp::Region{"soil", scene.soil}), constraints,
                                     Eigen::VectorXd::Zero(6), executor);
  auto alone = scene.soil.initial_state(site);
  CHECK(problem.points().committed_stress(0) == alone.stress);
  scarp::Gradient<2> gradient;
  gradient << 0.0, 0.0078125, -0.001953125, -0.00390625;  // powers of two: exact in the element's arithmetic
  for (int step = 0; step < 3; ++step) {
    Eigen::VectorXd increment(6);
    for (int n = 0; n < 3; ++n) {
      increment.segment<2>(2 * n) = gradient * problem.discretisation().positions()[static_cast<std::size_t>(n)];
    }
    REQUIRE(problem.plan(increment).acceptable());
    auto const evaluation = problem.evaluate(increment);
    if (step == 0) CHECK(problem.gradients()[0] == gradient);
    samples::Sand::State trial;
    auto const plan = scene.soil.plan(alone, problem.gradients()[0]);
    auto const answer = scene.soil.respond(alone, problem.gradients()[0], trial, plan);
    CHECK(evaluation.inner_steps == plan);
    CHECK(problem.responses()[0].stress == answer.stress);
    CHECK(problem.responses()[0].verdict == answer.verdict);
    CHECK((step > 0 || answer.stress != alone.stress));
    alone = trial;
    problem.commit(increment);
    CHECK(problem.points().state<samples::Sand::State>(0).packing == alone.packing);
  }
}
