// SPDX-License-Identifier: BSL-1.0
// A laboratory: prepares packings, shears them along any path, calibrates them, replays those of other codes, and tests
// any material.
#include <exception>
#include <iostream>

#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "commands.hpp"

int main(int argc, char** argv) {
  using namespace rve_lab;
  CLI::App app("A laboratory for packings and other materials; SUBCOMMAND --help shows its options");
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  examples::declare_config(app, "file with sections like [shear] and lines `option = value`");
  app.require_subcommand(1);
  auto* const prepare_app = app.add_subcommand("prepare", "makes a packing under isotropic pressure");
  auto* const shear_app = app.add_subcommand("shear", "sends a packing along a path");
  auto* const calibrate_app = app.add_subcommand("calibrate", "finds parameters of a sand by data of the laboratory");
  auto* const test_app =
      app.add_subcommand("test", "tests packings, Mohr-Coulomb or elastic material as laboratories do");
  auto* const replay_app = app.add_subcommand("replay", "sends another code's packing along a path");
  Test prepared;
  Test sheared;
  CalibrateChoice calibrated;
  Laboratory tested;
  Replay replayed;
  try {
    declare_prepare(*prepare_app, prepared);
    declare_shear(*shear_app, sheared);
    declare_calibrate(*calibrate_app, calibrated);
    declare_test(*test_app, tested);
    declare_replay(*replay_app, replayed);
    examples::parse(app, argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  try {
    if (prepare_app->parsed()) prepare(prepared, *prepare_app);
    if (shear_app->parsed()) shear(sheared, *shear_app);
    if (calibrate_app->parsed()) calibrate(calibrated, *calibrate_app);
    if (replay_app->parsed()) replay(replayed, *replay_app);
    constexpr int stopped_early = 3;
    if (test_app->parsed() && !test(tested, *test_app)) return stopped_early;
  } catch (std::exception const& problem) {
    return examples::ended_by(problem, "rve_lab", *app.get_subcommands().front());
  }
  return 0;
}
