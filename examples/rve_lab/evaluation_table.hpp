// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/read_file.hpp"

namespace rve_lab {

/// evaluations.csv: a row for each evaluation, of infeasible ones with the reason instead of values, from which a
/// resumed calibration takes what it has already.
class EvaluationTable {
 public:
  /// \throws InputError for a table of other parameters or targets
  EvaluationTable(std::filesystem::path const& file, Calibration const& calibration, bool resumes)
      : calibration_(calibration),
        log_(read(file, resumes), columns(calibration), resumes ? scarp::CsvStart::resumed : scarp::CsvStart::anew) {}

  std::optional<Evaluation> find(Eigen::VectorXd const& shares) const {
    constexpr double round_off = 1e-9;
    for (auto const& row : rows_) {
      if ((row.shares - shares).cwiseAbs().maxCoeff() < round_off) return row;
    }
    return std::nullopt;
  }

  void add(Evaluation const& one) {
    std::vector<std::string> cells;
    auto const add_numbers = [&](auto const& numbers) {
      for (double const number : numbers) cells.push_back(std::isfinite(number) ? fmt::format("{}", number) : "");
    };
    add_numbers(one.shares);
    for (std::size_t k = 0; k < calibration_.free.size(); ++k)
      add_numbers(std::array{calibration_.free[k].at(one.shares(static_cast<Eigen::Index>(k)))});
    add_numbers(std::array{one.void_ratio});
    add_numbers(one.values);
    add_numbers(one.scatter);
    cells.push_back(one.reason);
    log_.add(std::span<std::string const>(cells));
    rows_.push_back(one);
    rows_.back().mean = {};
  }

 private:
  static std::string observation(Calibration const& calibration, std::size_t k) {
    auto const name_of = [](Observation const& one) {
      return one.strain == 0.0 ? one.name : fmt::format("{} at {:.6g}", one.name, one.strain);
    };
    auto const name = name_of(calibration.observations[k]);
    auto const end = calibration.observations.begin() + static_cast<std::ptrdiff_t>(k);
    auto const before = std::count_if(calibration.observations.begin(), end,
                                      [&](Observation const& other) { return name_of(other) == name; });
    return name + (before > 0 ? fmt::format(" of table {}", before + 1) : std::string());
  }

  static std::vector<std::string> columns(Calibration const& calibration) {
    std::vector<std::string> names;
    for (auto const& one : calibration.free) names.push_back("share of " + one.name);
    for (auto const& one : calibration.free) names.push_back(one.name);
    names.emplace_back("void ratio at the isotropic pressure");
    for (std::size_t k = 0; k < calibration.observations.size(); ++k)
      names.push_back("value of " + observation(calibration, k));
    for (std::size_t k = 0; k < calibration.observations.size(); ++k)
      names.push_back("scatter of " + observation(calibration, k));
    names.emplace_back("reason");
    return names;
  }

  /// Numbers of a column; empty cells, as rows with a reason have them, are none.
  static std::vector<double> numbers(scarp::CsvColumns const& table, std::string const& name) {
    std::vector<double> values;
    for (auto const& text : table.texts(name)) {
      double value = std::numeric_limits<double>::quiet_NaN();
      if (!text.empty() && scarp::read_number(text, value) != std::errc{})
        table.reject_cell(values.size(), name, "it is no number", "calibrate without --resume");
      values.push_back(value);
    }
    return values;
  }

  std::filesystem::path const& read(std::filesystem::path const& file, bool resumes) {
    if (!resumes || !std::filesystem::exists(file)) return file;
    auto text = scarp::read_file(file);
    text.resize(text.rfind('\n') + 1);  // the log replaces a row that was cut off
    scarp::CsvColumns const table(text, file.string());
    auto const names = columns(calibration_);
    if (table.names() != names)
      scarp::reject("'{}' has other parameters or targets than these: calibrate into another folder", file.string());
    auto const free = static_cast<Eigen::Index>(calibration_.free.size());
    auto const count = static_cast<Eigen::Index>(calibration_.observations.size());
    auto const reasons = table.texts("reason");
    for (auto const& reason : reasons) rows_.push_back(infeasible(calibration_, Eigen::VectorXd(free), reason));
    for (std::size_t column = 0; column + 1 < names.size(); ++column) {
      auto const values = numbers(table, names[column]);
      auto const k = static_cast<Eigen::Index>(column);
      for (std::size_t row = 0; row < rows_.size(); ++row) {
        auto& one = rows_[row];
        if (!std::isfinite(values[row]) && (k < free || reasons[row].empty()))
          table.reject_cell(row, names[column], "it is no number", "calibrate without --resume");
        if (k < free)
          one.shares(k) = values[row];
        else if (k == 2 * free)
          one.void_ratio = values[row];
        else if (k > 2 * free && k <= 2 * free + count)
          one.values(k - 2 * free - 1) = values[row];
        else if (k > 2 * free + count)
          one.scatter(k - 2 * free - 1 - count) = values[row];
      }
    }
    return file;
  }

  Calibration const& calibration_;
  std::vector<Evaluation> rows_;
  scarp::CsvLog log_;
};

}  // namespace rve_lab
