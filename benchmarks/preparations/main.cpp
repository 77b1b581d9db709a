// SPDX-License-Identifier: BSL-1.0
// Which preparation of the study's packing gives both its void ratio and its earth pressure at rest?
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <nlohmann/json.hpp>

#include "../../examples/shared/command_line.hpp"
#include "measures.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/measure/processor.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace {

using namespace preparations;

struct Options {
  int grains = 400;
  int seeds = 10;
  std::uint64_t seed = 1;
  int threads = 0;
  bool quick = false;
  std::string out = "output/preparations";
};

/// At 0, 1.0, 2.9, 6.1, 12.5, 18.9 and 25 m: 4 kPa + 15.68 kN/m3 times the depth.
constexpr std::array overburdens{4e3, 20e3, 50e3, 100e3, 200e3, 300e3, 396e3};
constexpr double tested_overburden = 200e3;

struct Row {
  Preparation preparation;
  std::uint64_t seed = 0;
  double overburden = 0.0;
  scarp::Verdict verdict;
  Measures measures;
  Tested tested;
};

std::vector<Row> rows_of(Options const& options, std::uint64_t seed) {
  std::vector<Row> rows;
  Columns columns(options.grains, seed);
  for (auto const& preparation : all_preparations()) {
    for (auto const& depth : columns.make(preparation, overburdens)) {
      Row row{preparation, seed, depth.overburden, depth.prepared.verdict, {}, {}};
      if (row.verdict.acceptable()) {
        row.measures = measure(depth);
        if (preparation.tested && depth.overburden == tested_overburden) row.tested = test(depth.prepared.packing);
      }
      rows.push_back(row);
    }
  }
  fmt::print(stderr, "seed {}: {} packings\n", seed, rows.size());
  return rows;
}

void write(std::filesystem::path const& folder, std::vector<std::vector<Row>> const& of_seeds) {
  scarp::CsvTable table({"path",
                         "isotropic_pressure",
                         "isotropic_friction",
                         "share",
                         "share_friction",
                         "vertical_friction",
                         "preload",
                         "held_ratio",
                         "laid",
                         "fastest",
                         "seed",
                         "overburden",
                         "status",
                         "k0",
                         "void_ratio",
                         "coordination",
                         "mechanical_coordination",
                         "contact_fabric",
                         "particle_fabric",
                         "level_particle_fabric",
                         "sliding_share",
                         "lateral_strain",
                         "vertical_strain",
                         "friction_angle",
                         "narrow_friction_angle",
                         "dilation_angle",
                         "elastic_k0"});
  for (auto const& rows : of_seeds) {
    for (auto const& [made, seed, overburden, verdict, is, tested] : rows) {
      table.add(made.path, made.isotropic_pressure, made.isotropic_friction, made.share, made.share_friction,
                made.vertical_friction, made.preload, made.held_ratio, made.laid, made.fastest, seed, overburden,
                scarp::name(verdict.status), is.k0, is.void_ratio, is.coordination, is.mechanical_coordination,
                is.contact_fabric, is.particle_fabric, is.level_particle_fabric, is.sliding_share, is.lateral_strain,
                is.vertical_strain, tested.friction_angle, tested.narrow_friction_angle, tested.dilation_angle,
                tested.elastic_k0);
    }
  }
  table.write(folder / "preparations.csv");
}

void declare_options(CLI::App& app, Options& options) {
  app.option_defaults()->always_capture_default();
  app.add_option("--grains", options.grains, "grains of each packing")->check(CLI::Range(9, 100'000));
  app.add_option("--seeds", options.seeds, "number of clouds")->check(CLI::Range(2, 10'000));
  app.add_option("--seed", options.seed, "seed of the first cloud; the others follow")->check(examples::seed_number());
  app.add_option("--threads", options.threads, "0 takes all processors")->check(CLI::Range(0, 1024));
  app.add_option("--out", options.out, "folder for preparations.csv and run.json");
  app.add_flag("--quick", options.quick, "two clouds of 60 grains unless said otherwise, no page");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Which preparation of the study's packing gives both its void ratio and its earth pressure at rest?");
  Options options;
  declare_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  try {
    if (options.quick) {
      if (app.count("--grains") == 0) options.grains = 60;
      if (app.count("--seeds") == 0) options.seeds = 2;
    }
    std::filesystem::path const folder = options.out;
    std::filesystem::create_directories(folder);
    scarp::CpuTime const time;
    std::vector<std::vector<Row>> of_seeds(static_cast<std::size_t>(options.seeds));
    scarp::ThreadExecutor executor(options.threads);
    executor.for_each(options.seeds, [&](int k) {
      of_seeds[static_cast<std::size_t>(k)] = rows_of(options, options.seed + static_cast<std::uint64_t>(k));
    });
    write(folder, of_seeds);
    nlohmann::json const run{{"grains", options.grains},      {"seeds", options.seeds},
                             {"seed", options.seed},          {"quick", options.quick},
                             {"cpu_seconds", time.seconds()}, {"processor", scarp::processor()}};
    scarp::write_file(folder / "run.json", run.dump(2) + "\n");
  } catch (std::exception const& problem) {
    fmt::print(stderr, "preparations: {}\n", problem.what());
    return 1;
  }
  return 0;
}
