// SPDX-License-Identifier: BSL-1.0
// Does ground of packings press on a retaining wall as Rankine has it, when the wall gives way and when it pushes?
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "../shared/command_line.hpp"
#include "../shared/version_option.hpp"
#include "report.hpp"

namespace {

using retaining_wall::Choice;
using retaining_wall::Soil;

void declare_options(CLI::App& app, Choice& choice) {
  using examples::number_from;
  std::map<std::string, Soil> const soils{{"sand", Soil::sand}, {"mohr_coulomb", Soil::mohr_coulomb}};
  app.add_option("--soil", choice.soil, "sand: a packing of ellipses at every point")
      ->transform(CLI::CheckedTransformer(soils))
      ->default_str("sand");
  app.add_option("--grains", choice.grains, "in each packing")->check(CLI::Range(20, 100'000));
  app.add_option("--size", choice.size, "of the square cells [m]; divides 4 m and 10 m")
      ->check(number_from(0.0, false, 2.0));
  app.add_option("--seed", choice.seed, "of the packing")->check(number_from(0.0, true, 1e15));
  app.add_option("--preparation-friction", choice.preparation_friction, "sets the density of the packing")
      ->check(number_from(0.0, true, 10.0));
  app.add_option("--strain", choice.strain, "wall displacement over the length of the ground, at the end")
      ->check(number_from(2.0 * retaining_wall::window, true, 0.3));
  app.add_option("--threads", choice.threads, "0 takes all")->check(CLI::Range(0, 1024));
  app.add_option("--output", choice.output, "folder of summary.json and of tables of forces and tests")
      ->check([](std::string const& given) { return examples::refused_folder(given); });
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app("Moves a smooth retaining wall away from level ground and into it.");
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  declare_options(app, choice);
  CLI11_PARSE(app, argc, argv);
  try {
    auto const outcomes = choice.soil == Soil::sand ? run_sand(choice) : run_mohr_coulomb(choice);
    retaining_wall::write_all(choice, outcomes);
    retaining_wall::print_table(outcomes);
    return retaining_wall::judge(outcomes) ? 0 : 1;
  } catch (std::exception const& problem) {
    fmt::print(stderr, "retaining_wall: {}\n", problem.what());
    return 2;
  }
}
