// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../shared/command_line.hpp"
#include "../shared/sand/sand.hpp"
#include "laboratory_data.hpp"
#include "mean_curve.hpp"
#include "scarp/io/text_lines.hpp"

namespace rve_lab {

using examples::Sand;

/// A parameter of the sand that the calibration is free to choose within bounds.
struct Free {
  std::string name;
  double least = 0.0;
  double most = 1.0;

  /// \throws InputError for an option that is no number
  double& of(Sand& sand) const {
    double* found = nullptr;
    examples::for_each_option(sand, [&](std::string const& option, auto& member, examples::Range, char const*) {
      if constexpr (std::is_same_v<std::remove_reference_t<decltype(member)>, double>) {
        if (option == name && !examples::is_of_file(name)) found = &member;
      }
    });
    if (found == nullptr) scarp::reject("--free names '{}' (no number of a sand): see --help for its options", name);
    return *found;
  }
  /// Stiffnesses are varied by ratio. share: from 0 to 1
  double at(double share) const {
    return by_ratio() ? least * std::pow(most / least, share) : least + share * (most - least);
  }
  double share_of(double value) const {
    return by_ratio() ? std::log(value / least) / std::log(most / least) : (value - least) / (most - least);
  }
  /// Whether zero is no bound: it has no ratio, or means that the option is not used.
  bool begins_above_zero() const {
    return by_ratio() || name == "void-ratio" || name == "relative-density" || name == "vertical-pressure" ||
           name == "k0";
  }

 private:
  bool by_ratio() const { return name == "modulus" || name.ends_with("stiffness"); }
};

/// A number that the mean curve is to have.
struct Observation {
  std::string name;
  std::size_t group = 0;  ///< the columns of a table count as one number each
  double wanted = 0.0;
  double least_scatter = 0.0;
  double reached = 0.0;  ///< how near it is to come, 0 for those of tables
  double strain = 0.0;   ///< of a table's row
  bool windowed = false;
  std::function<double(Curve const&)> of{};
};

inline double number_in(std::string const& text, std::string_view option) {
  double value = 0.0;
  if (scarp::read_number(text, value) != std::errc{} || !std::isfinite(value))
    scarp::reject("--{} has '{}' (a number is expected): correct it", option, text);
  return value;
}

/// "name=least:most,...": parameters with their bounds; some have usual ones.
/// sand: with whose other values the bounds are to be possible
/// \throws InputError
inline std::vector<Free> free_parameters(std::string const& text, Sand const& sand = {}) {
  std::vector<Free> all;
  for (auto const& item : examples::list_items(text)) {
    auto const equals = item.find('=');
    Free one{item.substr(0, equals)};
    if (equals == std::string::npos) {
      if (one.name == "friction")
        one.least = 0.1;
      else if (one.name == "relative-density")
        one.least = 0.05;
      else if (one.name == "rolling-friction")
        one.most = 0.5;
      else if (one.name == "normal-stiffness")
        one.least = 2e6, one.most = 2e8;
      else if (one.name == "modulus")
        one.least = 1e8, one.most = 1e10;
      else
        scarp::reject("--free has '{}' (its bounds are not usual ones): give {}=LEAST:MOST", item, item);
    } else {
      auto const bounds = item.substr(equals + 1);
      auto const colon = bounds.find(':');
      if (colon == std::string::npos) scarp::reject("--free has '{}' (name=LEAST:MOST is expected): correct it", item);
      one.least = number_in(bounds.substr(0, colon), "free");
      one.most = number_in(bounds.substr(colon + 1), "free");
    }
    if (!(one.least < one.most))
      scarp::reject("--free has {} from {} to {} (the first is to be below the second): correct it", one.name,
                    one.least, one.most);
    if (one.begins_above_zero() && !(one.least > 0.0))
      scarp::reject("--free has {} from {} (a bound above 0 is expected): raise it", one.name, one.least);
    if (std::ranges::find(all, one.name, &Free::name) != all.end())
      scarp::reject("--free names '{}' twice: leave one out", one.name);
    Sand trial = sand;
    if (examples::sets_density(one.name)) trial.void_ratio = trial.relative_density = 0.0;
    for (double const end : {one.least, one.most}) {
      one.of(trial) = end;
      examples::validate(trial);
    }
    all.push_back(std::move(one));
  }
  return all;
}

/// "name=value,...": targets.
inline std::vector<Observation> targets(std::string const& text, double window) {
  std::vector<Observation> all;
  if (text.empty()) return all;
  for (auto const& item : examples::list_items(text)) {
    auto const equals = item.find('=');
    if (equals == std::string::npos) scarp::reject("--target has '{}' (name=VALUE is expected): correct it", item);
    Measure const& measure = measure_named(item.substr(0, equals));
    double const wanted = number_in(item.substr(equals + 1), "target");
    if (measure.relative && !(wanted > 0.0))
      scarp::reject("--target {} is {} (above 0 is expected): correct it", measure.name, wanted);
    if (std::ranges::any_of(all, [&](Observation const& other) { return other.name == measure.name; }))
      scarp::reject("--target names '{}' twice: leave one out", measure.name);
    double const unit = measure.relative ? std::abs(wanted) : 1.0;
    all.push_back({.name = std::string(measure.name),
                   .group = all.size(),
                   .wanted = wanted,
                   .least_scatter = unit * measure.least_scatter,
                   .reached = unit * measure.reached,
                   .windowed = measure.windowed,
                   .of = [&measure, window](Curve const& curve) {
                     return measure.of(laboratory_results<2>(curve.rows, window), curve);
                   }});
  }
  return all;
}

/// A column at a strain, by straight lines between rows; the last value beyond them. strains: increasing
inline double at_strain(std::vector<double> const& strains, std::vector<double> const& column, double strain) {
  auto const after = static_cast<std::size_t>(std::ranges::lower_bound(strains, strain) - strains.begin());
  if (after == 0) return column.front();
  if (after == strains.size()) return column.back();
  double const share = (strain - strains[after - 1]) / (strains[after] - strains[after - 1]);
  return column[after - 1] + share * (column[after] - column[after - 1]);
}

/// A column of a curve at an axial strain; no number beyond its end. of: a row
inline double at_strain(Curve const& curve, double strain, double (*of)(LaboratoryRow<2> const&)) {
  std::vector<double> strains, column;
  for (auto const& row : curve.rows) {
    strains.push_back(row.axial_strain());
    column.push_back(of(row));
  }
  constexpr double slight = 1e-9;
  if (strain > strains.back() * (1.0 + slight)) return std::numeric_limits<double>::quiet_NaN();
  return at_strain(strains, column, strain);
}

inline double sine_of(LaboratoryRow<2> const& row) { return std::sin(row.friction()); }
inline double volumetric_strain_of(LaboratoryRow<2> const& row) { return row.volumetric_strain(); }

/// Twenty strains, denser at the start, at which the curve is to have the table's values. after: groups so far
inline std::vector<Observation> observations_of(LabTable const& table, std::size_t groups) {
  constexpr int rows = 20;
  std::vector<Observation> all;
  double const last = table.strain.back();
  for (auto const& [name, strains, column, scatter, of] :
       {std::tuple{"sine of friction angle", &table.sine_strain, &table.sine, 0.005, &sine_of},
        std::tuple{"volumetric strain", &table.strain, &table.volumetric, 2e-4, &volumetric_strain_of}}) {
    if (column->empty()) continue;
    for (int row = 1; row <= rows; ++row) {
      double const strain = last * std::pow(row / static_cast<double>(rows), 1.5);
      if (strain < table.strain.front()) continue;
      all.push_back({.name = name,
                     .group = groups,
                     .wanted = at_strain(*strains, *column, strain),
                     .least_scatter = scatter,
                     .strain = strain,
                     .of = [strain, quantity = of](Curve const& curve) { return at_strain(curve, strain, quantity); }});
    }
    ++groups;
  }
  return all;
}

}  // namespace rve_lab
