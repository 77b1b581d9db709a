// SPDX-License-Identifier: BSL-1.0
// A laboratory: prepares packings, shears them along any path, calibrates them, replays those of other codes, and tests any material.
#include <exception>
#include <iostream>

#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "../shared/version_option.hpp"
#include "calibrate.hpp"
#include "laboratory_material.hpp"
#include "options.hpp"
#include "packings.hpp"
#include "replay.hpp"
#include "shear.hpp"

namespace {

using namespace rve_lab;

/// Writes packing.packing with packing.sand and its tables into the folder.
template <class PackingType>
void write_packing(Test const& choice, scarp::RunFolder& own, PackingType const& packing,
                   typename PackingType::Law const& law) {
  own.begin();
  std::filesystem::path const& folder = own.path();
  auto const file = folder / "packing.packing";
  scarp::save_packing(file, packing);
  scarp::write_file(examples::sand_path(file), examples::text_of(choice.sand));
  write_state(folder, "packing", packing, law);
  if constexpr (requires { write_for_code(choice.format, folder, packing); }) {
    if (!choice.format.empty()) write_for_code(choice.format, folder / "packing", packing);
  }
  auto const state = scarp::balance(packing, law);
  examples::print(
      stdout, "{}: void ratio {:.6f}, {} contacts, coordination {:.3f}, stress [Pa] xx {:.1f}, xy {:.1f}, yy {:.1f}\n",
      file.string(), packing.void_ratio(), state.contacts, scarp::coordination(packing, law).all, state.stress(0, 0),
      state.stress(0, 1), state.stress(1, 1));
}

/// Each command has a record of its own, so that a packing is prepared and sheared in one folder.
scarp::RunFolder folder_of(examples::Output const& output, CLI::App const& app, std::vector<std::string> results) {
  return {{.folder = output.folder,
           .overwrite = output.overwrite,
           .record = "run_" + app.get_name() + ".json",
           .results = std::move(results)},
          examples::record_of("rve_lab " + app.get_name(), app)};
}

void prepare(Test& choice, CLI::App const& app) {
  read_sand_file(choice, app);
  if (choice.sand.shape != "disc") examples::reject_unused(app, "format", "other codes have discs only");
  auto own = folder_of(choice.output, app, {"packing.packing"});
  with_packing(Grains{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    write_packing(choice, own, prepared<PackingType>(choice.sand, law), law);
  });
  own.end("finished");
}

void shear(Test& choice, CLI::App const& app) {
  require_used(app, choice.path);
  auto own = folder_of(choice.output, app, {"path.csv", "summary.json"});
  if (!choice.packing.empty())
    choice.sand = examples::sand_of_packing(choice.packing, choice.sand, examples::given_in(app));
  read_sand_file(choice, app);
  with_packing(Grains{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    auto packing = choice.packing.empty() ? prepared<PackingType>(choice.sand, law)
                                          : scarp::load_packing<PackingType>(choice.packing);
    run_path(std::move(packing), law, choice.path, own, choice.sand);
  });
}

}  // namespace

int main(int argc, char** argv) {
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
    examples::declare_sand_file(*prepare_app, prepared.sand_file);
    examples::declare_sand(*prepare_app, prepared.sand);
    prepare_app
        ->add_option("--format", prepared.format,
                     "writes discs for another code too: yade (packing.txt) or lammps (packing.data)")
        ->check(CLI::IsMember({"yade", "lammps"}));
    examples::declare_output(*prepare_app, prepared.output, "folder for packing.packing, packing.sand and tables",
                             "--output,-o");
    declare_test(*shear_app, sheared);
    declare_calibrate(*calibrate_app, calibrated);
    declare_laboratory(*test_app, tested);
    declare_replay(*replay_app, replayed);
    examples::parse(app, argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  try {
    if (prepare_app->parsed()) prepare(prepared, *prepare_app);
    if (shear_app->parsed()) shear(sheared, *shear_app);
    if (test_app->parsed()) {
      require_used(*test_app, tested);
      constexpr int stopped_early = 3;
      if (!test(tested, *test_app, folder_of(tested.output, *test_app, {"test.csv", "summary.json"})))
        return stopped_early;
    }
    if (calibrate_app->parsed()) calibrate(calibrated, *calibrate_app);
    if (replay_app->parsed()) {
      require_used(*replay_app, replayed.path);
      auto const given = examples::given_in(*replay_app);
      replay(replayed, {.normal_stiffness = given("normal-stiffness"),
                        .tangential_stiffness = given("tangential-stiffness"),
                        .friction = given("friction")});
    }
  } catch (std::exception const& problem) {
    CLI::App const& command = *app.get_subcommands().front();
    examples::ended_by(problem, "rve_lab", command);
    return dynamic_cast<scarp::FolderError const*>(&problem) != nullptr ? 2 : 1;
  }
  return 0;
}
