// SPDX-License-Identifier: BSL-1.0
#include <filesystem>
#include <string>
#include <vector>

#include "../shared/device/device_option.hpp"
#include "commands.hpp"
#include "options.hpp"

namespace rve_lab {

namespace {

CLI::Validator from_zero(double most) { return examples::number_from(0.0, true, most); }

std::vector<std::string> laboratory_paths() {
  return {"isotropic",
          "oedometer",
          "drained",
          "undrained",
          "constant_mean_stress",
          "simple_shear",
          "simple_shear_at_stress",
          "proportional_stress",
          "proportional_strain",
          "table"};
}

}  // namespace

void declare_test(CLI::App& app, Laboratory& test) {
  app.add_option("--material", test.provider, "what is tested")
      ->check(CLI::IsMember({"packing", "mohr-coulomb", "elastic"}));
  auto* const sand_file = examples::declare_sand_file(app, test.sand_file);
  examples::declare_sand(app, test.sand);
  auto* const packings =
      app.add_option("--packing", test.packings, "files of `prepare`, all tested alike; without, a packing is prepared")
          ->delimiter(',');
  sand_file->excludes(packings);
  app.add_option("--seeds", test.seeds, "packings that are prepared and tested alike, each with a seed of its own")
      ->check(CLI::Range(1, 100'000))
      ->excludes(packings);
  for (auto* const option : app.get_options()) {
    if (option->get_group() == "Preparation") option->excludes(packings);
  }
  auto const in = [&](char const* group) {
    return [&app, group](char const* name, auto& member, char const* what) {
      return app.add_option(name, member, what)->group(group);
    };
  };
  auto const soil = in("Mohr-Coulomb and elastic material");
  soil("--young", test.young, "Young's modulus [Pa]")->check(positive(1e15));
  soil("--poissons-ratio", test.poisson, "Poisson's ratio")->check(from_zero(0.4999));
  soil("--friction-angle", test.friction, "[degrees]")->check(from_zero(89.0));
  soil("--dilation-angle", test.dilation, "[degrees]")->check(from_zero(89.0));
  soil("--cohesion", test.cohesion, "[Pa]")->check(from_zero(1e12));
  soil("--dimension", test.dimension, "2: plane strain, 3: space")->check(CLI::IsMember({2, 3}));
  soil("--initial-void-ratio", test.void_ratio, "at the start, for the table")->check(from_zero(100.0));
  auto const path = in("Path");
  path("--path", test.path, "of the test")->check(CLI::IsMember(laboratory_paths()));
  path("--table", test.table,
       "of --path table: CSV of targets, one row after the other; exx, eyy, ezz, ev: strains, sxx, syy, szz, p: "
       "stresses "
       "[Pa], all compression positive; gxy, gzx, gyz: shear angles")
      ->check(CLI::ExistingFile);
  path("--strain", test.strain, "axial, volumetric (isotropic) or angle of shear at the end")
      ->check(examples::number_from(1e-9, true, 2.0));
  app.add_flag("--extension", test.extension, "the axis lengthens, or shear to the other side")->group("Path");
  path("--ratio", test.ratio, "of lateral to axial changes on proportional paths")
      ->check(examples::number_from(-10.0, true, 10.0));
  path("--cycles", test.cycles, "to and fro between +amplitude and -amplitude, instead of --strain")
      ->check(CLI::Range(0, 100'000));
  path("--amplitude", test.amplitude, "strain at which a cycle turns round")
      ->check(examples::number_from(1e-9, true, 1.0));
  path("--consolidation", test.consolidation, "axial stress to which the material is brought before the path [Pa]")
      ->check(positive(1e12));
  path("--consolidation-k0", test.k0, "lateral over axial stress of that")->check(positive(10.0));
  auto const how = in("Accuracy");
  how("--increment", test.increment,
      "of the path, one row each; of cycles at most a tenth of the amplitude. Not of a table, which has ten to each "
      "row")
      ->check(examples::number_from(1e-9, true, 0.05));
  how("--strain-step", test.strain_step, "largest strain of one DEM step")
      ->check(examples::number_from(1e-12, true, 1e-3));
  how("--tolerance", test.tolerance, "of held stresses, relative")->check(examples::number_from(1e-12, true, 0.1));
  how("--window", test.window, "length over which peak and residual are means; 0 for single rows")
      ->check(from_zero(1.0));
  how("--threads", test.threads,
      "that prepare and test packings, at most one for each; with --device cuda so many tests are on the card at the "
      "same time. When not given: 2, with cuda 128")
      ->check(CLI::Range(1, 1024));
  examples::declare_device(app, test.device);
  app.add_option("--overlay", test.overlays,
                 "tables drawn in the figures too: test.csv of other runs, or a laboratory's with columns as "
                 "eps1_percent, epsv_percent, q_kPa, p_kPa, void_ratio; strains as for calibrate --table")
      ->delimiter(',')
      ->check(CLI::ExistingFile)
      ->check([](std::string const& file) {
        std::error_code trouble;
        return std::filesystem::is_empty(file, trouble) ? fmt::format("'{}' is empty: leave it out", file) : "";
      });
  examples::declare_output(app, test.output, "folder for test.csv and summary.json", "--output,-o");
}

void require_used(CLI::App const& app, Laboratory const& test) {
  for (auto const* const option : app.get_options()) {
    auto const& group = option->get_group();
    auto const name = option->get_name();
    bool const of_packing = group == "Preparation" || group == "Material" || name == "--packing" || name == "--sand" ||
                            name == "--seeds" || name == "--device" || name == "--strain-step" || name == "--threads";
    bool const of_soil = group == "Mohr-Coulomb and elastic material";
    bool const of_both = name == "--pressure";
    if (!of_both && (test.is_packing() ? of_soil : of_packing))
      examples::reject_unused(app, option->get_single_name(), fmt::format("the material is '{}'", test.provider));
  }
  if (test.provider == "elastic") {
    for (auto const* name : {"friction-angle", "dilation-angle", "cohesion"})
      examples::reject_unused(app, name, "it is elastic");
  }
  if (!test.path.starts_with("proportional")) examples::reject_unused(app, "ratio", "the path is not proportional");
  if (!test.consolidation) examples::reject_unused(app, "consolidation-k0", "without --consolidation");
  if (test.path == "table") {
    if (test.table.empty()) scarp::reject("--path table has no table (its targets are unknown): give --table FILE");
    for (auto const* name : {"strain", "extension", "cycles", "amplitude"})
      examples::reject_unused(app, name, "the table has the targets");
    examples::reject_unused(app, "window", "results of a table are of single rows");
    examples::reject_unused(app, "increment", "the way to each row of a table has ten");
  } else {
    examples::reject_unused(app, "table", fmt::format("the path is '{}'", test.path));
  }
  if (test.cycles > 0) {
    examples::reject_unused(app, "strain", "--cycles go to --amplitude");
    examples::reject_unused(app, "window", "results of cycles are of single rows");
  }
  if (test.cycles == 0) examples::reject_unused(app, "amplitude", "without --cycles");
  if (examples::given_in(app)("window") && test.window > test.strain)
    scarp::reject("--window is {} (the test ends at a --strain of {}): choose a smaller window", test.window,
                  test.strain);
}

}  // namespace rve_lab
