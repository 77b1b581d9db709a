// SPDX-License-Identifier: BSL-1.0
// How strong and how dilatant is the reference study's sand? Consolidates 400 ellipses and compresses them in a drained
// biaxial test.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "../shared/command_line.hpp"
#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "report.hpp"
#include "scarp/core/process.hpp"
#include "scarp/io/text_lines.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "tables.hpp"

namespace {

struct Options {
  rve_biaxial::Choice choice;
  std::vector<std::string> frictions{fmt::format("{}", choice.preparation_friction)};  ///< as given
  std::vector<double> preparation_frictions{};                                         ///< from these files
  int seeds = 5;
  std::uint64_t seed = 1;
  double smoothing = 0.05;
  examples::Output output{"output/rve_biaxial"};
};

void declare_options(CLI::App& app, Options& options) {
  using examples::number_from;
  app.option_defaults()->always_capture_default();
  auto& choice = options.choice;
  app.add_option("--grains", choice.grains, "grains of the RVE")->check(CLI::Range(1, 100'000));
  app.add_option("--seeds", options.seeds, "number of packings")->check(CLI::Range(1, 10'000));
  app.add_option("--seed", options.seed, "seed of the first packing; the others follow")
      ->check(examples::seed_number());
  app.add_option("--preparation-friction", options.frictions,
                 "friction during consolidation, sets the density; a list a,b,c runs all seeds at each")
      ->check(examples::each_of_list(number_from(0.0, true, 10.0)));
  app.add_option("--pressure", choice.pressure, "of the consolidation and of the lateral stress [Pa]")
      ->check(number_from(0.0, false, 1e9));
  app.add_option("--strain", choice.strain, "axial logarithmic strain at the end")->check(number_from(1e-9, true, 2.0));
  app.add_option("--strain-per-dem-step", choice.strain_per_step, "axial strain of one DEM step")
      ->check(number_from(1e-12, true, 1e-3));
  app.add_option("--smoothing", options.smoothing, "strain window through which the table's peaks are read")
      ->check(number_from(0.0, false, 1.0));
  examples::declare_output(app, options.output, "folder for biaxial.csv, packing_*.csv, summary.json");
  examples::declare_config(app);
}

/// One result per friction and seed in their order, whichever thread worked on it.
std::vector<rve_biaxial::Result> run_all(Options const& options) {
  auto const seeds = static_cast<std::size_t>(options.seeds);
  std::size_t const count = options.preparation_frictions.size() * seeds;
  std::vector<rve_biaxial::Result> results(count);
  scarp::ThreadExecutor(std::min(static_cast<int>(count), scarp::usable_processors()))
      .for_each(static_cast<int>(count), [&](int task) {
        auto const k = static_cast<std::size_t>(task);
        auto choice = options.choice;
        choice.preparation_friction = options.preparation_frictions[k / seeds];
        results[k] = rve_biaxial::run_seed(choice, options.seed + k % seeds);
      });
  return results;
}

/// \throws InputError for a test that is shorter than the window through which its peaks are read
void require_room_for_window(Options const& options) {
  if (options.smoothing > options.choice.strain) {
    scarp::reject("no window of {} lies in the test (its strain is {}): shear further or smooth less",
                  options.smoothing, options.choice.strain);
  }
}

/// \throws InputError for a friction that is given twice
void read_frictions(Options& options) {
  for (auto const& given : options.frictions) {
    for (auto const& item : examples::list_items(given)) {
      if (scarp::read_number(item, options.preparation_frictions.emplace_back()) != std::errc{})
        scarp::reject("preparation friction '{}' is no number: give numbers, as 0.1,0.3", item);
    }
  }
  auto frictions = options.preparation_frictions;
  std::sort(frictions.begin(), frictions.end());
  auto const twice = std::adjacent_find(frictions.begin(), frictions.end());
  if (twice == frictions.end()) return;
  scarp::reject("preparation friction {} is given twice (its packings would count twice): give each once", *twice);
}

/// \throws InputError when a packing could not be prepared or sheared
void require_success(std::vector<rve_biaxial::Result> const& results, Options const& options) {
  for (auto const& result : results) {
    auto const& verdict = result.prepared.acceptable() ? result.sheared : result.prepared;
    if (verdict.acceptable()) continue;
    scarp::reject(
        "seed {} at preparation friction {} ended with {} ({}) during its {}: change the pressure, the number of "
        "grains or the rate",
        result.seed, result.preparation_friction, scarp::name(verdict.status), scarp::name(verdict.reason),
        result.prepared.acceptable() ? "shearing" : "consolidation");
  }
  for (auto const& result : results) {
    auto const peak = rve_biaxial::peak_angles(result.rows, options.smoothing);
    if (!std::isfinite(peak.friction_angle)) {
      scarp::reject("no window of {} was filled (a step strains by {}): take smaller steps", options.smoothing,
                    options.choice.strain_per_step);
    }
    auto const& end = result.rows[result.rows.size() - 2];
    if (peak.friction_strain + options.smoothing / 2.0 > end.axial_strain) {
      examples::print(stderr,
                      "warning: seed {} at preparation friction {}: the stress ratio is largest where the test ends, "
                      "which is no peak: shear further\n",
                      result.seed, result.preparation_friction);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Drained biaxial compression of the reference study's RVE");
  examples::declare_version(app);
  Options options;
  try {
    declare_options(app, options);
    examples::parse(app, argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  try {
    read_frictions(options);
    require_room_for_window(options);
    scarp::RunFolder folder({.folder = options.output.folder, .overwrite = options.output.overwrite},
                            examples::record_of("rve_biaxial", app));
    auto const results = run_all(options);
    require_success(results, options);
    rve_biaxial::write_all(folder, options.choice, results, options.smoothing);
    auto const budget = rve_biaxial::error_budget(results, options.choice.pressure, {});
    examples::print(stdout, "{}", scarp::budget_headline(budget));
    rve_biaxial::print_tables(results, options.smoothing);
    examples::print(stdout, "\n{}", scarp::budget_table(budget));
  } catch (std::exception const& problem) {
    return examples::ended_by(problem, "rve_biaxial", app);
  }
  return 0;
}
