// SPDX-License-Identifier: BSL-1.0
#include "laboratory_run.hpp"

#include <numeric>

#include "../shared/print.hpp"
#include "commands.hpp"
#include "laboratory_tests.hpp"
#include "mohr_coulomb_reading.hpp"
#include "paths.hpp"

namespace rve_lab {

namespace {

/// Where the results of a test stand on its path, and from which state its void ratios count.
struct Place {
  bool by_axial_strain = false;  ///< of a table, whose length counts rows
  double void_ratio = 0.0;       ///< where the path begins
};

template <int Dim>
nlohmann::json json_of(LaboratoryRow<Dim> const& row, Place const& place) {
  return {{"strain", place.by_axial_strain ? row.axial_strain() : row.length},
          {"p", row.p()},
          {"q", row.q()},
          {"friction_angle", row.friction() / degree},
          {"volumetric_strain", row.volumetric_strain()},
          {"void_ratio", row.void_ratio(place.void_ratio)}};
}

/// whole: whether the test came to its end; one that was cut off has no residual state
template <int Dim>
nlohmann::json json_of(LaboratoryResults<Dim> const& results, Place const& place, bool whole) {
  nlohmann::json json{{"peak", nullptr},
                      {"residual", nullptr},
                      {"phase_transformation", nullptr},
                      {"peak_dilation_angle", (results.rises ? std::nan("") : results.peak_dilation) / degree},
                      {"secant_dilation_angle", results.secant_dilation / degree},
                      {"E50", results.secant_modulus},
                      {"G0", results.shear_modulus},
                      {"K0", results.k0}};
  if (!results.rises) json["peak"] = json_of(results.peak, place);
  if (whole) json["residual"] = json_of(results.residual, place);
  if (results.phase_transformation) json["phase_transformation"] = json_of(*results.phase_transformation, place);
  return json;
}

void print_results(std::string const& name, nlohmann::json const& json) {  // nan: the test does not have it
  auto const number = [&](std::initializer_list<char const*> keys) {
    nlohmann::json const* value = &json;
    for (auto const* key : keys) {
      if (!value->is_null()) value = &(*value)[key];
    }
    return value->is_null() ? std::nan("") : value->get<double>();
  };
  examples::print(
      stdout, "{:>6} {:>8.2f} {:>8.4f} {:>8.4f} {:>8.2f} {:>8.2f} {:>8.4f} {:>9.5f} {:>10.4g} {:>10.4g} {:>6.3f}\n",
      name, number({"peak", "friction_angle"}), number({"peak", "strain"}), number({"peak", "void_ratio"}),
      number({"peak_dilation_angle"}), number({"residual", "friction_angle"}), number({"residual", "void_ratio"}),
      number({"phase_transformation", "strain"}), number({"E50"}), number({"G0"}), number({"K0"}));
}

constexpr std::size_t most_lines = 10;  ///< of points, beyond which the summary alone has them

/// Peak friction of the points, without those whose stress ratio still rose at the end: printed, and kept in the
/// summary.
void read_scatter(nlohmann::json& summary) {
  std::vector<double> angles;
  for (auto const& result : summary["results"]) {
    if (result.contains("peak") && !result["peak"].is_null())
      angles.push_back(result["peak"]["friction_angle"].get<double>());
  }
  auto const count = static_cast<double>(angles.size());
  double const mean = std::accumulate(angles.begin(), angles.end(), 0.0) / count;  // nan without any
  double squares = 0.0;
  for (double const angle : angles) squares += (angle - mean) * (angle - mean);
  double const deviation = std::sqrt(squares / (count - 1.0));
  summary["peak_friction"] = {{"points", angles.size()}, {"mean", mean}, {"standard_deviation", deviation}};
  if (angles.size() > 1)
    examples::print(stdout, "peak friction of {} of {} points: mean {:.2f}, standard deviation {:.2f} degrees\n",
                    angles.size(), summary["results"].size(), mean, deviation);
}

/// Mohr-Coulomb parameters of a drained test's results: printed as options of this command, and kept in the summary.
template <int Dim>
nlohmann::json read_mohr_coulomb(LaboratoryResults<Dim> const& results) try {
  auto const soil = mohr_coulomb_of(results);
  auto const [lambda, shear] = soil.elasticity;
  double const poisson = lambda / (2.0 * (lambda + shear));
  double const young = 2.0 * shear * (1.0 + poisson);
  auto const& strength = soil.strength.strength;
  examples::print(stdout,
                  "as Mohr-Coulomb: --material mohr-coulomb --dimension {} --young {:.4g} --poissons-ratio {:.3f} "
                  "--friction-angle {:.2f} --dilation-angle {:.2f}\n",
                  Dim, young, poisson, strength.friction / degree, strength.dilation / degree);
  return {{"young", young},
          {"poissons_ratio", poisson},
          {"friction_angle", strength.friction / degree},
          {"dilation_angle", strength.dilation / degree},
          {"cohesion", 0.0}};
} catch (scarp::InputError const& problem) {
  examples::print(stdout, "no Mohr-Coulomb parameters: {}\n", problem.what());
  return nullptr;
}

}  // namespace

template <int Dim>
bool test_material(Laboratory const& choice, scarp::AnyProvider<Dim> const& material, int count, scarp::RunFolder& own,
                   nlohmann::json const& described) {
  std::optional<TargetTable<Dim>> targets;
  if (choice.path == "table") targets.emplace(choice.table);
  own.begin();
  remove_older(own, {"summary.json"});
  LaboratoryRun<Dim> run(choice, material, count, own.path() / "test.csv");
  run.run(targets ? &*targets : nullptr);
  auto const farthest = run.farthest();
  bool const finished = std::ranges::all_of(run.tests(), [](auto const& test) { return test.verdict.acceptable(); });
  auto const early = std::ranges::find_if(run.tests(), [](auto const& test) { return !test.verdict.acceptable(); });
  auto const ended = scarp::name(finished ? scarp::Reason::none : early->verdict.reason);
  scarp::PathReport total;
  for (auto const& test : run.tests()) {
    total.increments += test.total.increments;
    total.cut_backs += test.total.cut_backs;
    total.iterations += test.total.iterations;
    total.missing = std::max(total.missing, test.total.missing);
  }
  bool const of_table = choice.path == "table";
  auto const window = [&](auto const& rows) {
    bool const single = of_table || choice.cycles > 0 || rows.empty() || std::abs(rows.back().length) < choice.window;
    return single ? 0.0 : choice.window;
  };
  auto const ends = run.farthest_rows();
  nlohmann::json summary{{"path", choice.path},
                         {"material", described},
                         {"dimension", Dim},
                         {"points", count},
                         {"ended", ended},
                         {"length", farthest.front()->length()},
                         {"increments", total.increments},
                         {"cut_backs", total.cut_backs},
                         {"iterations", total.iterations},
                         {"largest_missing_stress", total.missing},
                         {"window", window(ends.front())},
                         {"overlay", choice.overlays},
                         {"output", own.path().string()},
                         {"run", examples::json_of(own.record())}};
  examples::print(stdout, "{} increments, {} cut back, {} iterations, held stresses within {:.1g}\n", total.increments,
                  total.cut_backs, total.iterations, total.missing);
  if (farthest.front()->rows.size() > 1) {
    examples::print(stdout, "{:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>10} {:>10} {:>6}\n", "point",
                    "phi_peak", "at", "e", "psi_peak", "phi_res", "e", "transf.", "E50 [Pa]", "G0 [Pa]", "K0");
    for (std::size_t k = 0; k < run.tests().size(); ++k) {
      auto const& test = run.tests()[k];
      nlohmann::json json;
      if (test.rows.size() > 1) {
        json = json_of(laboratory_results<Dim>(test.rows, window(test.rows)), Place{of_table, test.void_ratio},
                       test.verdict.acceptable());
        if (k < most_lines) print_results(std::to_string(k), json);
      }
      json.update({{"ended", scarp::name(test.verdict.reason)}, {"length", test.length()}});
      summary["results"].push_back(json);
    }
    if (run.tests().size() > most_lines)
      examples::print(stdout, "{} more points are in '{}'\n", run.tests().size() - most_lines,
                      (own.path() / "summary.json").string());
    double mean_void_ratio = 0.0;
    for (auto const* test : farthest) mean_void_ratio += test->void_ratio / static_cast<double>(farthest.size());
    bool const whole = farthest.front()->verdict.acceptable();
    auto const mean = laboratory_results<Dim>(mean_rows<Dim>(ends), window(ends.front()));
    summary["mean"] = json_of(mean, Place{of_table, mean_void_ratio}, whole);
    summary["mean"]["points"] = farthest.size();
    if (count > 1) {
      print_results("mean", summary["mean"]);
      read_scatter(summary);
    }
    if (!mean.rises) summary["peak_friction_angle"] = mean.peak.friction() / degree;
    if (whole) summary["residual_friction_angle"] = mean.residual.friction() / degree;
    for (auto const* key : {"peak_dilation_angle", "E50", "G0"}) summary[key] = summary["mean"][key];
    if (choice.path == "drained" && !std::isnan(mean.peak_dilation)) summary["mohr_coulomb"] = read_mohr_coulomb(mean);
  }
  examples::write_json(own.path() / "summary.json", summary);
  own.end(finished ? "finished" : std::string(ended));
  std::size_t cut_off = 0;
  for (std::size_t k = 0; k < run.tests().size(); ++k) {
    auto const& test = run.tests()[k];
    if (test.verdict.acceptable() || ++cut_off > most_lines) continue;
    examples::print(stderr,
                    "rve_lab: the test{} was cut off at the length {:.6g} ({}, {}): its rows so far are in '{}'\n",
                    count > 1 ? fmt::format(" of point {}", k) : "", test.length(), scarp::name(test.verdict.status),
                    scarp::name(test.verdict.reason), (own.path() / "test.csv").string());
  }
  if (cut_off > most_lines) examples::print(stderr, "rve_lab: {} more tests were cut off\n", cut_off - most_lines);
  return finished;
}

template bool test_material<2>(Laboratory const&, scarp::AnyProvider<2> const&, int, scarp::RunFolder&,
                               nlohmann::json const&);
template bool test_material<3>(Laboratory const&, scarp::AnyProvider<3> const&, int, scarp::RunFolder&,
                               nlohmann::json const&);

}  // namespace rve_lab
