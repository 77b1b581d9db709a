// SPDX-License-Identifier: BSL-1.0
// How strong and how dilatant is the study's sand? Consolidates 400 ellipses and compresses them in a drained biaxial test.
#include <CLI/CLI.hpp>
#include <atomic>
#include <exception>
#include <iostream>
#include <thread>

#include "../command_line.hpp"
#include "report.hpp"

namespace {

struct Options {
  rve_biaxial::Choice choice;
  int seeds = 5;
  std::uint64_t seed = 1;
  double smoothing = 0.05;
  std::string output = "output/rve_biaxial";
};

void declare_options(CLI::App& app, Options& options) {
  using examples::number_from;
  auto& choice = options.choice;
  app.add_option("--grains", choice.grains, "grains of the RVE")->check(CLI::Range(1, 100'000));
  app.add_option("--seeds", options.seeds, "number of packings")->check(CLI::Range(1, 10'000));
  app.add_option("--seed", options.seed, "seed of the first packing; the others follow")
      ->check(number_from(0.0, true, 1e15));
  app.add_option("--preparation-friction", choice.preparation_friction,
                 "friction during consolidation, sets the density")
      ->check(number_from(0.0, true, 10.0));
  app.add_option("--pressure", choice.pressure, "of the consolidation and of the lateral stress [Pa]")
      ->check(number_from(0.0, false, 1e9));
  app.add_option("--strain", choice.strain, "axial logarithmic strain at the end")->check(number_from(0.0, false, 2.0));
  app.add_option("--strain-per-step", choice.strain_per_step, "axial strain of one DEM step")
      ->check(number_from(0.0, false, 1e-3));
  app.add_option("--smoothing", options.smoothing, "strain window through which the table's peaks are read")
      ->check(number_from(0.0, false, 1.0));
  app.add_option("--output", options.output, "folder for biaxial.csv, packing_*.csv, summary.json")
      ->check([](std::string const& given) { return examples::refused_folder(given); });
  app.set_config("--config", "", "file with lines `option = value`");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.option_defaults()->always_capture_default();
}

/// One result per seed in the order of the seeds, whichever thread worked on it.
std::vector<rve_biaxial::Result> run_all(Options const& options) {
  auto const count = static_cast<std::size_t>(options.seeds);
  std::vector<rve_biaxial::Result> results(count);
  std::vector<std::exception_ptr> problems(count);
  std::atomic<std::size_t> next{0};
  {
    std::vector<std::jthread> workers;
    for (std::size_t w = 0; w < std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency())); ++w) {
      workers.emplace_back([&] {
        for (std::size_t k = next++; k < count; k = next++) {
          try {
            results[k] = rve_biaxial::run_seed(options.choice, options.seed + k);
          } catch (...) {
            problems[k] = std::current_exception();
          }
        }
      });
    }
  }
  for (auto const& problem : problems) {
    if (problem) std::rethrow_exception(problem);
  }
  return results;
}

/// \throws InputError for a test that is shorter than the window through which its peaks are read
void require_room_for_window(Options const& options) {
  if (options.smoothing > options.choice.strain) {
    scarp::refuse("no window of {} lies in the test (its strain is {}): shear further or smooth less",
                  options.smoothing, options.choice.strain);
  }
}

/// \throws InputError when a packing could not be prepared or sheared
void require_success(std::vector<rve_biaxial::Result> const& results, Options const& options) {
  for (auto const& result : results) {
    auto const& verdict = result.prepared.acceptable() ? result.sheared : result.prepared;
    if (verdict.acceptable()) continue;
    scarp::refuse("seed {} ended with {} ({}) during its {}: change the pressure, the number of grains or the rate",
                  result.seed, scarp::name(verdict.status), scarp::name(verdict.reason),
                  result.prepared.acceptable() ? "shearing" : "consolidation");
  }
  for (auto const& result : results) {
    if (!std::isfinite(rve_biaxial::peak_angles(result.rows, options.smoothing).friction_angle)) {
      scarp::refuse("no window of {} was filled (a step strains by {}): take smaller steps", options.smoothing,
                    options.choice.strain_per_step);
    }
  }
}

void print_table(std::vector<rve_biaxial::Result> const& results, Options const& options) {
  fmt::print("{:>8} {:>8} {:>8} {:>9} {:>9}   peaks through a window of {} axial strain\n", "seed", "e", "Z", "phi_max",
             "psi_max", options.smoothing);
  for (auto const& result : results) {
    auto const peak = rve_biaxial::peak_angles(result.rows, options.smoothing);
    fmt::print("{:>8} {:>8.4f} {:>8.3f} {:>9.2f} {:>9.2f}\n", result.seed, result.rows.front().void_ratio,
               result.rows.front().coordination, peak.friction_angle, peak.dilation_angle);
  }
  for (double const window : rve_biaxial::all_windows(options.smoothing)) {
    auto const [phi, psi] = rve_biaxial::peak_spreads(results, window);
    fmt::print("window {:<6} phi_max {:6.2f} +- {:.2f}   psi_max {:6.2f} +- {:.2f} degrees\n", window, phi.mean,
               phi.deviation, psi.mean, psi.deviation);
  }
  auto const secant = rve_biaxial::spread_over(
      results, [](auto const& result) { return rve_biaxial::secant_dilation_angle(result.rows); });
  fmt::print("secant from largest contraction to the end: psi {:.2f} +- {:.2f} degrees\n", secant.mean,
             secant.deviation);
  fmt::print("the study:    phi_max  30.8          psi_max   6.6          (e 0.160 to 0.179, window not stated)\n");
  fmt::print("SudoDEM:      phi_max  33.8                                 (e 0.173)\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Drained biaxial compression of the study's RVE");
  Options options;
  try {
    declare_options(app, options);
    app.parse(argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  try {
    require_room_for_window(options);
    auto const results = run_all(options);
    require_success(results, options);
    rve_biaxial::write_all(options.output, options.choice, results, options.smoothing);
    print_table(results, options);
  } catch (std::exception const& problem) {
    fmt::print(stderr, "rve_biaxial: {}\n", problem.what());
    return 1;
  }
  return 0;
}
