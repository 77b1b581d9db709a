// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "../shared/command_line.hpp"
#include "choices.hpp"
#include "material_file.hpp"
#include "paths.hpp"

namespace rve_lab {

inline CLI::Validator positive(double most) { return examples::number_from(0.0, false, most); }
inline CLI::Validator not_negative(double most) { return examples::number_from(0.0, true, most); }

inline void declare_material(CLI::App& app, Material& material) {
  for_each_parameter(material, [&](std::string const& name, auto& member, char const* what) {
    auto* const option = app.add_option("--" + name, member, what)->group("Material");
    if (name == "shape") {
      option->check(CLI::IsMember({"disc", "ellipse", "superellipse"}));
    } else if (name == "law") {
      option->check(CLI::IsMember({"linear", "hertz", "rolling"}));
    } else if (name == "normal-stiffness" || name == "modulus") {
      option->check(positive(1e15));
    } else {
      option->check(not_negative(name == "poisson" ? 0.5 : 1e15));
    }
  });
}

inline void declare_preparation(CLI::App& app, Preparation& choice) {
  auto const add = [&](char const* name, auto& member, char const* what) {
    return app.add_option(name, member, what)->group("Preparation");
  };
  add("--smallest", choice.smallest, "radius or major half axis [m]")->check(positive(1e3));
  add("--largest", choice.largest, "radius or major half axis [m]")->check(positive(1e3));
  add("--aspect", choice.aspect, "minor over major half axis of ellipses and superellipses")->check(positive(1.0));
  add("--exponent", choice.exponent, "of superellipses: 1 is an ellipse, towards 0 a rectangle")->check(positive(2.0));
  add("--grains", choice.grains, "number")->check(CLI::Range(1, 100'000));
  add("--seed", choice.seed, "of the random cloud")->check(examples::seed_number());
  add("--density", choice.density, "of the grains [kg/m3]")->check(positive(1e9));
  add("--thickness", choice.thickness, "out of plane [m]")->check(positive(1e3));
  add("--pressure", choice.pressure, "isotropic, at the end [Pa]")->check(positive(1e12));
  auto* const friction = add("--preparation-friction", choice.friction, "during consolidation, sets the density")
                             ->check(not_negative(10.0));
  add("--target-void-ratio", choice.target_void_ratio, "found by bisection on the preparation friction")
      ->check(positive(10.0))
      ->excludes(friction);
  add("--void-ratio-tolerance", choice.void_ratio_tolerance, "of that")->check(positive(1.0));
}

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
                     "file of `prepare`; its material, in the .json of the same name, counts where no option is given. "
                     "Without: a packing is prepared");
  declare_material(app, test.material);
  declare_preparation(app, test.preparation);
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
  app.add_option("--normal-stiffness", replay.material.normal_stiffness, "instead of kn [N/m]")->check(positive(1e15));
  app.add_option("--tangential-stiffness", replay.material.tangential_stiffness, "instead of ks [N/m]")
      ->check(not_negative(1e15));
  app.add_option("--friction", replay.material.friction, "instead of tan_phi")->check(not_negative(1e3));
  app.add_option("--density", replay.density, "of the grains [kg/m3]")->check(positive(1e9));
  app.add_option("--thickness", replay.thickness, "out of plane [m]")->check(positive(1e3));
  app.add_option("--relax", replay.relaxation,
                 "isotropic pressure under which the packing comes to rest before the path [Pa], no shear strain: for "
                 "files without shear forces")
      ->check(positive(1e12));
  app.add_option("--tolerance", replay.tolerance, "of the overlaps in --contacts, over the smallest radius")
      ->check(positive(1.0));
  app.add_option("--out", replay.out, "table to write")->required();
}

/// \throws InputError for an option that was given and is not used
inline void reject_unused(CLI::App const& app, std::string const& name, std::string_view why) {
  auto const* const option = app.get_option_no_throw("--" + name);
  if (option == nullptr || option->count() == 0) return;
  scarp::reject("--{} is given but not used ({}): leave it out", name, why);
}

/// \throws InputError for options of a path that it has no use for
inline void require_used(CLI::App const& app, Path const& path) {
  if (path_named(path.name).held == nullptr)
    reject_unused(app, "lateral-stress", fmt::format("the path '{}' holds no stress", path.name));
  if (path.cycles > 0) reject_unused(app, "strain", "--cycles go to --amplitude");
  if (path.cycles == 0) reject_unused(app, "amplitude", "without --cycles");
}

/// \throws InputError for options of a material that it has no use for
inline void require_used(CLI::App const& app, Material const& material) {
  auto const used = parameters_of(material.law);
  for_each_parameter(material, [&](std::string const& name, auto const&, char const*) {
    if (std::find(used.begin(), used.end(), name) == used.end())
      reject_unused(app, name, fmt::format("the law is '{}'", material.law));
  });
  auto const of_shape = fmt::format("grains are of the shape '{}'", material.shape);
  if (material.shape == "disc") reject_unused(app, "aspect", of_shape);
  if (material.shape != "superellipse") reject_unused(app, "exponent", of_shape);
  if (app.get_option_no_throw("--target-void-ratio") != nullptr && app.count("--target-void-ratio") == 0)
    reject_unused(app, "void-ratio-tolerance", "without --target-void-ratio");
}

/// Whether an option stands on the command line or in the configuration file.
inline bool is_given(CLI::App const& app, std::string const& name) { return app.count("--" + name) > 0; }

}  // namespace rve_lab
