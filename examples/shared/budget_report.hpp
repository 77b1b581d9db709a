// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/budget/budget_part.hpp"
#include "scarp/core/error.hpp"
#include "scarp/io/text_lines.hpp"

namespace examples {

/// Bounds instead of the default ones, each as "part=bound".
/// \throws InputError for a part that has no bound, a bound that is not a number or negative
inline scarp::ErrorBounds error_bounds(std::vector<std::string> const& given, scarp::ErrorBounds bounds = {}) {
  for (auto const& item : given) {
    auto const equals = std::min(item.find('='), item.size());
    std::string const name = item.substr(0, equals);
    std::string const number = item.substr(std::min(equals + 1, item.size()));
    double bound = 0.0;
    if (scarp::read_number(number, bound) != std::errc{} || !(bound >= 0.0))
      scarp::reject("'{}' is no bound of an error budget (a part, '=' and a number are expected): write residual=1e-3",
                    item);
    bool known = false;
    std::string names;
    scarp::ErrorBounds::members(bounds, [&](std::string_view part, double& value) {
      names += names.empty() ? "" : ", ";
      names += part;
      if (part != name) return;
      value = bound;
      known = true;
    });
    if (!known) scarp::reject("an error budget has no bound for '{}' (it has {}): name one of these", name, names);
  }
  return bounds;
}

/// \return what is wrong with such a bound; empty if nothing is
inline std::string bound_problem(std::string const& given) {
  try {
    error_bounds({given});
  } catch (scarp::InputError const& problem) {
    return problem.what();
  }
  return "";
}

inline nlohmann::ordered_json json_of(scarp::BudgetParts const& parts) {
  nlohmann::ordered_json json;
  json["within"] = scarp::budget_headline(parts).empty();
  for (auto const& part : parts) {
    auto& entry = json["parts"][part.name];
    entry = {{"value", part.value}, {"within", part.is_within()}, {"meaning", part.meaning}};
    if (std::isfinite(part.bound)) entry["bound"] = part.bound;
  }
  return json;
}

}  // namespace examples
