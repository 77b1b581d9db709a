// SPDX-License-Identifier: BSL-1.0
#include <map>
#include <nlohmann/json.hpp>

#include "../shared/budget_report.hpp"
#include "../shared/laboratory_loadings.hpp"
#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "packings.hpp"
#include "recorder.hpp"
#include "row_budget.hpp"
#include "scarp/io/packings/packing_file.hpp"
#include "states.hpp"

namespace rve_lab {

namespace {

/// 0 for a packing without pressure.
double largest_ratio(Row const& row) {
  double const p = value(row, "mean_p");
  return p > 0.0 ? value(row, "mean_q") / p : 0.0;
}

void print_head() {
  examples::print(stdout, "{:>9} {:>11} {:>11} {:>7} {:>9} {:>6} {:>6} {:>9}\n", "strain", "p [Pa]", "q [Pa]", "q/p",
                  "e", "Z", "F_c", "e_v");
}

void print_row(Row const& row) {
  examples::print(stdout, "{:>9.5f} {:>11.4g} {:>11.4g} {:>7.3f} {:>9.5f} {:>6.3f} {:>6.3f} {:>9.5f}\n",
                  value(row, "strain"), value(row, "mean_p"), value(row, "mean_q"), largest_ratio(row),
                  value(row, "void_ratio"), value(row, "coordination"), value(row, "contact_anisotropy"),
                  value(row, "volumetric_strain"));
  std::fflush(stdout);
}

/// Files of the states and of the end, which a run that fails does not write.
void remove_older_ends(scarp::RunFolder const& own, std::filesystem::path const& input) {
  std::vector<std::string> const names{"end.packing",        "end.sand",          "summary.json",
                                       "peak_particles.csv", "peak_contacts.csv", "peak_cell.csv",
                                       "end_particles.csv",  "end_contacts.csv",  "end_cell.csv"};
  remove_older(own, names, {input, examples::sand_path(input)});
}

/// Sends a packing along the path. In the run's folder: path.csv row by row, the states at the start, at the largest
/// q/p and at the end, end.packing (with end.sand) to continue from, summary.json last.
/// input: file of the packing, where it comes from one
/// \throws std::runtime_error when the packing cannot continue; the rows so far are then on disk
template <class PackingType>
void run_path(PackingType start, typename PackingType::Law const& law, Path choice, scarp::RunFolder& own,
              Sand const& sand, std::filesystem::path const& input) {
  std::filesystem::path const& folder = own.path();
  PathKind const& path = path_named(choice.name);
  bool const cyclic = choice.cycles > 0;
  // Cycles turn at the amplitude itself.
  auto const even =
      even_steps(cyclic ? choice.amplitude : choice.strain, choice.strain_step, cyclic ? "amplitude" : "strain");
  choice.strain_step = even.strain;
  long const steps = cyclic ? 4 * choice.cycles * even.count : even.count;
  Specimen<PackingType, scarp::Observe::energy> lab(std::move(start), law, path, choice.strain_step, choice.held);
  double const length = cyclic ? 4.0 * choice.amplitude * choice.cycles : choice.strain;
  examples::Cyclic const cycle{choice.amplitude - 0.5 * choice.strain_step};  // half a step for round-off
  long const steps_per_row = steps_of(choice.row_strain.value_or(length / 200.0), choice.strain_step);

  own.begin();
  remove_older_ends(own, input);
  Recorder<PackingType> recorder(lab.packing());
  Row const first = recorder.row(lab, path, 0);
  std::vector<std::string> names;
  for (auto const& cell : first) names.push_back(cell.first);
  scarp::CsvLog log(folder / "path.csv", names);
  RowBudget budget;
  auto const write = [&](Row const& row) {
    budget.add(row);
    std::vector<double> cells;
    for (auto const& cell : row) cells.push_back(cell.second);
    log.add(std::span<double const>(cells));
  };
  write(first);
  write_state(folder, "start", lab.packing(), law);
  print_head();
  print_row(first);

  Row peak = first;
  PackingType peak_packing = lab.packing();
  long travelled = 0;  // steps, with sign
  int sign = 1;
  for (long step = 1; step <= steps; ++step) {
    double const volume = lab.packing().volume();
    auto const verdict = lab.step();
    if (!verdict.acceptable()) end_early(verdict, path.strain(lab.deformation()), (folder / "path.csv").string());
    recorder.look(lab, volume);
    travelled += sign;
    int const next = cyclic ? cycle.next_sign(static_cast<double>(travelled) * choice.strain_step, sign) : 1;
    if (next != sign) lab.reverse();
    sign = next;
    if (step % steps_per_row != 0 && step != steps) continue;
    Row const row = recorder.row(lab, path, step);
    write(row);
    if (largest_ratio(row) > largest_ratio(peak)) {
      peak = row;
      peak_packing = lab.packing();
    }
    if (step == steps || (step / steps_per_row) % 20 == 0) print_row(row);
  }
  write_state(folder, "peak", peak_packing, law);
  write_state(folder, "end", lab.packing(), law);
  scarp::save_packing(folder / "end.packing", lab.packing());
  scarp::write_file(examples::sand_path(folder / "end.packing"), examples::text_of(sand));
  examples::print(stdout, "{}{}", scarp::budget_headline(budget.parts()), scarp::budget_table(budget.parts()));
  double const friction = std::asin(std::min(1.0, largest_ratio(peak) / 2.0)) / degree;
  examples::print(stdout, "largest q/p {:.4f}, a friction angle of {:.2f} degrees, at strain {:.5f}\n",
                  largest_ratio(peak), friction, value(peak, "strain"));
  nlohmann::json const summary{{"path", choice.name},
                               {"sand", examples::to_json(sand)},
                               {"grains", lab.packing().grain_count()},
                               {"cycles", choice.cycles},
                               {"strain_step", choice.strain_step},
                               {"steps", steps},
                               {"error_budget", examples::json_of(budget.parts())},
                               {"largest_friction_angle", friction},
                               {"strain_at_largest_friction", value(peak, "strain")},
                               {"peak", nlohmann::json(std::map<std::string, double>(peak.begin(), peak.end()))},
                               {"output", folder.string()},
                               {"run", examples::json_of(own.record())}};
  examples::write_json(folder / "summary.json", summary);
  if (path.held != nullptr) require_held(lab, path);
  own.end("finished");
}

}  // namespace

void shear(Test& choice, CLI::App const& app) {
  require_used(app, choice.path);
  auto own = folder_of(choice.output, app, {"path.csv", "summary.json"});
  if (!choice.packing.empty()) {
    choice.sand = examples::sand_of_packing(choice.packing, choice.sand, examples::given_in(app));
    examples::print_notes(examples::other_than_prepared(choice.packing, choice.sand));
  }
  read_sand_file(choice, app);
  if (is_in_space(choice.sand))
    scarp::reject("the grains are spheres (shear tests grains in the plane): use rve_lab test");
  with_packing(Grains{}, choice.sand, [&]<class PackingType>(std::type_identity<PackingType>, auto const& law) {
    auto packing = choice.packing.empty() ? Preparation<PackingType>::printed(choice.sand, law)
                                          : scarp::load_packing<PackingType>(choice.packing);
    run_path(std::move(packing), law, choice.path, own, choice.sand, choice.packing);
  });
}

void declare_shear(CLI::App& app, Test& test) {
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

}  // namespace rve_lab
