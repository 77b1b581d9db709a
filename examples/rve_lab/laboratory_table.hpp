// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scarp/io/csv_reader.hpp"
#include "scarp/points/laboratory_paths.hpp"

namespace rve_lab {

/// Targets of a path from a table: eaa and saa of each axis a, ev and p are compression positive, shear angles gab and
/// stresses sab not.
template <int Dim>
struct TargetTable {
  scarp::CsvColumns table;
  std::vector<std::vector<double>> columns{};
  scarp::PathConditions<Dim> conditions{};  ///< with the targets of no row

  /// \throws InputError for columns that make no path
  explicit TargetTable(std::string const& file) : table(scarp::read_csv(file)) {
    if (table.rows() == 0) scarp::reject("'{}' has no rows (a path has one target at least): add them", file);
    std::vector<std::string> known;
    for (auto const& [name, condition] : all()) {
      known.push_back(name);
      if (!table.has(name)) continue;
      columns.push_back(table.column(name));
      conditions.push_back(condition);
    }
    for (auto const& name : table.names()) {
      if (std::ranges::find(known, name) == known.end())
        scarp::reject("'{}' has a column '{}' (targets are {}): rename it or leave it out", file, name,
                      scarp::listed(known));
    }
    for (auto const& [name, condition] : all()) {
      if (!name.starts_with('g') || table.has(name) || table.has("s" + name.substr(1))) continue;
      columns.emplace_back(table.rows(), 0.0);
      conditions.push_back(condition);
    }
    if (std::ssize(conditions) != scarp::voigt_size<Dim>)
      scarp::reject(
          "'{}' gives {} conditions, shear angles of zero included (a path in {} dimensions needs {}): choose among {}",
          file, conditions.size(), Dim, scarp::voigt_size<Dim>, scarp::listed(known));
  }

  scarp::PathConditions<Dim> row(std::size_t number) const {
    auto targets = conditions;
    for (std::size_t k = 0; k < targets.size(); ++k) targets[k].target = columns[k][number];
    return targets;
  }

 private:
  using Weights = scarp::VoigtStress<Dim>;

  static std::vector<std::pair<std::string, scarp::PathCondition<Dim>>> all() {
    constexpr std::string_view axes = "xyz";
    std::vector<std::pair<std::string, scarp::PathCondition<Dim>>> found;
    Weights trace = Weights::Zero();
    for (int k = 0; k < scarp::voigt_size<Dim>; ++k) {
      auto const [i, j] = scarp::voigt_indices<Dim>()[static_cast<std::size_t>(k)];
      std::string const place{axes[static_cast<std::size_t>(i)], axes[static_cast<std::size_t>(j)]};
      Weights const unit = k < Dim ? Weights(-Weights::Unit(k)) : Weights(Weights::Unit(k));
      found.push_back({(k < Dim ? "e" : "g") + place, {.of_strain = unit}});
      found.push_back({"s" + place, {.of_stress = unit}});
      if (k < Dim) trace += unit;
    }
    found.push_back({"ev", {.of_strain = trace}});
    found.push_back({"p", {.of_stress = trace / Dim}});
    return found;
  }
};

}  // namespace rve_lab
