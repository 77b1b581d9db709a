// SPDX-License-Identifier: BSL-1.0
#include "commands.hpp"
#include "options.hpp"
#include "packings.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "states.hpp"

namespace rve_lab {

namespace {

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

}  // namespace

void prepare(Test& choice, CLI::App const& app) {
  read_sand_file(choice, app);
  if (choice.sand.shape != "disc") examples::reject_unused(app, "format", "other codes have discs only");
  auto own = folder_of(choice.output, app, {"packing.packing"});
  with_packing(Grains{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    write_packing(choice, own, Preparation<PackingType>::printed(choice.sand, law), law);
  });
  own.end("finished");
}

void declare_prepare(CLI::App& app, Test& choice) {
  examples::declare_sand_file(app, choice.sand_file);
  examples::declare_sand(app, choice.sand);
  app.add_option("--format", choice.format,
                 "writes discs for another code too: yade (packing.txt) or lammps (packing.data)")
      ->check(CLI::IsMember({"yade", "lammps"}));
  examples::declare_output(app, choice.output, "folder for packing.packing, packing.sand and tables", "--output,-o");
}

}  // namespace rve_lab
