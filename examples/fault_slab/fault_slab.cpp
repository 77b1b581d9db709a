// SPDX-License-Identifier: BSL-1.0
// Where does a fault that dies out along its strike reach the surface? The reference study's free field as a slab in
// space, of spheres.
#include <algorithm>
#include <set>
#include <string_view>

#include "../shared/command_line.hpp"
#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "run.hpp"

namespace {

using namespace fault_slab;

/// A tiny slab with few grains and a small throw.
void make_quick(Choice& choice) {
  choice.elements = 96;
  choice.across = 3;
  choice.grains = 50;
  choice.throw_over_depth = 0.01;
  choice.max_displacement_gradient = 0.02;
}

void declare_options(CLI::App& app, Choice& choice, examples::Output& output) {
  using examples::number_from;
  examples::add_named<Soil>(app, "--soil", choice.soil, "dem (a packing of spheres in every point) or mohr_coulomb",
                            {{"dem", Soil::dem}, {"mohr_coulomb", Soil::mohr_coulomb}});
  examples::add_named<Slip>(app, "--slip", choice.slip, "tapered (none on the far side) or uniform along the strike",
                            {{"tapered", Slip::tapered}, {"uniform", Slip::uniform}});
  app.add_flag("--quick")
      ->description("tiny slab, few grains, small throw; other options still apply")
      ->configurable(false)
      ->disable_flag_override();
  app.add_option("--elements", choice.elements, "wanted number of hexahedra, eight points in each")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--across", choice.across, "hexahedra along the strike")->check(CLI::Range(1, 1000));
  app.add_option("--strike", choice.strike, "length of the slab along the strike [m]")
      ->check(number_from(0.0, false, 1e4));
  app.add_option("--grains", choice.grains, "spheres in each packing")->check(CLI::Range(30, 100'000));
  app.add_option("--seed", choice.seed, "of the packings")->check(examples::seed_number());
  app.add_option("--length", choice.length, "intrinsic length [m]; 0 for none")->check(number_from(0.0, true, 1e3));
  app.add_option("--throw-over-depth", choice.throw_over_depth, "h/H on the near side at the end")
      ->check(number_from(0.0, false, 1.0));
  app.add_option("--tolerance", choice.tolerance, "force residual over reactions")->check(number_from(0.0, false, 1.0));
  app.add_option("--max-displacement-gradient", choice.max_displacement_gradient,
                 "displacement gradient that limits a load step")
      ->check(number_from(0.0, false, 0.2));
  app.add_option("--threads", choice.threads, "0 uses all processors")->check(CLI::Range(0, 1024));
  app.add_option("--frames", choice.frames, "VTU files over the run")->check(CLI::Range(1, 100'000));
  app.add_option("--time-limit", choice.time_limit, "stop after so many seconds, preparation and all; 0 for none")
      ->check(number_from(0.0, true, 1e9));
  auto* const folder =
      app.add_option("--checkpoint", choice.checkpoint, "folder for checkpoints; empty for none")
          ->check([](std::string const& given) { return given.empty() ? "" : examples::folder_problem(given); });
  auto* const resume =
      app.add_flag("--resume", choice.resume, "resume from the newest checkpoint there")->needs(folder);
  examples::declare_output(app, output, "folder for all results");
  resume->excludes("--overwrite");
}

/// A line for each option that the result depends on.
std::string scene_lines(CLI::App const& app) {
  std::set<std::string> const others{"quick", "threads", "time-limit", "checkpoint", "resume", "output", "overwrite"};
  std::string lines;
  for (auto const& [name, value] : examples::all_options(app)) {
    if (!others.contains(name)) lines += fmt::format("{} = {}\n", name, value);
  }
  return lines;
}

}  // namespace

int main(int argc, char** argv) {
  auto const started = Moment::clock::now();
  Choice choice;
  if (std::find(argv + 1, argv + argc, std::string_view("--quick")) != argv + argc) make_quick(choice);
  CLI::App app("Fault rupture through a slab in space: hexahedra with a packing of spheres in each point.");
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  examples::Output output{"output/fault_slab"};
  declare_options(app, choice, output);
  if (auto const code = examples::ended_by_options(app, argc, argv)) return *code;
  try {
    if (choice.soil != Soil::dem) examples::warn_of_unused(app, "the ground has no packings", {"--grains", "--seed"});
    scarp::CheckpointFiles files({.folder = choice.checkpoint, .resume = choice.resume}, scene_lines(app));
    scarp::RunFolder folder({.folder = output.folder, .overwrite = output.overwrite},
                            examples::record_of("fault_slab", app), &files);
    return run(choice, folder, files, started);
  } catch (std::exception const& problem) {
    return examples::ended_by(problem, "fault_slab", app);
  }
}
