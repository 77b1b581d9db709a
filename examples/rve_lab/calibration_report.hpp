// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

#include "../shared/print.hpp"
#include "../shared/run_options.hpp"
#include "../shared/sand/options.hpp"
#include "../shared/write_json.hpp"
#include "calibration.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/run/run_folder.hpp"

namespace rve_lab {

/// What a search took.
struct Effort {
  int evaluations = 0;
  std::vector<std::string> reasons{};  ///< of infeasible evaluations
  double seconds = 0.0;
};

/// What a calibration came to: tables for figures, the summary, and the sand itself.
class CalibrationReport {
 public:
  /// other: the best sand on seeds that were not used
  CalibrationReport(Calibration const& calibration, Evaluation best, Evaluation other, Sensitivities found,
                    Eigen::VectorXd units, Effort effort)
      : calibration_(calibration),
        best_(std::move(best)),
        other_(std::move(other)),
        found_(std::move(found)),
        units_(std::move(units)),
        effort_(std::move(effort)) {}

  /// \throws FileError
  void write(scarp::RunFolder& own) const {
    write_observations(own.path());
    write_curve(own.path());
    nlohmann::ordered_json json{{"misfit", misfit(calibration_, best_, units_)},
                                {"misfit_on_other_seeds", misfit(calibration_, other_, units_)},
                                {"seconds", effort_.seconds},
                                {"evaluations", effort_.evaluations},
                                {"infeasible_evaluations", effort_.reasons.size()},
                                {"seeds", calibration_.seeds}};
    if (!effort_.reasons.empty()) json["first_infeasible_evaluation"] = effort_.reasons.front();
    if (!other_.feasible()) json["infeasible_on_other_seeds"] = other_.reason;
    for (auto const& [name, value, error, share_error, range, bound] : parameters())
      json["parameters"][name] = {{"value", value}, {"standard_error", error}, {"range", range}, {"at_bound", bound}};
    for (std::size_t k = 0; k < calibration_.observations.size(); ++k) {
      auto const& one = calibration_.observations[k];
      auto const at = static_cast<Eigen::Index>(k);
      if (one.strain == 0.0)
        json["targets"][one.name] = {{"wanted", one.wanted},
                                     {"value", best_.values(at)},
                                     {"scatter", best_.scatter(at)},
                                     {"on_other_seeds", other_.values(at)},
                                     {"scatter_on_other_seeds", other_.scatter(at)}};
    }
    json["void_ratio"] = best_.void_ratio;
    json["run"] = examples::json_of(own.record());
    examples::write_json(own.path() / "summary.json", json);
  }

  void print() const {
    examples::print(stdout, "misfit {:.2f} in units of the scatter, {:.2f} on other seeds; {:.0f} s\n",
                    misfit(calibration_, best_, units_), misfit(calibration_, other_, units_), effort_.seconds);
    if (!effort_.reasons.empty())
      examples::print(stdout, "{} of {} evaluations were infeasible, the first: {}\n", effort_.reasons.size(),
                      effort_.evaluations, effort_.reasons.front());
    if (!other_.feasible())
      examples::print(stderr, "warning: the best sand is infeasible on seeds that were not used: {}\n", other_.reason);
    for (auto const& line : parameter_lines()) examples::print(stdout, "{}\n", line);
    for_each_target([](Observation const& one, double value, double scatter, double other, double other_scatter) {
      examples::print(stdout, "{} {:.5g} +- {:.2g} where {:.5g} is wanted; {:.5g} +- {:.2g} on other seeds\n", one.name,
                      value, scatter, one.wanted, other, other_scatter);
    });
    warn_of_no_peak();
  }

  /// What was found of each free parameter, in words.
  std::vector<std::string> parameter_lines() const {
    constexpr double most = 0.25;  // of the way between the bounds, by ratio where the search goes by ratio
    std::vector<std::string> lines;
    for (auto const& [name, value, error, share_error, range, bound] : parameters())
      lines.push_back(bound.empty()
                          ? fmt::format("{} {:.5g} +- {:.2g}{}", name, value, error,
                                        share_error > most ? ": the data hardly determine it" : "")
                          : fmt::format("{} {:.5g}, at the {} end of its bounds: widen them", name, value, bound));
    return lines;
  }

  /// \throws InputError for targets that the best sand misses, naming what limits it
  void require_reached() const {
    std::string missed;
    for_each_target([&](Observation const& one, double value, double, double, double) {
      if (std::abs(value - one.wanted) > one.reached)
        missed +=
            fmt::format("{}{} {:.5g} (nearest is {:.5g})", missed.empty() ? "" : ", ", one.name, one.wanted, value);
    });
    auto const limits = limits_of();
    bool const no_such_packing = void_ratio_limit() != "";
    if (missed.empty() && !no_such_packing) return;
    if (missed.empty()) missed = "the void ratio";
    bool const alone = calibration_.observations.size() == 1;
    auto const inside =
        fmt::format("the {}grains themselves, no parameter is at its bounds", alone ? "" : "other targets or the ");
    scarp::reject("out of reach: {} (limited by {}): widen the bounds, free another parameter, or take other grains",
                  missed, limits.empty() ? inside : limits);
  }

  /// The calibrated sand as a file.
  std::string text() const {
    Sand sand = calibration_.sand_at(best_.shares);
    std::string on, off;
    for_each_target([&](Observation const& one, double value, double scatter, double other, double other_scatter) {
      on += fmt::format("{}{} {:.6g}", on.empty() ? "" : ", ", one.name, one.wanted);
      auto const elsewhere =
          other_.feasible() ? fmt::format("{:.4g} +- {:.2g}", other, other_scatter) : std::string("infeasible");
      off += fmt::format(", {} {:.4g} +- {:.2g} ({} on other seeds)", one.name, value, scatter, elsewhere);
    });
    if (calibration_.observations.back().strain > 0.0)
      on += on.empty() ? "a laboratory table" : " and a laboratory table";
    auto const& test = calibration_.test;
    sand.calibrated_on = fmt::format("{}; {}{}, means of {} packings", on, test.path,
                                     test.held ? fmt::format(" at {:.6g} Pa", *test.held) : "", calibration_.seeds);
    sand.misfit = fmt::format("{:.2f} standard errors{}", misfit(calibration_, best_, units_), off);
    return examples::text_of(sand);
  }

 private:
  void warn_of_no_peak() const {
    auto const peak = std::ranges::find_if(calibration_.observations,
                                           [](Observation const& one) { return one.name.starts_with("peak-"); });
    auto const& rows = other_.mean.rows.empty() ? best_.mean.rows : other_.mean.rows;
    if (peak == calibration_.observations.end() || rows.empty()) return;
    if (laboratory_results<2>(rows, calibration_.window).rises)
      examples::print(stderr,
                      "warning: the stress ratio rises to the end of the tests, so that {} is not that of a peak: give "
                      "a larger --strain\n",
                      peak->name);
  }

  struct Parameter {
    std::string name;
    double value;
    double error;
    double share_error;  ///< of the way between the bounds, as the search goes it
    double range;
    std::string bound;  ///< "lower" or "upper" where it lies at one
  };

  std::vector<Parameter> parameters() const {
    std::vector<Parameter> all;
    for (std::size_t k = 0; k < calibration_.free.size(); ++k) {
      auto const& one = calibration_.free[k];
      auto const at = static_cast<Eigen::Index>(k);
      double const share = best_.shares(at);
      double const error = std::sqrt(found_.covariance(at, at));
      double const slope = (one.at(std::min(1.0, share + 0.01)) - one.at(std::max(0.0, share - 0.01))) /
                           (std::min(1.0, share + 0.01) - std::max(0.0, share - 0.01));
      all.push_back(
          {one.name, one.at(share), std::min(error, 1.0) * slope, error, one.most - one.least, bound_of(share)});
    }
    return all;
  }

  static std::string bound_of(double share) {
    constexpr double near = 0.03;
    return share <= near ? "lower" : share >= 1.0 - near ? "upper" : "";
  }

  template <class Visit>
  void for_each_target(Visit const& visit) const {
    for (std::size_t k = 0; k < calibration_.observations.size(); ++k) {
      auto const at = static_cast<Eigen::Index>(k);
      if (calibration_.observations[k].strain == 0.0)
        visit(calibration_.observations[k], best_.values(at), best_.scatter(at), other_.values(at), other_.scatter(at));
    }
  }

  std::string void_ratio_limit() const {
    constexpr double allowed = 3e-3;
    double const wanted = calibration_.sand_at(best_.shares).void_ratio;
    if (wanted == 0.0 || std::abs(best_.void_ratio - wanted) <= allowed) return {};
    return fmt::format("void ratio {:.4f}, where the {} packings that the grains have are at {:.4f}", wanted,
                       best_.void_ratio > wanted ? "densest" : "loosest", best_.void_ratio);
  }

  std::string limits_of() const {
    std::string text = void_ratio_limit();
    for (std::size_t k = 0; k < calibration_.free.size(); ++k) {
      auto const& one = calibration_.free[k];
      double const share = best_.shares(static_cast<Eigen::Index>(k));
      auto const bound = bound_of(share);
      if (bound.empty()) continue;
      bool const low = bound == "lower";
      text += fmt::format("{}{} at the {} end of its bounds, {:.5g}", text.empty() ? "" : ", ", one.name, bound,
                          low ? one.least : one.most);
      if (one.name == "relative-density") text += low ? " (the loosest)" : " (the densest)";
    }
    return text;
  }

  void write_observations(std::filesystem::path const& folder) const {
    std::vector<std::string> columns{"name",           "axial_strain",          "wanted", "value", "scatter",
                                     "on_other_seeds", "scatter_on_other_seeds"};
    for (auto const& one : calibration_.free) columns.push_back("per range of " + one.name);
    std::string text = scarp::listed(columns, ",") + "\n";
    for (std::size_t k = 0; k < calibration_.observations.size(); ++k) {
      auto const& one = calibration_.observations[k];
      auto const at = static_cast<Eigen::Index>(k);
      text += fmt::format("{},{},{},{},{},{},{}", one.name, one.strain, one.wanted, best_.values(at), best_.scatter(at),
                          other_.values(at), other_.scatter(at));
      for (Eigen::Index j = 0; j < found_.slopes.cols(); ++j) text += fmt::format(",{}", found_.slopes(at, j));
      text += "\n";
    }
    scarp::write_file(folder / "calibration.csv", text);
  }

  void write_curve(std::filesystem::path const& folder) const {
    scarp::CsvTable table({"axial_strain", "sine", "volumetric_strain"});
    for (auto const& row : other_.mean.rows) table.add(row.axial_strain(), sine_of(row), row.volumetric_strain());
    table.write(folder / "curve.csv");
  }

  Calibration const& calibration_;
  Evaluation best_;
  Evaluation other_;
  Sensitivities found_;
  Eigen::VectorXd units_;
  Effort effort_;
};

}  // namespace rve_lab
