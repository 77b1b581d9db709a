// SPDX-License-Identifier: BSL-1.0

#include "../shared/sand/grading.hpp"
#include "../shared/sand/options.hpp"
#include "calibration_report.hpp"
#include "calibration_search.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "packings.hpp"

namespace rve_lab {

namespace {

bool is_density(std::string const& name) { return examples::sets_density(name); }

/// The tests hold the stress of the tables, which is to be one. given: that of the option
/// \throws InputError for another one
void take_held_stress(LabTable const& table, std::optional<double> given, std::optional<double>& held) {
  constexpr double alike = 0.1;
  if (given && (table.held.empty() || table.has_ratio)) return;
  auto const own = table.held_stress();
  if (!own && !given && !held)
    scarp::reject("'{}' has no q and p (the stress that its test held is not known): give --lateral-stress",
                  table.file);
  if (own && held && std::abs(*own / *held - 1.0) > alike)
    scarp::reject("the test of '{}' holds {:.4g} Pa by its q and p, {} {:.4g} Pa (a calibration has one stress): {}",
                  table.file, *own, given ? "--lateral-stress is" : "another table's", *held,
                  given ? "leave the option out, or name the columns q_kPa and p_kPa where they are in kPa"
                        : "calibrate on one of them");
  if (own && !held) held = own;
}

Calibration calibration_of(CalibrateChoice& choice, CLI::App const& app) {
  if (!choice.sand_file.empty())
    choice.sand = examples::read_sand(choice.sand_file, choice.sand, examples::given_in(app));
  if (!choice.sand.sieve.empty()) static_cast<void>(examples::sieve_curve(choice.sand.sieve));  // rejects other text
  if (is_in_space(choice.sand)) {
    examples::reject_unused(app, "path", "spheres are tested in drained triaxial compression");
    choice.test.path = triaxial_path().name;
    choice.triaxial = true;
  }
  require_built(choice.sand);
  if (choice.free.empty())
    choice.free = std::string("friction,relative-density,") +
                  (choice.sand.law.ends_with("hertz") ? "modulus" : "normal-stiffness");
  Calibration all{.start = choice.sand,
                  .free = free_parameters(choice.free, choice.sand),
                  .test = choice.test,
                  .window = choice.window,
                  .seeds = choice.seeds,
                  .evaluations = choice.evaluations,
                  .threads = choice.threads,
                  .run = curve_of};
  for (auto const& one : all.free) {
    if (is_density(one.name)) all.start.preparation_friction = all.start.void_ratio = all.start.relative_density = 0.0;
  }
  for (auto const& one : all.free) {
    one.of(all.start) = one.of(choice.sand);
    if (!is_density(one.name)) continue;
    if (one.begins_above_zero() && one.of(all.start) == 0.0) one.of(all.start) = one.at(0.5);  // 0: not used
    for (char const* other : {"preparation-friction", "void-ratio", "relative-density"}) {
      if (one.name != other) examples::reject_unused(app, other, fmt::format("--free names {}", one.name));
    }
  }
  if (auto const densities = std::ranges::count_if(all.free, [](Free const& one) { return is_density(one.name); });
      densities > 1)
    scarp::reject("--free names {} parameters that set the density: leave one", densities);
  all.observations = targets(choice.target, choice.window);
  double last = 0.0;
  for (auto const& file : choice.tables) {
    auto const table = LabTable::read(file, choice.triaxial, choice.test.path == "constant_mean_stress");
    take_held_stress(table, choice.test.held, all.test.held);
    last = std::max(last, table.strain.back());
    auto const more = observations_of(table, all.observations.empty() ? 0 : all.groups());
    all.observations.insert(all.observations.end(), more.begin(), more.end());
  }
  if (all.observations.empty()) scarp::reject("there is nothing to calibrate on: give --target or --table");
  if (choice.strain && *choice.strain < last * (1.0 - 1e-9))
    scarp::reject("--strain is {} (the tables go to {}): give that or more, or shorten the tables", *choice.strain,
                  last);
  if (choice.tables.empty()) examples::reject_unused(app, "triaxial", "without --table");
  bool const windowed = std::ranges::any_of(all.observations, &Observation::windowed);
  if (!windowed) examples::reject_unused(app, "window", "no target is a mean over it");
  all.test.strain = choice.strain.value_or(last > 0.0 ? last : 0.1);
  if (double const least = 3.0 * all.test.row_strain; all.test.strain < least)
    scarp::reject("the tests end at an axial strain of {} (at least {} is expected): give --strain", all.test.strain,
                  least);
  if (windowed && all.test.strain < choice.window)
    scarp::reject("the tests end at an axial strain of {}, below the --window {}: give a larger --strain",
                  all.test.strain, choice.window);
  for (auto const& one : all.free) {
    if (auto const why = examples::why_unused(all.start, one.name); !why.empty())
      scarp::reject("--free names {}, which this sand does not use ({}): leave it out", one.name, why);
  }
  return all;
}

/// What a resumed calibration must have in common with the one before.
std::string settings_of(Calibration const& calibration) {
  std::string text = examples::text_of(calibration.start);
  for (auto const& one : calibration.free) text += fmt::format("free {} {} {}\n", one.name, one.least, one.most);
  for (auto const& one : calibration.observations) text += fmt::format("{} {} {}\n", one.name, one.strain, one.wanted);
  auto const& test = calibration.test;
  return text + fmt::format("{} {} {} {} {} window {} seeds {}\n{}\n", test.path, test.held.value_or(0.0), test.strain,
                            test.strain_step, test.row_strain, calibration.window, calibration.seeds,
                            examples::commit());
}

/// \return whether there is anything to resume
bool resumes(std::filesystem::path const& folder, std::string const& settings) {
  auto const file = folder / "settings.txt";
  if (!std::filesystem::exists(file) || !std::filesystem::exists(folder / "evaluations.csv")) return false;
  if (scarp::read_file(file) != settings)
    scarp::reject(
        "'{}' is of another calibration (other sand, bounds, targets, window, seeds or program): resume with its "
        "options, or calibrate into another folder",
        file.string());
  return true;
}

}  // namespace

void calibrate(CalibrateChoice choice, CLI::App const& app) {
  auto const calibration = calibration_of(choice, app);
  examples::require_used(app, calibration.start);
  auto const settings = settings_of(calibration);
  bool const resume = choice.resume && resumes(choice.output.folder, settings);
  scarp::RunFolder own({.folder = choice.output.folder,
                        .overwrite = choice.output.overwrite || resume,
                        .record = "run_calibrate.json",
                        .results = {"evaluations.csv", "summary.json"}},
                       examples::record_of("rve_lab calibrate", app));
  own.begin();
  if (!resume)
    remove_older(own, {"calibrated.sand", "calibration.csv", "curve.csv", "summary.json"}, {choice.sand_file});
  scarp::write_file(own.path() / "settings.txt", settings);
  Search search(calibration, own.path(), resume);
  search.optimise(search.feasible(start_of(calibration)));
  auto const evaluate = [&](Eigen::VectorXd const& shares) { return search.evaluate(shares); };
  auto const found = sensitivities(calibration, Evaluation(search.best()), search.scale(), evaluate);
  search.evaluate(improved(calibration, Evaluation(search.best()), found, search.scale()));
  auto const other = search.on_other_seeds(search.best().shares);
  CalibrationReport const report{calibration,    search.best(),
                                 other,          found,
                                 search.scale(), {search.evaluations(), search.reasons(), search.seconds()}};
  report.write(own);
  report.print();
  report.require_reached();
  scarp::write_file(own.path() / "calibrated.sand", report.text());
  examples::print(stdout, "{}\n", (own.path() / "calibrated.sand").string());
  own.end("finished");
}

void declare_calibrate(CLI::App& app, CalibrateChoice& choice) {
  app.add_option("--free", choice.free,
                 "parameters with bounds, name=LEAST:MOST,...; friction, relative-density, rolling-friction, "
                 "normal-stiffness (the tangential one "
                 "keeps its ratio) and modulus have usual ones. When not given: friction, relative-density and the "
                 "stiffness of the law");
  app.add_option("--target", choice.target,
                 "of the drained curve, name=VALUE,...: peak-friction, residual-friction, peak-dilation, "
                 "secant-dilation [degrees], void-ratio, e50 [Pa]");
  app.add_option("--table", choice.tables,
                 "of the laboratory: axial_strain, volumetric_strain (eps1, epsv; with _percent where they are; "
                 "engineering_axial_strain where strains are over initial sizes, otherwise they are logarithmic), "
                 "stress_ratio, or q and p "
                 "(q_kPa, p_kPa)")
      ->check(CLI::ExistingFile);
  app.add_flag("--triaxial", choice.triaxial,
               "the tables are of triaxial tests: p is the mean of three stresses; friction angles are compared");
  app.add_option("--path", choice.test.path, "of the tests")->check(CLI::IsMember({"biaxial", "constant_mean_stress"}));
  app.add_option("--lateral-stress,--held-stress", choice.test.held,
                 "of the path [Pa]; otherwise that of the tables' q and p, or of the sand where there is no table")
      ->check(positive(1e12));
  app.add_option("--strain", choice.strain, "at the end; the last one of the tables, or 0.1")->check(positive(1.0));
  app.add_option("--strain-step", choice.test.strain_step, "strain of one DEM step")
      ->check(examples::number_from(1e-12, true, 1e-3));
  app.add_option("--window", choice.window, "axial strain over which peaks are means")->check(positive(0.1));
  app.add_option("--seeds", choice.seeds, "packings of an evaluation")->check(CLI::Range(2, 1000));
  app.add_option("--evaluations", choice.evaluations, "most of the search; sensitivities follow")
      ->check(CLI::Range(3, 10'000));
  app.add_option("--threads", choice.threads, "0 uses all")->check(CLI::Range(0, 1024));
  app.add_flag("--resume", choice.resume, "take up the evaluations of the folder")->configurable(false);
  examples::declare_sand_file(app, choice.sand_file);
  examples::declare_sand(app, choice.sand);
  examples::declare_output(app, choice.output, "folder of calibrated.sand, tables and figures", "--output,-o");
}

}  // namespace rve_lab
