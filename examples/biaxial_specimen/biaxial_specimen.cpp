// SPDX-License-Identifier: BSL-1.0
// How does a body of packings fail between smooth platens? Biaxial compression of any rectangular mesh.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "../shared/budget_report.hpp"
#include "../shared/packing_input.hpp"
#include "../shared/run_options.hpp"
#include "../shared/sand/options.hpp"
#include "../shared/version_option.hpp"
#include "run.hpp"
#include "scarp/io/gmsh/gmsh_reader.hpp"

namespace {

using biaxial_specimen::Choice;
using biaxial_specimen::run;

void declare_specimen(CLI::App& app, Choice& choice) {
  auto const length = examples::number_from(1e-6, true, 1e6);
  auto* const mesh =
      app.add_option("--mesh", choice.mesh,
                     "upright rectangle, a file of Gmsh: triangles or quadrilaterals, linear or quadratic")
          ->check(CLI::ExistingFile);
  app.add_option("--mesh-order", choice.mesh_order, "highest order of its elements: 1 leaves out all but corners")
      ->check(CLI::Range(1, 2))
      ->needs(mesh)
      ->capture_default_str();
  for (auto* const own : {app.add_option("--width", choice.width, "of a specimen without --mesh [m]")->check(length),
                          app.add_option("--height", choice.height, "[m]")->check(length),
                          app.add_option("--columns", choice.columns,
                                         "squares across, of four triangles each; of one Quad8 with --undrained")
                              ->check(CLI::Range(1, 1000)),
                          app.add_option("--rows", choice.rows, "and up")->check(CLI::Range(1, 1000))})
    own->excludes(mesh)->capture_default_str();
}

void declare_grains(CLI::App& app, biaxial_specimen::Grains& grains) {
  auto const positive = examples::number_from(1e-12, true, 1e15);
  auto const not_negative = examples::number_from(0.0, true, 1e3);
  auto* const particles = app.add_option("--particles", grains.particles, "table of the grains that every point has")
                              ->check(CLI::ExistingFile);
  for (auto* const of_files :
       {app.add_option("--contacts", grains.contacts, "table of their contacts: cell, law, shear forces")
            ->check(CLI::ExistingFile),
        app.add_option("--cell", grains.cell, "a1x,a1y,a2x,a2y [m]; --contacts determine it too"),
        app.add_option("--normal-stiffness", grains.normal_stiffness, "[N/m]; else of --contacts, else 6e6")
            ->check(positive),
        app.add_option("--tangential-stiffness", grains.tangential_stiffness, "[N/m]; likewise")->check(positive),
        app.add_option("--friction", grains.friction, "likewise, else 0.55")->check(not_negative)})
    of_files->needs(particles);
  for (auto* const of_prepared :
       {examples::declare_sand_file(app, grains.sand_file),
        app.add_option("--grains", grains.sand.grains, "in a packing that is prepared")->check(CLI::Range(20, 100'000)),
        app.add_option("--packings", grains.pool, "that are prepared; every point draws one")
            ->check(CLI::Range(1, 10'000)),
        app.add_option("--preparation-friction", grains.sand.preparation_friction, "sets their density")
            ->check(not_negative),
        app.add_option("--seed", grains.sand.seed, "of the packings and of who draws which")
            ->check(examples::seed_number())})
    of_prepared->excludes(particles)->capture_default_str();
  app.add_option("--density", grains.sand.density, "of the grains [kg/m3]")->check(positive)->capture_default_str();
  app.add_option("--thickness", grains.sand.thickness, "out of plane, of grains and specimen [m]")
      ->check(positive)
      ->capture_default_str();
  app.add_option("--strain-per-dem-step", grains.strain_per_dem_step)
      ->check(examples::number_from(1e-12, true, 1e-3))
      ->capture_default_str();
}

void declare_test(CLI::App& app, Choice& choice) {
  app.add_option("--confining", choice.confining, "lateral pressure [Pa], with --undrained that of grains and water")
      ->check(examples::number_from(0.0, false, 1e12))
      ->capture_default_str();
  app.add_option("--axial-strain-step", choice.axial_strain_step, "of one row, relative to the first height")
      ->check(examples::number_from(1e-9, true, 0.1))
      ->capture_default_str();
  app.add_option("--steps", choice.steps, "rows of the table after the first")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--residual", choice.residual, "unbalanced forces over reactions")
      ->check(examples::number_from(1e-13, true, 1.0))
      ->capture_default_str();
  app.add_option("--iterations", choice.iterations, "most of an attempt at a step")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  app.add_option("--max-halvings", choice.halvings, "of a step that fails, before the test is given up")
      ->check(CLI::Range(0, 30))
      ->capture_default_str();
  app.add_option("--threads", choice.threads, "0 uses all")->check(CLI::Range(0, 1024));
}

void declare_water(CLI::App& app, Choice& choice) {
  auto* const undrained = app.add_flag("--undrained", choice.undrained, "pores are full of water that nothing drains");
  auto const of_water = [&](char const* option, double& value, char const* what, CLI::Validator const& range) {
    app.add_option(option, value, what)->check(range)->needs(undrained)->capture_default_str();
  };
  of_water("--pore-pressure", choice.pore_pressure, "of the water at the start, over that of the air [Pa]",
           examples::number_from(1.0, true, 1e12));
  of_water("--grain-diameter", choice.grain_diameter, "of the permeability by Kozeny and Carman [m]",
           examples::number_from(1e-9, true, 1.0));
  of_water("--rate", choice.rate, "of the top platen [m/s]", examples::number_from(1e-12, true, 1e3));
}

void declare_results(CLI::App& app, Choice& choice, examples::Output& output) {
  auto const folder = [](std::string const& given) { return examples::folder_problem(given); };
  auto* const all = examples::declare_output(app, output, "folder of all results")->capture_default_str();
  auto* const table = app.add_option("--out", choice.table, "the table alone, instead of --output")->excludes(all);
  app.add_option("--fields", choice.fields, "folder for VTU files beside --out")->check(folder)->needs(table);
  app.add_option("--budget", choice.budget, "bounds of the error budget, part=bound, instead of the default ones")
      ->check([](std::string const& given) { return examples::bound_problem(given); });
  app.add_option("--frames", choice.frames, "VTU files over the test")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
}

#ifdef BIAXIAL_SPECIMEN_WATER
constexpr bool has_water = true;

int run_own_mesh(Choice const& choice) { return biaxial_specimen::run_undrained(choice); }

int run_file(Choice const& choice, int element) {
  if (element != scarp::Quad8::gmsh_type)
    scarp::reject(
        "'{}' holds no quadrilaterals of eight nodes (an undrained specimen has these): mesh it with them, or leave "
        "out --mesh",
        choice.mesh);
  return run_own_mesh(choice);
}
#else
constexpr bool has_water = false;

int run_own_mesh(Choice const& choice) { return run<scarp::Tri3>(choice); }

int run_file(Choice const& choice, int element) {
  switch (element) {
#ifdef BIAXIAL_SPECIMEN_EVERY_ELEMENT
    case scarp::Tri6::gmsh_type: return run<scarp::Tri6>(choice);
    case scarp::Quad4::gmsh_type: return run<scarp::Quad4>(choice);
#else
    case scarp::Tri6::gmsh_type:
    case scarp::Quad4::gmsh_type:
      scarp::reject("'{}' holds Tri6 or Quad4; expected Tri3 or Quad8. Configure with -D SCARP_BUILD_VERIFICATION=ON.",
                    choice.mesh);
#endif
    case scarp::Quad8::gmsh_type: return run<scarp::Quad8>(choice);
    default: return run_own_mesh(choice);  // rejects other elements with a message
  }
}
#endif

/// \throws InputError for a program of the other kind, and water that carries everything
void check_water(Choice const& choice) {
  if (has_water && !choice.undrained)
    scarp::reject("biaxial_specimen_water is started without --undrained: give it, or start biaxial_specimen");
  if (!has_water && choice.undrained)
    scarp::reject(
        "--undrained is given to a program without water: start it by ./examples/run, which builds "
        "biaxial_specimen_water");
  if (choice.undrained && !(choice.pore_pressure < choice.confining))
    scarp::reject(
        "--pore-pressure is {} Pa with --confining {} Pa (the grains would carry nothing): give a lower pore pressure",
        choice.pore_pressure, choice.confining);
}

int run_mesh(Choice choice) {
  check_water(choice);
  examples::reject_overwriting(choice.table, {choice.mesh, choice.grains.particles, choice.grains.contacts});
  if (choice.mesh.empty()) return run_own_mesh(choice);
  scarp::GmshFile const file(choice.mesh, {.highest_order = choice.mesh_order});
  examples::print_notes(file.notes());
  choice.mesh_file = &file;
  return run_file(choice, file.element_type());
}

/// Pictures and the error budget of an older test would be mixed up with the new ones.
void remove_older_results(std::filesystem::path const& folder) {
  for (auto const* name : {"error_budget.json", "fields.pvd"}) std::filesystem::remove(folder / name);
  if (!std::filesystem::exists(folder / "fields")) return;
  for (auto const& file : std::filesystem::directory_iterator(folder / "fields")) {
    std::string const name = file.path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".vtu")) std::filesystem::remove(file.path());
  }
}

int run_test(Choice choice, examples::Output const& output, CLI::App const& app) {
  auto& grains = choice.grains;
  if (!grains.sand_file.empty())
    grains.sand = examples::read_sand(grains.sand_file, grains.sand, examples::given_in(app));
  if (!choice.table.empty()) return run_mesh(choice);
  scarp::RunFolder own({.folder = output.folder, .overwrite = output.overwrite, .results = {"table.csv"}},
                       examples::record_of("biaxial_specimen", app));
  choice.table = (own.path() / "table.csv").string();
  choice.fields = output.folder;
  choice.begin = [&] {
    own.begin();
    remove_older_results(own.path());
  };
  choice.end = [&](std::string const& state) { own.end(state); };
  return run_mesh(choice);
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  examples::Output output{"output/biaxial_specimen"};
  CLI::App app("Compresses a rectangular body of packings between smooth platens under constant lateral pressure.");
  examples::declare_version(app);
  declare_specimen(app, choice);
  declare_grains(app, choice.grains);
  declare_test(app, choice);
  declare_water(app, choice);
  declare_results(app, choice, output);
  if (auto const code = examples::ended_by_options(app, argc, argv)) return *code;
  try {
    return run_test(choice, output, app);
  } catch (std::exception const& problem) {
    return examples::ended_by(problem, "biaxial_specimen", app);
  }
}
