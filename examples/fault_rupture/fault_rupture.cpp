// SPDX-License-Identifier: BSL-1.0
// Where does a normal fault reach the surface of sand? The study's free-field scene with a packing in every element.
#include "../command_line.hpp"
#include "scarp/io/packing_tables.hpp"
#include "scarp/scene/convergence_log.hpp"
#include "scarp/scene/field_series.hpp"
#include "scarp/scene/probe.hpp"
#include "scarp/scene/progress.hpp"
#include "scarp/scene/stop_signal.hpp"
#include "scarp/scene/surface_log.hpp"
#include "scarp/scene/time_limit.hpp"
#include "summary.hpp"

namespace {

using fault_rupture::Choice;

/// The same physics on a tiny mesh with few grains.
void make_quick(Choice& choice) {
  choice.size = 5.0;
  choice.grains = 100;
  choice.largest_gradient = 0.02;
  choice.tolerance = 1e-2;
}

void declare_options(CLI::App& app, Choice& choice, bool& quick) {
  using examples::number_from;
  app.add_flag("--quick", quick, "tiny mesh and few grains; other options still apply")->configurable(false);
  app.add_option("--size", choice.size, "width of a mesh cell in the band [m]")->check(number_from(0.0, false, 25.0));
  app.add_option("--triangles", choice.triangles, "wanted number of triangles instead of --size")
      ->check(CLI::Range(100, 1'000'000));
  app.add_option("--grains", choice.grains, "grains in each RVE")->check(CLI::Range(1, 100'000));
  app.add_option("--seed", choice.seed, "of the packing");
  app.add_option("--preparation-friction", choice.preparation_friction, "sets the density of the packing")
      ->check(number_from(0.0, true, 10.0));
  app.add_option("--throw-over-depth", choice.throw_over_depth, "h/H at the end")->check(number_from(0.0, false, 1.0));
  app.add_option("--dip", choice.dip, "of the fault [degrees]")->check(number_from(0.0, false, 90.0));
  app.add_option("--tip", choice.tip, "x of the fault at bedrock [m]")->check(number_from(-1e6, true, 1e6));
  app.add_option("--tolerance", choice.tolerance, "force residual over reactions")->check(number_from(0.0, false, 1.0));
  app.add_option("--largest-gradient", choice.largest_gradient, "displacement gradient that limits a load step")
      ->check(number_from(0.0, false, 0.2));
  app.add_option("--most-iterations", choice.most_iterations, "of a load step")->check(CLI::Range(1, 10'000));
  app.add_option("--strain-per-step", choice.strain_per_step, "strain of one DEM step")
      ->check(number_from(0.0, false, 1e-3));
  app.add_option("--least-dem-steps", choice.least_dem_steps, "of one response")->check(CLI::Range(1, 20'000));
  app.add_option("--unbalanced", choice.unbalanced_tolerance, "unbalanced ratio asked of every packing")
      ->check(number_from(0.0, false, 1.0));
  app.add_option("--threads", choice.threads, "0 takes all")->check(CLI::Range(0, 1024));
  app.add_option("--frames", choice.frames, "VTU files over the run")->check(CLI::Range(1, 100'000));
  app.add_option("--probe-a-x", choice.probe_a_x, "probe A, in the band [m]")->check(number_from(-1e6, true, 1e6));
  app.add_option("--probe-a-y", choice.probe_a_y, "height above bedrock [m]")->check(number_from(-1e6, true, 1e6));
  app.add_option("--probe-b-x", choice.probe_b_x, "probe B, outside [m]")->check(number_from(-1e6, true, 1e6));
  app.add_option("--probe-b-y", choice.probe_b_y, "height above bedrock [m]")->check(number_from(-1e6, true, 1e6));
  app.add_option("--time-limit", choice.time_limit, "stop after so many seconds, 0 for none")
      ->check(number_from(0.0, true, 1e9));
  app.add_option("--output", choice.output, "folder for all results")->check([](std::string const& given) {
    return examples::refused_folder(given);
  });
  app.set_config("--config", "", "file with lines `option = value`");
  app.allow_config_extras(CLI::config_extras_mode::error);
}

/// An older, longer series would be mixed up with the new one, and an old summary would speak for it.
void remove_older_results(std::filesystem::path const& folder) {
  for (auto const* name : {"fields.pvd", "summary.json", "summary.txt"}) std::filesystem::remove(folder / name);
  for (auto const& file : std::filesystem::directory_iterator(folder / "fields")) {
    std::string const name = file.path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".vtu")) std::filesystem::remove(file.path());
  }
}

int run(Choice const& choice) {
  namespace fs = std::filesystem;
  auto const started = std::chrono::steady_clock::now();
  auto const elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  };
  auto const scene = fault_rupture::make_scene(choice);
  fmt::print(stderr, "{} packings of {} grains by depth after {:.1f} s\n", scene.soil.source.packings.size(),
             choice.grains, elapsed());
  scarp::ThreadExecutor executor(choice.threads);
  auto problem = scene.problem(executor);
  fmt::print(stderr, "{} triangles, {} threads\n", problem.discretisation().mesh().elements.size(), executor.threads());

  fs::path const folder = choice.output;
  fs::create_directories(folder / "fields");
  remove_older_results(folder);
  std::size_t const middle = scene.soil.source.packings.size() / 2;
  scarp::write_packing_tables(folder, scene.soil.source.packings[middle], scene.soil.law);
  double const depth = scene.layer.depth;
  double const to = scene.throw_to;
  auto const& grid = problem.discretisation();
  auto const at = [&](double x, double y) { return nearest_point(grid, scarp::Vector<2>(x, y)); };
  scarp::Observers observers(
      scarp::FieldSeries<scarp::RveQuantities>(folder, to, choice.frames, depth),
      scarp::SurfaceLog(folder / "surface.csv", scarp::boundary_nodes(grid.mesh(), "surface"), to, 17, depth),
      scarp::RveProbe(folder / "probe_A.csv", at(choice.probe_a_x, choice.probe_a_y), depth),
      scarp::RveProbe(folder / "probe_B.csv", at(choice.probe_b_x, choice.probe_b_y), depth),
      scarp::ConvergenceLog(folder / "convergence.csv", depth), scarp::Progress(to, depth), scarp::StopSignal(),
      scarp::TimeLimit(choice.time_limit));

  auto report = scene.settle(problem, observers);
  auto const rest = fault_rupture::at_rest(problem, scene);
  if (report.verdict.acceptable()) report = scarp::joined(report, scene.rupture(problem, observers));

  auto const json = fault_rupture::summary(choice, scene, problem, rest, report, elapsed());
  scarp::write_file(folder / "summary.json", json.dump(2) + "\n");
  std::string text = fault_rupture::table(json);
  if (!report.verdict.acceptable()) {
    text =
        fmt::format("INCOMPLETE: stopped at h/H = {:.5f} ({}; last refused step: {}, point {})\n", report.load / depth,
                    name(report.verdict.reason), name(report.last_failure), report.worst_point) +
        text;
  }
  scarp::write_file(folder / "summary.txt", text);
  fmt::print("{}", text);
  if (report.verdict.acceptable()) return 0;
  constexpr int interrupted = 130;  // as a shell reports Ctrl-C
  return report.verdict.reason == scarp::Reason::interrupted ? interrupted : 3;
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  bool quick = false;
  // --quick changes defaults, which must be in place before the other options are read.
  for (int k = 1; k < argc; ++k) quick = quick || std::string_view(argv[k]) == "--quick";
  if (quick) make_quick(choice);
  CLI::App app("Free-field fault rupture: finite elements with a discrete-element packing in each.");
  app.option_defaults()->always_capture_default();
  declare_options(app, choice, quick);
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& error) {
    int const code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  try {
    return run(choice);
  } catch (std::exception const& error) {
    fmt::print(stderr, "fault_rupture: {}\n", error.what());
    return 1;
  }
}
