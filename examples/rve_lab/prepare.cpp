// SPDX-License-Identifier: BSL-1.0
#include "commands.hpp"
#include "options.hpp"
#include "packing_output.hpp"
#include "packings.hpp"
#include "spheres.hpp"

namespace rve_lab {

void prepare(Test& choice, CLI::App const& app) {
  read_sand_file(choice, app);
  if (choice.sand.shape != "disc") examples::reject_unused(app, "format", "other codes have discs only");
  auto own = folder_of(choice.output, app, {"packing.packing"});
  if (is_in_space(choice.sand)) {
    prepare_spheres(choice, own);
  } else {
    with_packing(Grains{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
      write_packing(choice, own, Preparation<PackingType>::printed(choice.sand, law), law);
    });
  }
  own.end("finished");
}

void declare_prepare(CLI::App& app, Test& choice) {
  examples::declare_sand_file(app, choice.sand_file);
  examples::declare_sand(app, choice.sand);
  app.add_option("--format", choice.format,
                 "writes discs for another code too: yade (packing.txt) or lammps (packing.data)")
      ->check(CLI::IsMember({"yade", "lammps"}));
  examples::declare_output(app, choice.output, "folder for packing.packing, packing.sand and, in the plane, tables",
                           "--output,-o");
}

}  // namespace rve_lab
