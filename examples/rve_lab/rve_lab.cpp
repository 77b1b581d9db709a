// SPDX-License-Identifier: BSL-1.0
// A laboratory for packings: prepares them, shears them along any path, and replays those of other codes.
#include <exception>
#include <iostream>

#include "../shared/version_option.hpp"
#include "options.hpp"
#include "preparation.hpp"
#include "replay.hpp"
#include "shear.hpp"

namespace {

using namespace rve_lab;

/// Writes NAME.packing with NAME.json and its tables into the folder.
template <class PackingType>
void write_packing(Test const& choice, PackingType const& packing, typename PackingType::Law const& law) {
  std::filesystem::path const folder = choice.output;
  std::filesystem::create_directories(folder);
  auto const file = folder / "packing.packing";
  auto const& preparation = choice.preparation;
  nlohmann::json const document{{"material", to_json(choice.material)},
                                {"preparation",
                                 {{"smallest", preparation.smallest},
                                  {"largest", preparation.largest},
                                  {"aspect", preparation.aspect},
                                  {"exponent", preparation.exponent},
                                  {"grains", preparation.grains},
                                  {"seed", preparation.seed},
                                  {"density", preparation.density},
                                  {"thickness", preparation.thickness},
                                  {"pressure", preparation.pressure},
                                  {"preparation_friction", preparation.friction}}},
                                {"void_ratio", packing.void_ratio()}};
  scarp::save_packing(file, packing);
  scarp::write_file(material_path(file), document.dump(2) + "\n");
  write_state(folder, "packing", packing, law);
  auto const state = scarp::balance(packing, law);
  fmt::print("{}: void ratio {:.6f}, {} contacts, coordination {:.3f}, stress [Pa] xx {:.1f}, xy {:.1f}, yy {:.1f}\n",
             file.string(), packing.void_ratio(), state.contacts, scarp::coordination(packing, law).all,
             state.stress(0, 0), state.stress(0, 1), state.stress(1, 1));
}

void prepare(Test& choice) {
  with_material(choice.material, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    write_packing(choice, prepare_packing<PackingType>(choice.preparation, law), law);
  });
}

void shear(Test& choice, CLI::App const& app) {
  if (!choice.packing.empty()) {
    read_material(
        choice.packing, [&](std::string const& name) { return is_given(app, name); }, choice.material);
  }
  with_material(choice.material, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    auto packing = choice.packing.empty() ? prepare_packing<PackingType>(choice.preparation, law)
                                          : scarp::load_packing<PackingType>(choice.packing);
    run_path(std::move(packing), law, choice.path, choice.output, to_json(choice.material));
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A laboratory for packings; SUBCOMMAND --help shows its options");
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  app.set_config("--config", "", "file with sections like [shear] and lines `option = value`");
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.require_subcommand(1);
  auto* const prepare_app = app.add_subcommand("prepare", "makes a packing under isotropic pressure");
  auto* const shear_app = app.add_subcommand("shear", "sends a packing along a path");
  auto* const replay_app = app.add_subcommand("replay", "sends another code's packing along a path");
  Test prepared;
  Test sheared;
  Replay replayed;
  try {
    declare_material(*prepare_app, prepared.material);
    declare_preparation(*prepare_app, prepared.preparation);
    declare_output(*prepare_app, prepared.output, "folder for packing.packing, packing.json and tables");
    declare_test(*shear_app, sheared);
    declare_replay(*replay_app, replayed);
    app.parse(argc, argv);
  } catch (CLI::ParseError const& problem) {
    return app.exit(problem, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  try {
    if (prepare_app->parsed()) prepare(prepared);
    if (shear_app->parsed()) shear(sheared, *shear_app);
    if (replay_app->parsed()) {
      replay(replayed, {.normal_stiffness = is_given(*replay_app, "normal-stiffness"),
                        .tangential_stiffness = is_given(*replay_app, "tangential-stiffness"),
                        .friction = is_given(*replay_app, "friction")});
    }
  } catch (std::exception const& problem) {
    fmt::print(stderr, "rve_lab: {}\n", problem.what());
    return 1;
  }
  return 0;
}
