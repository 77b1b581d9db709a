// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "../shared/sand/options.hpp"
#include "choices.hpp"
#include "paths.hpp"

namespace rve_lab {

inline CLI::Validator positive(double most) { return examples::number_from(0.0, false, most); }

inline void declare_path(CLI::App& app, Path& path) {
  auto const add = [&](char const* name, auto& member, char const* what) {
    return app.add_option(name, member, what)->group("Path");
  };
  add("--path", path.name, "of the deformation")->check(CLI::IsMember(path_names()));
  add("--strain", path.strain, "at the end, along the path")->check(positive(2.0));
  add("--strain-step", path.strain_step, "strain of one DEM step")->check(examples::number_from(1e-12, true, 1e-3));
  add("--lateral-stress,--held-stress", path.held,
      "held by biaxial (lateral), simple_shear_at_stress (vertical), constant_mean_stress (mean) [Pa, compression "
      "positive]; otherwise that of the packing")
      ->check(positive(1e12));
}

inline void declare_test(CLI::App& app, Test& test) {
  declare_path(app, test.path);
  app.add_option("--row-strain", test.path.row_strain, "between rows; a 200th of the path when not given")
      ->check(positive(2.0))
      ->group("Path");
  app.add_option("--cycles", test.path.cycles, "to and fro between +amplitude and -amplitude, instead of --strain")
      ->check(CLI::Range(0, 100'000))
      ->group("Path");
  app.add_option("--amplitude", test.path.amplitude, "strain at which a cycle turns round")
      ->check(positive(1.0))
      ->group("Path");
  auto* const packing =
      app.add_option("--packing", test.packing,
                     "file of `prepare`; its sand, in the .sand of the same name, counts where no option is given. "
                     "Without: a packing is prepared");
  examples::declare_sand_file(app, test.sand_file)->excludes(packing);
  examples::declare_sand(app, test.sand);
  for (auto* const option : app.get_options()) {
    if (option->get_group() == "Preparation") option->excludes(packing);  // it has been prepared
  }
  examples::declare_output(app, test.output, "folder for path.csv and the states at start, peak and end",
                           "--output,-o");
}

inline void declare_replay(CLI::App& app, Replay& replay) {
  app.add_option("--particles", replay.particles,
                 "CSV: id, x, y and r, or a, b, angle (and eps); discs also as text of Yade, data or dump of LAMMPS, "
                 "restart of "
                 "MercuryDPM")
      ->required();
  app.add_option(
      "--contacts", replay.contacts,
      "CSV: id1, id2, cell_i, cell_j; ftx, fty give shear forces, kn, ks, tan_phi the law, branches the cell");
  app.add_option("--cell", replay.cell,
                 "a1x,a1y,a2x,a2y: base vectors [m]; otherwise from the contacts, or the particles' file");
  declare_path(app, replay.path);
  app.get_option("--path")->required();
  app.get_option("--strain")->required();
  app.add_option("--row-strain", replay.path.row_strain,
                 "between rows; 5e-5 for isotropic and 1e-4 else when not given")
      ->check(positive(2.0))
      ->group("Path");
  app.add_option("--normal-stiffness", replay.sand.normal_stiffness, "instead of kn [N/m]")->check(positive(1e15));
  app.add_option("--tangential-stiffness", replay.sand.tangential_stiffness, "instead of ks [N/m]")
      ->check(examples::number_from(0.0, true, 1e15));
  app.add_option("--friction", replay.sand.friction, "instead of tan_phi")
      ->check(examples::number_from(0.0, true, 1e3));
  app.add_option("--density", replay.sand.density, "of the grains [kg/m3]")->check(positive(1e9));
  app.add_option("--thickness", replay.sand.thickness, "out of plane [m]")->check(positive(1e3));
  app.add_option("--relax", replay.relaxation,
                 "isotropic pressure under which the packing comes to rest before the path [Pa], no shear strain: for "
                 "files without shear forces")
      ->check(positive(1e12));
  app.add_option("--tolerance", replay.tolerance, "of the overlaps in --contacts, over the smallest radius")
      ->check(positive(1.0));
  app.add_option("--out", replay.out, "table to write")->required();
}

/// \throws InputError for options of a path that it has no use for
inline void require_used(CLI::App const& app, Path const& path) {
  if (path_named(path.name).held == nullptr)
    examples::reject_unused(app, "lateral-stress", fmt::format("the path '{}' holds no stress", path.name));
  if (path.cycles > 0) examples::reject_unused(app, "strain", "--cycles go to --amplitude");
  if (path.cycles == 0) examples::reject_unused(app, "amplitude", "without --cycles");
}

}  // namespace rve_lab
