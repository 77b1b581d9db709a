// SPDX-License-Identifier: BSL-1.0
// Does ground of packings press on a retaining wall as Rankine has it, when the wall gives way and when it pushes?
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "../shared/run_options.hpp"
#include "../shared/sand/options.hpp"
#include "../shared/version_option.hpp"
#include "report.hpp"

namespace {

using retaining_wall::Choice;
using retaining_wall::Soil;

void declare_options(CLI::App& app, Choice& choice, examples::Output& output) {
  using examples::number_from;
  examples::add_named<Soil>(app, "--soil", choice.soil, "sand (a packing of ellipses at every point) or mohr_coulomb",
                            {{"sand", Soil::sand}, {"mohr_coulomb", Soil::mohr_coulomb}});
  examples::declare_sand_file(app, choice.sand_file);
  app.add_option("--grains", choice.sand.grains, "in each packing")->check(CLI::Range(20, 100'000));
  app.add_option("--size", choice.size, "of the square cells [m]; divides 4 m and 10 m")
      ->check(number_from(0.01, true, 2.0));
  app.add_option("--seed", choice.sand.seed, "of the packing")->check(examples::seed_number());
  app.add_option("--preparation-friction", choice.sand.preparation_friction, "sets the density of the packing")
      ->check(number_from(0.0, true, 10.0));
  app.add_option("--strain", choice.strain, "wall displacement over the length of the ground, at the end")
      ->check(number_from(2.0 * retaining_wall::window, true, 0.3));
  app.add_option("--threads", choice.threads, "0 uses all")->check(CLI::Range(0, 1024));
  examples::declare_output(app, output, "folder of summary.json and of tables of forces and tests");
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  CLI::App app("Moves a smooth retaining wall away from level ground and into it.");
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  examples::Output output{"output/retaining_wall"};
  declare_options(app, choice, output);
  if (auto const code = examples::ended_by_options(app, argc, argv)) return *code;
  try {
    if (!choice.sand_file.empty() && choice.soil != Soil::sand)
      scarp::reject("--sand '{}' is not used (ground of --soil sand alone has grains): leave one of the two out",
                    choice.sand_file);
    if (!choice.sand_file.empty())
      choice.sand = examples::read_sand(choice.sand_file, choice.sand, examples::given_in(app));
    if (choice.soil == Soil::mohr_coulomb) {
      examples::warn_of_unused(app, "the ground has no packings", {"--grains", "--seed", "--preparation-friction"});
      examples::warn_of_unused(app, "ground without packings runs on one thread", {"--threads"});
    }
    scarp::RunFolder folder({.folder = output.folder, .overwrite = output.overwrite},
                            examples::record_of("retaining_wall", app));
    auto const outcomes = choice.soil == Soil::sand ? run_sand(choice) : run_mohr_coulomb(choice);
    retaining_wall::write_all(choice, outcomes, folder);
    retaining_wall::print_table(outcomes);
    return retaining_wall::judge(outcomes) ? 0 : 1;
  } catch (std::exception const& problem) {
    return examples::ended_by(problem, "retaining_wall", app);
  }
}
