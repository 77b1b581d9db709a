// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/listed.hpp"
#include "scarp/core/status.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/measure/detail/observed_order.hpp"
#include "scarp/measure/detail/pareto_front.hpp"

namespace scarp {

/// One setting of a knob, over all repetitions.
struct SweepRow {
  std::string knob;
  std::string setting;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< of a number, else not a number
  double seconds = 0.0;                                     ///< CPU time of a run, median of the repetitions
  double cost = 0.0;             ///< CPU time over that of the base setting, median of the repetitions' ratios
  double inner_steps = 0.0;      ///< mean
  bool new_sample = false;       ///< the error is that of one sample to the mean of all; says nothing of numerics
  Verdict verdict{};             ///< the worst of the repetitions
  std::vector<double> errors{};  ///< for each answer; root mean square over repetitions; no number for a failed run
};

/// What the values of one knob tell of the order of an answer.
struct KnobOrder {
  std::string knob;
  std::string answer;
  ObservedOrder to_reference;
  ObservedOrder richardson;
};

/// The knob of rows that differ from the base setting in several knobs.
inline constexpr std::string_view combined = "combined";

/// Errors and costs of all settings. The first row is the base setting.
struct SweepTable {
  std::string name;
  std::vector<std::string> answers{};
  int repetitions = 0;
  double cost_noise = 0.0;  ///< ratios of costs nearer to 1 than this say nothing
  double reference_cost = std::numeric_limits<double>::quiet_NaN();  ///< over the base setting's; no number if exact
  /// Standard deviation over the repetitions' samples at the base setting, over the mean's norm, for each answer; no
  /// number where repetitions do not differ.
  std::vector<double> scatter{};
  std::vector<SweepRow> rows{};
  std::vector<KnobOrder> orders{};

  /// \throws InputError for an answer that no run gave
  std::size_t column(std::string_view answer) const {
    for (std::size_t k = 0; k < answers.size(); ++k) {
      if (answers[k] == answer) return k;
    }
    refuse("sweep '{}' has no answer '{}' (it has: {}): choose one of these", name, answer, listed(answers));
  }

  /// Rows that no other beats in cost and error at once, cheapest first; see pareto_front.
  std::vector<SweepRow> front(std::string_view answer) const {
    std::vector<SweepRow> chosen;
    for (std::size_t const k : front_rows(column(answer))) chosen.push_back(rows[k]);
    return chosen;
  }

  /// The cheapest setting whose error is at most `error`; nothing where all are worse.
  std::vector<SweepRow> recommended(std::string_view answer, double error) const {
    std::size_t const a = column(answer);
    for (std::size_t const k : front_rows(a)) {
      if (rows[k].errors[a] <= error) return {rows[k]};
    }
    return {};
  }

  /// How many times more the row costs than the cheapest one with no larger error; 1 on the front.
  double excess_cost(std::size_t row, std::string_view answer) const {
    auto const best = recommended(answer, rows.at(row).errors[column(answer)]);
    return best.empty() ? std::numeric_limits<double>::quiet_NaN() : rows[row].cost / best.front().cost;
  }

  /// \throws FileError when the file cannot be written
  void write_csv(std::filesystem::path const& path) const { write_file(path, csv()); }

  /// One line for every row and answer.
  std::string csv() const {
    std::vector<std::string> columns{"knob",       "setting",     "answer", "value",   "seconds [s]",
                                     "cost",       "inner_steps", "error",  "scatter", "on_front",
                                     "new_sample", "status",      "reason"};
    CsvTable table(columns);
    for (std::size_t a = 0; a < answers.size(); ++a) {
      auto const best = front_rows(a);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        auto const& row = rows[k];
        int const on_front = std::find(best.begin(), best.end(), k) != best.end() ? 1 : 0;
        table.add(row.knob, row.setting, answers[a], row.value, row.seconds, row.cost, row.inner_steps, row.errors[a],
                  scatter[a], on_front, row.new_sample ? 1 : 0, name_of(row.verdict.status),
                  name_of(row.verdict.reason));
      }
    }
    return table.text();
  }

  std::string markdown() const;
  void print_markdown() const { fmt::print("{}", markdown()); }

  std::vector<std::size_t> front_rows(std::size_t answer) const {
    std::vector<double> costs;
    std::vector<double> errors;
    for (auto const& row : rows) {
      costs.push_back(row.cost);
      errors.push_back(row.new_sample ? std::numeric_limits<double>::infinity() : row.errors[answer]);
    }
    return pareto_front(costs, errors, cost_noise);
  }

 private:
  static std::string_view name_of(Status status) { return scarp::name(status); }
  static std::string_view name_of(Reason reason) { return scarp::name(reason); }
};

/// "0.42 %" of a share.
inline std::string percent(double share) {
  if (!std::isfinite(share)) return "-";
  return 100.0 * share < 99.5 ? fmt::format("{:.2g} %", 100.0 * share) : fmt::format("{:.0f} %", 100.0 * share);
}

/// A table of the rows (an error in bold lies on the front; combinations are left out but for those in bold), and one
/// of the orders where there are any.
inline std::string SweepTable::markdown() const {
  std::string text = "| knob | setting | CPU time / base | inner steps |";
  std::string rule = "|---|---|---|---|";
  std::vector<std::vector<std::size_t>> fronts;
  for (std::size_t a = 0; a < answers.size(); ++a) {
    text += fmt::format(" {} |", answers[a]);
    rule += "---|";
    fronts.push_back(front_rows(a));
  }
  text += "\n" + rule + "\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto const& row = rows[k];
    auto const on_front = [&](auto const& front) { return std::find(front.begin(), front.end(), k) != front.end(); };
    if (row.knob == combined && std::none_of(fronts.begin(), fronts.end(), on_front)) continue;
    text += fmt::format("| {} | {} | {:.3g} | {:.0f} |", row.knob, row.setting, row.cost, row.inner_steps);
    for (std::size_t a = 0; a < answers.size(); ++a) {
      char const* const mark = on_front(fronts[a]) ? "**" : "";
      text += row.verdict.acceptable()
                  ? fmt::format(" {}{}{} |", mark, percent(row.errors[a]), mark)
                  : fmt::format(" {} ({}) |", name_of(row.verdict.status), name_of(row.verdict.reason));
    }
    text += "\n";
  }
  text += "| base | scatter of the samples | | |";
  for (double const share : scatter) text += fmt::format(" {} |", percent(share));
  text += "\n";
  if (orders.empty()) return text;
  text += "\n| knob | answer | order of the error to the reference | Richardson's order |\n|---|---|---|---|\n";
  for (auto const& order : orders) {
    text += fmt::format("| {} | {} | {} | {} |\n", order.knob, order.answer, order.to_reference.text(),
                        order.richardson.text());
  }
  return text;
}

}  // namespace scarp
