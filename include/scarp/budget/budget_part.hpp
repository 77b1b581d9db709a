// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace scarp {

/// One number of an error budget and the bound that was set for it.
struct BudgetPart {
  std::string name{};
  double value = 0.0;
  double bound = 0.0;     ///< infinite: no bound
  std::string meaning{};  ///< in words, with what it is relative to

  /// NaN is outside.
  bool is_within() const { return value <= bound; }
};

using BudgetParts = std::vector<BudgetPart>;

/// A line that names the parts outside their bounds; empty without any.
inline std::string budget_headline(BudgetParts const& parts) {
  std::string line;
  for (auto const& part : parts) {
    if (part.is_within()) continue;
    line += line.empty() ? "OUTSIDE ITS ERROR BUDGET: " : "; ";
    line += fmt::format("{} is {:.2g}, bound {:.2g}", part.name, part.value, part.bound);
  }
  return line.empty() ? line : line + '\n';
}

/// All parts as text, a line each.
inline std::string budget_table(BudgetParts const& parts) {
  std::string text = fmt::format("{:<24} {:>10} {:>10}   {}\n", "error budget", "value", "bound", "what it is");
  for (auto const& part : parts) {
    std::string const bound = std::isfinite(part.bound) ? fmt::format("{:.2e}", part.bound) : "none";
    text += fmt::format("{:<24} {:>10.2e} {:>10} {} {}\n", part.name, part.value, bound, part.is_within() ? ' ' : '!',
                        part.meaning);
  }
  return text;
}

}  // namespace scarp
