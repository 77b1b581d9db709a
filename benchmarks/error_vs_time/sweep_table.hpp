// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/status.hpp"
#include "scarp/io/csv.hpp"

namespace error_vs_time {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Responses and cost of one run. A response is what is compared with a reference: a stress path, a profile at fixed
/// places, a number. Responses of one name have the same length in all runs of a sweep.
struct Measured {
  std::vector<std::pair<std::string, Eigen::VectorXd>> responses{};
  long inner_steps = 0;  ///< DEM steps, where there are none iterations
  scarp::Verdict verdict{};
  double seconds = not_a_number;  ///< CPU time [s] without preparations; not a number: that of the whole run

  void add(std::string name, Eigen::VectorXd values) { responses.emplace_back(std::move(name), std::move(values)); }
  void add(std::string name, double value) { add(std::move(name), Eigen::VectorXd::Constant(1, value)); }

  bool finite() const {
    return std::all_of(responses.begin(), responses.end(), [](auto const& each) { return each.second.allFinite(); });
  }
};

/// Power of a setting by which an error shrinks, as neighbouring values of the setting show it. Estimates that differ
/// by more than `agreement` are no order.
struct ObservedOrder {
  static constexpr double agreement = 0.5;  ///< keeps first and second order apart
  static constexpr double beyond = 8.0;     ///< an estimate of this size is none

  std::vector<double> estimates;

  double mean() const {
    return std::accumulate(estimates.begin(), estimates.end(), 0.0) / static_cast<double>(estimates.size());
  }
  bool holds() const {
    if (estimates.empty()) return false;
    auto const [least, largest] = std::minmax_element(estimates.begin(), estimates.end());
    return *largest - *least <= agreement && *largest<beyond&& * least> - beyond;
  }
  /// Not a number where it does not hold.
  double value() const { return holds() ? mean() : not_a_number; }
};

/// From errors to a much better reference: \f$ p = \ln(e_1/e_2) / \ln(h_1/h_2) \f$ of neighbours. Nothing where a value
/// or an error is not above zero.
inline ObservedOrder order_of_errors(std::vector<double> const& sizes, std::vector<double> const& errors) {
  ObservedOrder order;
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) {
    if (!(std::min({sizes[k], sizes[k + 1], errors[k], errors[k + 1]}) > 0.0) || sizes[k] == sizes[k + 1]) return {};
    order.estimates.push_back(std::log(errors[k] / errors[k + 1]) / std::log(sizes[k] / sizes[k + 1]));
  }
  return order;
}

/// Indices of the points that no other beats in cost and error at once, the cheapest first. Points without a finite
/// cost and error never belong to it. Costs whose ratio is below 1 + noise count as equal: of such points the most
/// accurate belongs to the front, and of equal errors the first.
inline std::vector<std::size_t> pareto_front(std::vector<double> const& costs, std::vector<double> const& errors,
                                             double noise = 0.0) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t k) { return !std::isfinite(costs[k]) || !std::isfinite(errors[k]); });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
  std::vector<std::size_t> front;  // the most accurate first, costs falling
  for (std::size_t const k : order) {
    if (!front.empty() && costs[front.back()] <= (1.0 + noise) * costs[k]) continue;
    if (!front.empty() && errors[front.back()] == errors[k]) front.pop_back();
    front.push_back(k);
  }
  std::reverse(front.begin(), front.end());
  return front;
}

/// One setting of a knob, over all repetitions.
struct SweepRow {
  std::string knob;
  std::string setting;
  double value = not_a_number;   ///< of a number
  double seconds = 0.0;          ///< CPU time of a run, median of the repetitions
  double cost = 0.0;             ///< CPU time over that of the base setting, median of the repetitions' ratios
  double inner_steps = 0.0;      ///< mean
  bool new_sample = false;       ///< the error is that of one sample to the mean of all
  scarp::Verdict verdict{};      ///< the first of the repetitions that is not acceptable
  std::vector<double> errors{};  ///< for each response; root mean square over repetitions; no number for a failed run
  std::vector<double> orders{};  ///< of the knob, for each response; no number where it shows none
};

/// Errors and costs of all settings. The first row is the base setting.
struct SweepTable {
  std::string name;
  std::vector<std::string> responses{};
  int repetitions = 0;
  double cost_noise = 0.0;               ///< ratios of costs nearer to 1 than this mean nothing
  double reference_cost = not_a_number;  ///< over the base setting's; no number if exact
  /// Standard deviation over the repetitions' samples at the base setting, over the mean's norm, for each response; no
  /// number where repetitions do not differ.
  std::vector<double> scatter{};
  std::vector<SweepRow> rows{};

  /// Rows of the front of error and cost for a response, the cheapest first. \throws InputError for an unknown one
  std::vector<SweepRow> front(std::string_view response) const {
    auto const found = std::find(responses.begin(), responses.end(), response);
    if (found == responses.end()) {
      scarp::reject("sweep '{}' has no response '{}' (it has: {}): choose one of these", name, response,
                    scarp::listed(responses));
    }
    auto const column = static_cast<std::size_t>(found - responses.begin());
    std::vector<double> costs;
    std::vector<double> errors;
    for (auto const& row : rows) {
      costs.push_back(row.cost);
      errors.push_back(row.new_sample ? not_a_number : row.errors[column]);
    }
    std::vector<SweepRow> chosen;
    for (std::size_t const k : pareto_front(costs, errors, cost_noise)) chosen.push_back(rows[k]);
    return chosen;
  }

  /// One line for every row.
  std::string csv() const {
    std::vector<std::string> columns{
        "knob", "setting", "value", "CPU time [s]", "CPU time over the base setting [-]", "inner steps [-]"};
    for (auto const& response : responses) columns.push_back(response + " error [%]");
    for (auto const& response : responses) columns.push_back(response + " order [-]");
    columns.insert(columns.end(), {"new sample", "status", "reason"});
    std::string text;
    auto const add_line = [&](std::vector<std::string> const& cells) {
      std::vector<std::string> quoted;
      for (auto const& cell : cells) quoted.push_back(scarp::detail::csv_cell(cell));
      text += scarp::listed(quoted, ",") + "\n";
    };
    auto const cell = [](double value, double factor = 1.0) {
      return std::isfinite(value) ? fmt::format("{:.4g}", factor * value) : std::string();
    };
    add_line(columns);
    for (auto const& row : rows) {
      std::vector<std::string> cells{row.knob,          row.setting,    cell(row.value),
                                     cell(row.seconds), cell(row.cost), cell(row.inner_steps)};
      for (double const error : row.errors) cells.push_back(cell(error, 100.0));
      for (double const order : row.orders) cells.push_back(cell(order));
      cells.insert(cells.end(), {row.new_sample ? "1" : "0", std::string(scarp::name(row.verdict.status)),
                                 std::string(scarp::name(row.verdict.reason))});
      add_line(cells);
    }
    std::vector<std::string> cells{"base", "scatter of the samples", "", "", "", ""};
    for (double const share : scatter) cells.push_back(cell(share, 100.0));
    cells.resize(columns.size());
    add_line(cells);
    return text;
  }
};

}  // namespace error_vs_time
