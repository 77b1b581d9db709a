// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "strength.hpp"
#include "stress_scatter.hpp"

namespace rve_biaxial {

inline nlohmann::json to_json(Spread const& spread) {
  return {{"mean", spread.mean}, {"standard_deviation", spread.deviation}};
}

/// The packings of each preparation friction; those of one stand side by side.
inline std::vector<std::span<Result const>> by_friction(std::span<Result const> results) {
  std::vector<std::span<Result const>> groups;
  for (std::size_t begin = 0; begin < results.size();) {
    std::size_t end = begin;
    while (end < results.size() && results[end].preparation_friction == results[begin].preparation_friction) ++end;
    groups.push_back(results.subspan(begin, end - begin));
    begin = end;
  }
  return groups;
}

/// The row at the middle of the window of 0.5 % axial strain, or of the whole of a shorter test, with the largest
/// stress ratio.
inline Row const& peak_row(Result const& result) {
  double const window = std::min(0.005, result.rows.back().axial_strain - result.rows.front().axial_strain);
  double const strain = peak_angles(result.rows, window).friction_strain;
  return *std::min_element(result.rows.begin(), result.rows.end(), [&](Row const& a, Row const& b) {
    return std::abs(a.axial_strain - strain) < std::abs(b.axial_strain - strain);
  });
}

inline Row const& start_row(Result const& result) { return result.rows.front(); }
inline Row const& end_row(Result const& result) { return result.rows.back(); }

/// A state of the test whose fabrics are reported.
struct Moment {
  char const* name;
  Row const& (*row)(Result const&);
};
inline constexpr std::array moments{Moment{"start", start_row}, Moment{"peak", peak_row}, Moment{"end", end_row}};

/// An angle [degrees] that a packing has, and the reference study's value of it.
struct Angle {
  enum class Kind { friction, dilation, secant_dilation };
  Kind kind;
  double window = 0.0;  ///< axial strain; the secant has none

  double of(Result const& result) const {
    if (kind == Kind::secant_dilation) return secant_dilation_angle(result.rows);
    auto const peak = peak_angles(result.rows, window);
    return kind == Kind::friction ? peak.friction_angle : peak.dilation_angle;
  }
  double study() const { return kind == Kind::friction ? 30.8 : 6.6; }
  std::string name() const {
    return kind == Kind::friction ? "phi_max" : kind == Kind::dilation ? "psi_max" : "psi_secant";
  }
};

inline std::vector<Angle> all_angles(std::vector<double> const& windows) {
  std::vector<Angle> angles;
  for (auto const kind : {Angle::Kind::friction, Angle::Kind::dilation}) {
    for (double const window : windows) angles.push_back({kind, window});
  }
  angles.push_back({Angle::Kind::secant_dilation, 0.0});
  return angles;
}

/// Least-squares line of an angle [degrees] over the void ratio at the start.
struct Line {
  double slope = 0.0;
  double at_zero = 0.0;
  double residual = 0.0;  ///< standard deviation of the packings about the line [degrees]
  double least = 0.0;     ///< void ratio of the packings
  double most = 0.0;

  /// Where the line meets an angle, if that is among the packings.
  std::optional<double> meets(double angle) const {
    double const place = (angle - at_zero) / slope;
    if (!(least <= place && place <= most)) return std::nullopt;
    return place;
  }
};

/// \return nothing for fewer than three packings, or equal void ratios
inline std::optional<Line> fit(std::span<Result const> results, Angle const& angle) {
  double const count = static_cast<double>(results.size());
  if (count < 3.0) return std::nullopt;
  auto const place = [](Result const& result) { return start_row(result).void_ratio; };
  double const middle = spread_over(results, place).mean;
  double const mean = spread_over(results, [&](Result const& result) { return angle.of(result); }).mean;
  Line line;
  line.least = line.most = middle;
  double square = 0.0;
  double product = 0.0;
  for (auto const& result : results) {
    double const away = place(result) - middle;
    square += away * away;
    product += away * (angle.of(result) - mean);
    line.least = std::min(line.least, place(result));
    line.most = std::max(line.most, place(result));
  }
  if (!(square > 0.0)) return std::nullopt;
  line.slope = product / square;
  line.at_zero = mean - line.slope * middle;
  for (auto const& result : results) {
    double const missed = angle.of(result) - line.at_zero - line.slope * place(result);
    line.residual += missed * missed / (count - 2.0);
  }
  line.residual = std::sqrt(line.residual);
  return line;
}

/// The lines of all angles, and where they meet the reference study's.
inline nlohmann::json lines_over_void_ratio(std::span<Result const> results, std::vector<double> const& windows) {
  nlohmann::json lines = nlohmann::json::array();
  for (auto const& angle : all_angles(windows)) {
    auto const line = fit(results, angle);
    if (!line) continue;
    nlohmann::json entry{{"angle", angle.name()},
                         {"slope", line->slope},
                         {"at_zero", line->at_zero},
                         {"residual_standard_deviation", line->residual},
                         {"void_ratio_range", {line->least, line->most}},
                         {"study", angle.study()},
                         {"void_ratio_at_study", nullptr}};
    if (angle.window > 0.0) entry["window"] = angle.window;
    if (auto const place = line->meets(angle.study())) entry["void_ratio_at_study"] = *place;
    lines.push_back(entry);
  }
  return lines;
}

/// Means and deviations over the packings of one friction.
inline nlohmann::json summarise_friction(std::span<Result const> packings, std::vector<double> const& windows) {
  auto const spread = [&](auto const& measure) { return to_json(spread_over(packings, measure)); };
  nlohmann::json entry{{"preparation_friction", packings.front().preparation_friction},
                       {"packings", packings.size()},
                       {"void_ratio", spread([](Result const& r) { return start_row(r).void_ratio; })},
                       {"coordination", spread([](Result const& r) { return start_row(r).coordination; })},
                       {"peak_axial_strain", spread([](Result const& r) { return peak_row(r).axial_strain; })},
                       {"void_ratio_at_end", spread([](Result const& r) { return end_row(r).void_ratio; })},
                       {"psi_secant", spread([](Result const& r) { return secant_dilation_angle(r.rows); })},
                       {"stress_scatter", stress_scatter(packings)}};  // NaN becomes null
  for (double const window : windows) {
    auto const [friction, dilation] = peak_spreads(packings, window);
    entry["windows"].push_back({{"window", window}, {"phi_max", to_json(friction)}, {"psi_max", to_json(dilation)}});
  }
  for (Moment const& moment : moments) {
    entry["contact_fabric"][moment.name] = spread([&](Result const& r) { return moment.row(r).contact_fabric; });
    entry["particle_fabric"][moment.name] = spread([&](Result const& r) { return moment.row(r).particle_fabric; });
  }
  return entry;
}

}  // namespace rve_biaxial
