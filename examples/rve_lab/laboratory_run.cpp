// SPDX-License-Identifier: BSL-1.0
#include "laboratory_run.hpp"

#include "../shared/print.hpp"
#include "laboratory_results.hpp"
#include "laboratory_table.hpp"
#include "mohr_coulomb_reading.hpp"
#include "paths.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace rve_lab {

namespace {

template <int Dim>
scarp::PathConditions<Dim> conditions_of(Laboratory const& choice) {
  if (choice.path == "isotropic") return scarp::isotropic_path<Dim>();
  if (choice.path == "oedometer") return scarp::oedometer_path<Dim>();
  if (choice.path == "undrained") return scarp::undrained_path<Dim>();
  if (choice.path == "constant_mean_stress") return scarp::constant_mean_stress_path<Dim>();
  if (choice.path == "simple_shear") return scarp::simple_shear_path<Dim>();
  if (choice.path == "simple_shear_at_stress") return scarp::simple_shear_at_stress_path<Dim>();
  if (choice.path == "proportional_stress") return scarp::proportional_stress_path<Dim>(choice.ratio);
  if (choice.path == "proportional_strain") return scarp::proportional_strain_path<Dim>(choice.ratio);
  return scarp::drained_path<Dim>();
}

/// Axial stress and k0 times as much on the lateral axes as targets, no shear strain.
template <int Dim>
scarp::PathConditions<Dim> consolidation_of(double axial, double k0) {
  auto conditions = scarp::oedometer_path<Dim>();
  for (int k = 0; k < Dim; ++k) {
    conditions[static_cast<std::size_t>(k)] = {.of_stress = scarp::VoigtStress<Dim>::Unit(k),
                                               .target = -(k == Dim - 1 ? 1.0 : k0) * axial};
  }
  return conditions;
}

/// The points of a test with the rows of each, compression positive in the table.
template <int Dim>
class LaboratoryRun {
 public:
  using Row = LaboratoryRow<Dim>;

  LaboratoryRun(Laboratory const& choice, scarp::AnyProvider<Dim> const& material, int count,
                std::filesystem::path const& table)
      : choice_(choice),
        points_(material, sites(count)),
        executor_(std::min(choice.threads, count)),
        rows_(static_cast<std::size_t>(count)),
        log_(table, {"point", "length", "axial_strain", "volumetric_strain", "shear_strain", "axial_stress",
                     "lateral_stress", "shear_stress", "p", "q", "friction_angle", "void_ratio"}) {
    path_.emplace(points_, conditions_of<Dim>(choice), settings());
  }

  /// targets: of --path table, or null
  /// \return why the test ended early, else ok
  scarp::Verdict run(TargetTable<Dim> const* targets) {
    if (choice_.consolidation && !consolidate()) return verdict_;
    for (int k = 0; k < points_.size(); ++k) {
      double initial = choice_.void_ratio.value_or(std::nan(""));
      for (auto const& [name, value] : points_.quantities(k)) {
        if (name == "void_ratio") initial = value;
      }
      void_ratios_.push_back(initial);
    }
    record();
    if (targets != nullptr) {
      for (std::size_t row = 0; row < targets->table.rows(); ++row) {
        path_->load(targets->row(row));
        if (!go(1.0, 0.1)) break;
      }
      return verdict_;
    }
    double const sign = choice_.extension ? -1.0 : 1.0;
    if (choice_.cycles == 0) {
      double const first = std::min(1e-5, choice_.strain);  // a row for the stiffness at small strain
      static_cast<void>(go(sign * first, first) && go(sign * (choice_.strain - first), choice_.increment));
      return verdict_;
    }
    for (int leg = 0; leg <= 2 * choice_.cycles; ++leg) {
      bool const outer = leg == 0 || leg == 2 * choice_.cycles;
      if (!go((leg % 2 == 0 ? sign : -sign) * (outer ? 1.0 : 2.0) * choice_.amplitude,
              std::min(choice_.increment, choice_.amplitude / 10.0)))
        break;
    }
    return verdict_;
  }

  std::vector<std::vector<Row>> const& rows() const { return rows_; }
  double void_ratio(std::size_t point) const { return void_ratios_[point]; }
  scarp::PathReport const& total() const { return total_; }
  double length() const { return path_->length(); }
  /// Words on the point with the least pressure, which ends a test of several first.
  std::string weakest() const {
    if (rows_.size() < 2) return {};
    auto const least = std::ranges::min_element(rows_, {}, [](auto const& rows) { return rows.back().p(); });
    return fmt::format(", point {} carries the least, p {:.4g} Pa: without it the others may go on",
                       least - rows_.begin(), least->back().p());
  }

 private:
  static std::vector<scarp::Site<Dim>> sites(int count) {
    std::vector<scarp::Site<Dim>> all;
    for (int k = 0; k < count; ++k) all.push_back({.index = k});
    return all;
  }
  scarp::PathSettings settings() const { return {.tolerance = choice_.tolerance}; }

  bool consolidate() {
    scarp::PointPath<Dim> path(points_, consolidation_of<Dim>(*choice_.consolidation, choice_.k0), settings());
    for (int k = 0; k < 20; ++k) {
      verdict_ = path.advance(0.05, executor_).verdict;
      if (verdict_.acceptable()) continue;
      examples::print(stderr,
                      "rve_lab: the consolidation to {:.6g} Pa with K0 {} ended after {:.0f} % of the way: choose "
                      "stresses that the material bears\n",
                      *choice_.consolidation, choice_.k0, 100.0 * path.length());
      return false;
    }
    path_.emplace(points_, conditions_of<Dim>(choice_), settings());
    return true;
  }

  bool go(double length, double increment) {
    auto const count = static_cast<int>(std::ceil(std::abs(length) / increment - 1e-9));
    for (int k = 0; k < count; ++k) {
      auto const report = path_->advance(length / count, executor_);
      verdict_ = report.verdict;
      total_.increments += report.increments;
      total_.cut_backs += report.cut_backs;
      total_.iterations += report.iterations;
      total_.missing = std::max(total_.missing, report.missing);
      if (report.increments > 0) record();
      if (!verdict_.acceptable()) return false;
    }
    return true;
  }

  void record() {
    constexpr int sheared = Dim == 2 ? 2 : 4;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      int const point = static_cast<int>(k);
      Row const row{path_->length(), path_->stress(point), path_->strain(point)};
      rows_[k].push_back(row);
      log_.add(static_cast<double>(k), row.length, row.axial_strain(), row.volumetric_strain(), row.strain(sheared),
               -row.stress(Dim - 1), -row.stress(0), row.stress(sheared), row.p(), row.q(), row.friction() / degree,
               row.void_ratio(void_ratios_[k]));
    }
  }

  Laboratory const& choice_;
  scarp::MaterialPoints<Dim> points_;
  scarp::ThreadExecutor executor_;
  std::optional<scarp::PointPath<Dim>> path_{};
  std::vector<std::vector<Row>> rows_;
  std::vector<double> void_ratios_{};
  scarp::CsvLog log_;
  scarp::PathReport total_{};
  scarp::Verdict verdict_{};
};

template <int Dim>
nlohmann::json json_of(LaboratoryRow<Dim> const& row, double void_ratio) {
  return {{"strain", row.length},
          {"p", row.p()},
          {"q", row.q()},
          {"friction_angle", row.friction() / degree},
          {"volumetric_strain", row.volumetric_strain()},
          {"void_ratio", row.void_ratio(void_ratio)}};
}

/// whole: whether the test came to its end; one that was cut off has no residual state
template <int Dim>
nlohmann::json json_of(LaboratoryResults<Dim> const& results, double void_ratio, bool whole) {
  nlohmann::json json{{"peak", nullptr},
                      {"residual", nullptr},
                      {"phase_transformation", nullptr},
                      {"peak_dilation_angle", results.peak_dilation / degree},
                      {"secant_dilation_angle", results.secant_dilation / degree},
                      {"E50", results.secant_modulus},
                      {"G0", results.shear_modulus},
                      {"K0", results.k0}};
  if (!results.rises) json["peak"] = json_of(results.peak, void_ratio);
  if (whole) json["residual"] = json_of(results.residual, void_ratio);
  if (results.phase_transformation) json["phase_transformation"] = json_of(*results.phase_transformation, void_ratio);
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
  LaboratoryRun<Dim> run(choice, material, count, own.path() / "test.csv");
  scarp::Verdict const verdict = run.run(targets ? &*targets : nullptr);
  auto const& total = run.total();
  double const window =
      choice.path == "table" || choice.cycles > 0 || std::abs(run.length()) < choice.window ? 0.0 : choice.window;
  nlohmann::json summary{{"path", choice.path},
                         {"material", described},
                         {"dimension", Dim},
                         {"points", count},
                         {"ended", scarp::name(verdict.reason)},
                         {"length", run.length()},
                         {"increments", total.increments},
                         {"cut_backs", total.cut_backs},
                         {"iterations", total.iterations},
                         {"largest_missing_stress", total.missing},
                         {"window", window},
                         {"overlay", choice.overlays},
                         {"output", own.path().string()},
                         {"run", examples::json_of(own.record())}};
  examples::print(stdout, "{} increments, {} cut back, {} iterations, held stresses within {:.1g}\n", total.increments,
                  total.cut_backs, total.iterations, total.missing);
  if (run.rows().front().size() > 1) {
    examples::print(stdout, "{:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>10} {:>10} {:>6}\n", "point",
                    "phi_peak", "at", "e", "psi_peak", "phi_res", "e", "transf.", "E50 [Pa]", "G0 [Pa]", "K0");
    double mean_void_ratio = 0.0;
    for (std::size_t k = 0; k < run.rows().size(); ++k) {
      mean_void_ratio += run.void_ratio(k) / static_cast<double>(count);
      auto const json =
          json_of(laboratory_results<Dim>(run.rows()[k], window), run.void_ratio(k), verdict.acceptable());
      print_results(std::to_string(k), json);
      summary["results"].push_back(json);
    }
    auto const mean = laboratory_results<Dim>(mean_rows<Dim>(run.rows()), window);
    summary["mean"] = json_of(mean, mean_void_ratio, verdict.acceptable());
    if (count > 1) print_results("mean", summary["mean"]);
    if (!mean.rises) summary["peak_friction_angle"] = mean.peak.friction() / degree;
    if (verdict.acceptable()) summary["residual_friction_angle"] = mean.residual.friction() / degree;
    for (auto const* key : {"peak_dilation_angle", "E50", "G0"}) summary[key] = summary["mean"][key];
    if (choice.path == "drained" && !std::isnan(mean.peak_dilation)) summary["mohr_coulomb"] = read_mohr_coulomb(mean);
  }
  examples::write_json(own.path() / "summary.json", summary);
  own.end(verdict.acceptable() ? "finished" : std::string(scarp::name(verdict.reason)));
  if (!verdict.acceptable())
    examples::print(stderr,
                    "rve_lab: the test was cut off at the length {:.6g} ({}, {}){}: the rows so far are in '{}'\n",
                    run.length(), scarp::name(verdict.status), scarp::name(verdict.reason), run.weakest(),
                    (own.path() / "test.csv").string());
  return verdict.acceptable();
}

template bool test_material<2>(Laboratory const&, scarp::AnyProvider<2> const&, int, scarp::RunFolder&,
                               nlohmann::json const&);
template bool test_material<3>(Laboratory const&, scarp::AnyProvider<3> const&, int, scarp::RunFolder&,
                               nlohmann::json const&);

}  // namespace rve_lab
