// SPDX-License-Identifier: BSL-1.0
// Where does a normal fault reach the surface of sand, and what does a footing do to it? The reference study's scenes.
#include <algorithm>
#include <chrono>
#include <map>

#include "../shared/budget_report.hpp"
#include "../shared/command_line.hpp"
#include "../shared/device/device_option.hpp"
#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "../shared/sand/options.hpp"
#include "../shared/version_option.hpp"
#include "ensemble_runs.hpp"
#include "estimate.hpp"
#include "own_folders.hpp"
#include "pilot.hpp"
#include "run_scene.hpp"
#include "scarp/io/text_lines.hpp"
#include "sensitivity_runs.hpp"
#include "site_options.hpp"

namespace {

using fault_rupture::Choice;

/// Beside the reference study's scene: a length, so that the response is not the mesh's, many packings, so that it is
/// not one packing's (docs/notes/objectivity.md), K0 of 0.4 (docs/notes/preparations.md) and fewer DEM steps.
void make_objective(Choice& choice) {
  choice.length = fault_rupture::short_length;
  choice.overconsolidation_ratio = 1.25;
  choice.packings = 16;
  choice.mirrored_packings = true;
  fault_rupture::set_few_dem_steps(choice);
}

/// No length and copies of one packing, as the reference study has it.
void make_local(Choice& choice) {
  choice.length = 0.0;
  choice.overconsolidation_ratio = 1.0;
  choice.packings = 1;
  choice.mirrored_packings = false;
  choice.max_displacement_gradient = 0.005;
  choice.strain_per_step = 1e-5;
  choice.min_dem_steps = 20;
  choice.unbalanced_tolerance = 0.05;
}

/// The same physics on a tiny mesh with few grains, copies of one packing.
void make_quick(Choice& choice) {
  choice.size = 5.0;
  choice.grains = 100;
  choice.packings = 1;
  choice.mirrored_packings = false;
  choice.min_dem_steps = 20;
  choice.quick = true;
}

/// About as many triangles as the reference study has, most of them around the rupture.
void make_study(Choice& choice) {
  choice.length = 1.0;
  choice.study = true;
}

void declare_materials(CLI::App& app, Choice& choice) {
  using examples::number_from;
  examples::declare_sand_file(app, choice.sand_file);
  app.add_option("--layer", choice.layer_files,
                 "depth=file: sand of that file from a depth [m] down, with the same contacts; several, each deeper");
  app.add_option("--preparation-friction", choice.preparation_friction, "sets the density of the packing")
      ->check(number_from(0.0, true, 10.0));
  app.add_option("--overconsolidation-ratio", choice.overconsolidation_ratio,
                 "what sand once carried over its overburden, at least 1; raises K0 (docs/notes/preparations.md)")
      ->check(number_from(1.0, true, 10.0));
  app.add_option("--grain-aspect", choice.grain_aspect, "width over length of the grains, ellipses of the same lengths")
      ->check(number_from(0.1, true, 1.0));
  app.add_option("--grain-friction", choice.grain_friction, "coefficient between grains")
      ->check(number_from(0.0, true, 10.0));
  app.add_option("--peak-friction-angle", choice.peak_friction_angle, "angle of Mohr-Coulomb ground [degrees]")
      ->check(number_from(0.0, false, 89.0));
  app.add_option("--peak-dilation-angle", choice.peak_dilation_angle, "angle of Mohr-Coulomb ground [degrees]")
      ->check(number_from(0.0, true, 89.0));
  app.add_option("--residual-friction-angle", choice.residual_friction_angle,
                 "angle of Mohr-Coulomb ground [degrees]; without, the peak's less 0.8 of the dilation (Bolton)")
      ->check(number_from(0.0, true, 89.0));
  app.add_option("--softening-strain", choice.softening_strain,
                 "plastic shear strain over which Mohr-Coulomb ground falls from peak to residual strength")
      ->check(number_from(0.0, false, 100.0));
  app.add_option("--young-modulus", choice.young_modulus, "of ground without packings [Pa]")
      ->check(number_from(0.0, false, 1e12));
  app.add_option("--k0", choice.k0, "of ground without packings: horizontal over vertical stress before faulting")
      ->check(number_from(0.0, false, 10.0));
}

/// The sand of a file, but for what other options give. Its values are recorded as if they were the defaults.
void read_sand(CLI::App& app, Choice& choice) {
  if (choice.sand_file.empty()) return;
  if (choice.soil != fault_rupture::Soil::dem)
    scarp::reject("--sand '{}' is not used (ground of --soil dem alone has grains): leave one of the two out",
                  choice.sand_file);
  std::map<std::string, std::string> const options{{"aspect", "--grain-aspect"},
                                                   {"friction", "--grain-friction"},
                                                   {"grains", "--grains"},
                                                   {"seed", "--seed"},
                                                   {"preparation-friction", "--preparation-friction"},
                                                   {"overconsolidation-ratio", "--overconsolidation-ratio"}};
  auto const is_given = [&](std::string const& name) {
    if (name == "grains" && app.count("--quick") > 0) return true;
    if (name == "seed" && app.count("--seeds") > 0) return true;
    if (name == "overconsolidation-ratio" && app.count("--local") > 0) return true;
    auto const option = options.find(name);
    return option != options.end() && app.count(option->second) > 0;
  };
  choice.sand = examples::read_sand(choice.sand_file, fault_rupture::sand_of(choice), is_given);
  auto const& sand = choice.sand;
  choice.grains = sand.grains;
  choice.seed = sand.seed;
  choice.preparation_friction = sand.preparation_friction;
  choice.overconsolidation_ratio = sand.overconsolidation_ratio;
  choice.grain_aspect = sand.aspect;
  choice.grain_friction = sand.friction;
  examples::for_each_option(sand, [&](std::string const& name, auto const& value, examples::Range, char const*) {
    auto const option = options.find(name);
    if (option != options.end() && app.count(option->second) == 0)
      app.get_option(option->second)->default_str(fmt::format("{}", value));
  });
  if (choice.water_table && sand.conductivity > 0.0 && app.count("--conductivity") == 0) {
    auto const flow = scarp::KozenyCarman::of_conductivity(sand.conductivity, sand.conductivity_void_ratio);
    choice.conductivity = flow.mobility(choice.void_ratio) * flow.water.unit_weight;
    app.get_option("--conductivity")->default_str(fmt::format("{}", choice.conductivity));
  }
  static_cast<void>(fault_rupture::sand_of(choice));  // other shapes and laws are rejected now
}

void declare_options(CLI::App& app, Choice& choice, examples::Output& output, std::string& element,
                     std::vector<std::uint64_t>& seeds) {
  using namespace fault_rupture;
  using examples::add_named;
  using examples::number_from;
  add_named<Case>(app, "--case", choice.scene, "free (field), heavy or light footing",
                  {{"free", Case::free}, {"heavy", Case::heavy}, {"light", Case::light}});
  add_named<Soil>(app, "--soil", choice.soil, "dem (a packing in every element), mohr_coulomb or elastic",
                  {{"dem", Soil::dem}, {"mohr_coulomb", Soil::mohr_coulomb}, {"elastic", Soil::elastic}});
  add_named<Base>(app, "--footing", choice.base, "tied (elastic block, shares nodes) or frictional (rigid, may lift)",
                  {{"tied", Base::tied}, {"frictional", Base::frictional}});
  fault_rupture::declare_site(app, choice);
  app.add_option("--footing-centre", choice.footing_centre,
                 "x [m]; where it is not given 0.16 depths right of where the fault's own line comes out")
      ->check(fault_rupture::place());
  app.add_option("--footing-width", choice.footing_width, "[m]")->check(number_from(0.0, false, 1e6));
  app.add_option("--bearing-pressure", choice.bearing_pressure, "[Pa]; 0 takes the case's own, 91 or 37 kPa")
      ->check(number_from(0.0, true, 1e7));
  app.add_option("--base-friction", choice.base_friction, "coefficient of a frictional footing")
      ->check(number_from(0.0, true, 10.0));
  app.add_flag("--quick")
      ->description("tiny mesh and few grains; other options still apply")
      ->configurable(false)
      ->disable_flag_override();
  app.add_flag("--local")
      ->description("no length and copies of one packing, as in the reference study; other options still apply")
      ->configurable(false)
      ->disable_flag_override();
  auto* const study =
      app.add_flag("--study")
          ->description(
              "a length of 1 m: about as many triangles as the reference study's 7563, most of them around the "
              "rupture; other options still apply")
          ->configurable(false)
          ->disable_flag_override();
  app.add_option("--size", choice.size,
                 "width of a mesh cell in the band [m]; with --strip-width size of the elements in the strip")
      ->check(number_from(0.0, false, 25.0));
  app.add_option("--strip-width", choice.strip_width,
                 "width of the strip of small elements around what a pilot run strains, frictional ground on a coarse "
                 "mesh [m]; 0 for a uniform mesh, or that of --mesh as it is; a --length below 6 m (depth 25 m) or "
                 "below what --mesh resolves chooses it, and --size")
      ->check(number_from(0.0, true, 1e3));
  for (char const* other : {"--quick", "--local", "--size", "--strip-width"}) study->excludes(app.get_option(other));
  app.add_option("--elements", choice.elements, "wanted number of elements instead of --size")
      ->check(CLI::Range(100, 1'000'000))
      ->excludes(study)
      ->excludes("--size")
      ->excludes("--strip-width");
  app.add_option("--element", element, "compiled in: examples/run builds and runs the program of the one that is named")
      ->check(CLI::IsMember({"tri3", "tri6", "quad4", "quad8"}));
  add_named<MeshPattern>(
      app, "--pattern", choice.pattern,
      "of the mesh: crossed, left or right (diagonals), quads, or jittered; crossed, or quads for quadrilaterals",
      {{"crossed", MeshPattern::crossed},
       {"left", MeshPattern::left},
       {"right", MeshPattern::right},
       {"quads", MeshPattern::quads},
       {"jittered", MeshPattern::jittered}});
  app.add_option("--aspect", choice.aspect, "height of a mesh cell over its width")
      ->check(number_from(0.0, false, 10.0));
  app.add_option("--mesh-seed", choice.mesh_seed, "of a jittered mesh")->check(examples::seed_number());
  auto* const file =
      app.add_option("--mesh", choice.mesh,
                     "Gmsh file: region soil; boundaries left, right, bottom, surface, by place where it has no groups")
          ->check(CLI::ExistingFile);
  app.add_option("--mesh-order", choice.mesh_order, "highest order of elements of --mesh: 1 leaves out all but corners")
      ->check(CLI::Range(1, 2))
      ->needs(file);
  for (char const* made_mesh : {"--depth", "--left", "--width", "--elements", "--pattern", "--aspect", "--mesh-seed"})
    file->excludes(app.get_option(made_mesh));
  file->excludes(study);
  app.add_option(
         "--length", choice.length,
         "intrinsic length [m]: radius of the means that points see; 0 for none, as in the reference study; "
         "where it is not given and the depth is 25 m: 2, 1 with --study, 8 with --quick, --size, --elements or "
         "--strip-width 0; with --mesh what its elements resolve")
      ->check(number_from(0.0, true, 1e3));
  app.add_option("--grains", choice.grains, "grains in each RVE")->check(CLI::Range(1, 100'000));
  app.add_option("--packings", choice.packings,
                 "columns of packings, each of its own grains, of which every point draws one")
      ->check(CLI::Range(1, 100'000));
  add_named<bool>(app, "--mirrored-packings", choice.mirrored_packings,
                  "whether points draw among the mirror images of these too", {{"yes", true}, {"no", false}});
  auto* const seed = app.add_option("--seed", choice.seed, "of the packings")->check(examples::seed_number());
  app.add_option_function<std::string>(
         "--seeds",
         [&seeds](std::string const& given) {
           for (auto const& item : examples::list_items(given)) seeds.push_back(std::stoull(item));
         },
         "several packings at once, as 1,2,3: each in a folder of its own, and mean and scatter of all measures")
      ->check(examples::each_of_list(examples::seed_number()))
      ->excludes(seed);
  declare_materials(app, choice);
  app.add_option("--throw-over-depth", choice.throw_over_depth, "h/H at the end")->check(number_from(1e-9, true, 1.0));
  app.add_option("--dip", choice.dip, "of the fault [degrees]")->check(number_from(1.0, true, 90.0));
  app.add_flag("--reverse", choice.reverse, "the hanging wall is pushed up the fault plane");
  app.add_option("--tip", choice.tip, "x of the fault at bedrock [m]; places that are not given follow it")
      ->check(fault_rupture::place());
  app.add_option("--tolerance", choice.tolerance,
                 "force residual over reactions; packings 1e-2, Mohr-Coulomb 1e-8, else 1e-10")
      ->check(number_from(1e-13, true, 1.0));
  app.add_option("--max-displacement-gradient", choice.max_displacement_gradient,
                 "displacement gradient that limits a load step; 0.0025 with packings, else 0.02")
      ->check(number_from(1e-12, true, 0.2));
  app.add_option("--max-iterations", choice.max_iterations, "of a load step")->check(CLI::Range(1, 10'000));
  app.add_option("--strain-per-dem-step", choice.strain_per_step, "strain of one DEM step")
      ->check(number_from(1e-12, true, 1e-3));
  app.add_option("--min-dem-steps", choice.min_dem_steps, "of one response")->check(CLI::Range(1, 20'000));
  app.add_option("--unbalanced-tolerance", choice.unbalanced_tolerance,
                 "tolerance on the unbalanced force ratio of every packing")
      ->check(number_from(1e-12, true, 1.0));
  app.add_option("--threads", choice.threads, "of each process; 0 uses all processors")->check(CLI::Range(0, 1024));
  examples::declare_device(app, choice.device);
  app.add_option("--frames", choice.frames, "VTU files over the run")->check(CLI::Range(1, 100'000));
  app.add_option("--probe-a-x", choice.probe_a_x, "probe A, in the band [m]")->check(fault_rupture::place());
  app.add_option("--probe-a-y", choice.probe_a_y, "height above bedrock [m]")->check(fault_rupture::place());
  app.add_option("--probe-b-x", choice.probe_b_x, "probe B, outside [m]")->check(fault_rupture::place());
  app.add_option("--probe-b-y", choice.probe_b_y, "height above bedrock [m]")->check(fault_rupture::place());
  app.add_option("--time-limit", choice.time_limit, "stop after so many seconds, preparation and all; 0 for none")
      ->check(number_from(0.0, true, 1e9));
  app.add_option("--budget", choice.budget, "bounds of the error budget, part=bound, instead of the default ones")
      ->check([](std::string const& given) { return examples::bound_problem(given); });
  app.add_flag(
         "--sensitivity-runs", choice.sensitivity_runs,
         "run the scene again on a mesh of other directions and once with smaller load steps, for the error budget")
      ->configurable(false);
  app.add_option("--sensitivity-file", choice.sensitivity_file,
                 "file of what such runs came to: read, and with them written")
      ->check([](std::string const& given) {
        auto const folder = std::filesystem::path(given).parent_path();
        return folder.empty() || std::filesystem::is_directory(folder)
                   ? std::string()
                   : fmt::format("there is no folder '{}' (the file would lie in it): create it first",
                                 folder.string());
      });
  auto* const folder =
      app.add_option("--checkpoint", choice.checkpoint,
                     "folder for checkpoints of the run, also made on Ctrl-C and at the time limit; empty for none")
          ->check([](std::string const& given) { return given.empty() ? "" : examples::folder_problem(given); });
  auto* const resume =
      app.add_flag("--resume", choice.resume, "resume from the newest checkpoint there; start anew where there is none")
          ->needs(folder)
          ->configurable(false);
  app.add_flag("--estimate")
      ->description("print the time and memory that the whole run would need, and end")
      ->configurable(false)
      ->disable_flag_override();
  app.add_option("--checkpoint-every", choice.checkpoint_every, "seconds between two checkpoints")
      ->check(number_from(0.0, true, 1e9));
  examples::declare_output(app, output, "folder for all results");
  resume->excludes("--overwrite");
  examples::declare_config(app);
}

/// The sands below that of the surface, as --sand reads one. Depth and ends of the ground are known.
void read_layers(CLI::App const& app, Choice& choice) {
  if (choice.layer_files.empty()) return;
  if (choice.soil != fault_rupture::Soil::dem)
    scarp::reject("--layer '{}' is not used (layers are those of --soil dem): leave one of the two out",
                  choice.layer_files.front());
  auto const is_given = [&](std::string_view name) {
    return name == "grains" || name == "seed" || (name == "overconsolidation-ratio" && app.count("--local") > 0);
  };
  auto const surface = fault_rupture::sand_of(choice);
  double above = 0.0;
  for (auto const& given : choice.layer_files) {
    auto const equals = std::min(given.find('='), given.size());
    double top = 0.0;
    if (equals + 1 >= given.size() || scarp::read_number(given.substr(0, equals), top) != std::errc{})
      scarp::reject("--layer is '{}' (a depth [m], '=' and the file of a sand are expected): write 8=dense.sand",
                    given);
    if (!(top > above && top < choice.depth))
      scarp::reject("--layer '{}' begins {} m deep; expected more than {} and less than {} m: give the layers in order",
                    given, top, above, choice.depth);
    Choice usual;
    usual.overconsolidation_ratio = choice.overconsolidation_ratio;
    auto const sand = examples::read_sand(given.substr(equals + 1), fault_rupture::sand_of(usual), is_given);
    for (auto const& [option, before, now] : examples::other_grains(surface, sand)) {
      scarp::reject("--layer '{}' has {} {}, the ground above it {} (all layers have the same contacts): give the same",
                    given, option, now, before);
    }
    if (choice.water_table && sand.conductivity > 0.0 && fault_rupture::rank() == 0)
      examples::print(stderr, "warning: the conductivity of --layer '{}' is not used: all ground has --conductivity\n",
                      given);
    choice.layers.push_back({above = top, sand});
  }
}

/// Names options that were given and that nothing of the scene uses.
void warn_of_unused(CLI::App const& app, Choice const& choice) {
  using namespace fault_rupture;
  auto const unused = [&](bool nothing_uses, char const* why, std::initializer_list<char const*> options) {
    if (nothing_uses) examples::warn_of_unused(app, why, options);
  };
  unused(choice.scene == Case::free, "the free field has no footing: --case",
         {"--footing", "--footing-centre", "--footing-width", "--bearing-pressure"});
  unused(choice.scene == Case::free || choice.base == Base::tied, "no frictional footing stands on the ground",
         {"--base-friction"});
  unused(choice.soil == Soil::dem, "that of packings follows from their grains", {"--k0", "--young-modulus"});
  unused(choice.soil != Soil::mohr_coulomb, "the ground is not of --soil mohr_coulomb",
         {"--peak-friction-angle", "--peak-dilation-angle", "--residual-friction-angle", "--softening-strain"});
  unused(choice.soil != Soil::dem, "the ground has no packings",
         {"--grains", "--packings", "--mirrored-packings", "--seed", "--preparation-friction",
          "--overconsolidation-ratio", "--grain-aspect", "--grain-friction", "--strain-per-dem-step", "--min-dem-steps",
          "--unbalanced-tolerance", "--device"});
  unused(choice.pattern != MeshPattern::jittered, "the mesh is not of --pattern jittered", {"--mesh-seed"});
  unused(choice.checkpoint.empty(), "there is no --checkpoint", {"--checkpoint-every"});
  for (auto const& bound : choice.budget) {
    bool const of_packings = bound.starts_with("volume=") && choice.soil != Soil::dem;
    bool const of_water = bound.starts_with("water=") && !choice.water_table;
    if (of_packings || of_water)
      examples::print(stderr, "warning: --budget {} has no effect (the ground {}): leave it out\n", bound,
                      of_packings ? "has no packings" : "is dry");
  }
}

/// Prepares and writes nothing.
/// runs: as many with different packings
void print_estimate(Choice const& choice, std::size_t runs) {
  int const ranks = fault_rupture::ranks();
  scarp::ThreadExecutor const threads(fault_rupture::threads_of_a_process(choice.threads));
  examples::print(stdout, "{}",
                  fault_rupture::estimate(choice, fault_rupture::size_of_scene(choice), ranks, threads.threads()));
  if (runs > 0) examples::print(stdout, "--seeds: {} times as much of all\n", runs);
}

}  // namespace

int main(int argc, char** argv) {
  auto const started = std::chrono::steady_clock::now();
  fault_rupture::Session const session(argc, argv);
  Choice choice;
  // Flags that change defaults, which must be in place before the other options are read.
  make_objective(choice);
  auto const given = [&](std::string_view flag) {
    // Another value than true is rejected later.
    return std::any_of(argv + 1, argv + argc,
                       [&](std::string_view word) { return word == flag || word == fmt::format("{}=true", flag); });
  };
  if (given("--local")) make_local(choice);
  if (given("--quick")) make_quick(choice);
  if (given("--study")) make_study(choice);
  CLI::App app(
      "Fault rupture below level ground or a footing: finite elements, with a discrete-element packing in each.");
  examples::declare_version(app);
  app.option_defaults()->always_capture_default();
  std::string element = fault_rupture::element_name;
  examples::Output output{"output/fault_rupture"};
  std::vector<std::uint64_t> seeds;
  declare_options(app, choice, output, element, seeds);
  try {
    examples::parse(app, argc, argv);
  } catch (CLI::ParseError const& error) {
    int const code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  if (element != fault_rupture::element_name) {
    examples::print(stderr,
                    "fault_rupture: --element {} (this program was compiled for {}): build and run the one for it by "
                    "./examples/run fault_rupture --element {}\n",
                    element, fault_rupture::element_name, element);
    fault_rupture::give_up(2);
  }
  try {
    read_sand(app, choice);
    fault_rupture::choose_places(app, choice);
    read_layers(app, choice);
    fault_rupture::choose_length_and_sizes(app, choice);
    fault_rupture::require_balance(choice);
    if (fault_rupture::rank() == 0) {
      warn_of_unused(app, choice);
      fault_rupture::warn_of_ends(choice);
    }
    if (choice.strip_width > 0.0) {
      fault_rupture::run_pilot(choice);
      if (fault_rupture::rank() == 0) fault_rupture::warn_of_idle_strip(choice);
    }
    if (app.count("--estimate") > 0) {
      if (fault_rupture::rank() == 0) print_estimate(choice, seeds.size());
      return 0;
    }
    // Folders are for the root rank; when it gives up, the others end with it.
    bool const first = fault_rupture::rank() == 0;
    if (choice.sensitivity_runs && fault_rupture::ranks() > 1)
      scarp::reject("--sensitivity-runs was given on {} ranks (sensitivity runs run on one): leave the ranks out",
                    fault_rupture::ranks());
    if (!seeds.empty()) return fault_rupture::EnsembleRuns{app, output, started}.run(choice, seeds);
    fault_rupture::OwnFolders own(choice, app, output.folder, output.overwrite,
                                  examples::record_of("fault_rupture", app));
    std::filesystem::path const known = choice.sensitivity_file.empty()
                                            ? fault_rupture::default_sensitivity_file()
                                            : std::filesystem::path(choice.sensitivity_file);
    static_cast<void>(fault_rupture::SensitivityFile(known, ""));  // a wrong file is rejected before the ground is made
    auto const scene = fault_rupture::make_scene(choice, fault_rupture::ranks(), first);
    fault_rupture::SensitivityFile sensitivity(known, fault_rupture::scene_lines(choice, app, scene));
    auto const run_sensitivity = [&](scarp::RunReport const& report) {
      if (choice.sensitivity_runs) {
        fault_rupture::SensitivityRuns const runs{app, output.folder, started};
        runs.complete(sensitivity_runs_of(choice, scene.stages.stepping.max_displacement_gradient), report.steps,
                      sensitivity);
      }
      return sensitivity.results();
    };
    fault_rupture::Start const start{own.files, own.on_root_rank(), started, run_sensitivity};
    return run(choice, scene, start);
  } catch (std::exception const& error) {
    fault_rupture::give_up(examples::ended_by(error, "fault_rupture", app));
  }
}
