// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace fault_rupture {

/// The run as text, beside what is expected of it and, where its site is the reference study's, beside that study's
/// numbers.
inline std::string table(nlohmann::ordered_json const& json) {
  auto const number = [&](char const* key) {
    return json.contains(key) && json[key].is_number() ? json[key].get<double>() : std::nan("");
  };
  auto const degrees = [](double angle) { return angle * 180.0 / std::numbers::pi; };
  bool const has_study = json.value("repeats_study", false);
  std::string text =
      fmt::format("{:<44} {:>12}   {}\n", "quantity", "this run", has_study ? "study / yardstick" : "yardstick");
  auto const row = [&](std::string const& what, std::string const& value, std::string const& reference) {
    auto const line = fmt::format("{:<44} {:>12}   {}", what, value, reference);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  };
  auto const of_study = [&](char const* study, std::string const& otherwise = "") {
    return has_study ? study : otherwise;
  };
  auto const fault_line = fmt::format("{:.2f} on the fault's own line", number("fault_line_x50"));
  row("K0 before faulting, mean", fmt::format("{:.3f}", number("k0")), of_study("about 0.4"));
  if (json.contains("void_ratio_min"))
    row("void ratio over the depth", fmt::format("{:.3f}-{:.3f}", number("void_ratio_min"), number("void_ratio_max")),
        of_study("0.160-0.179"));
  if (json.contains("floor_share"))
    row("stiffness of points without contacts, share of all stress", fmt::format("{:.1e}", number("floor_share")), "0");
  row("vertical stress against overburden, largest error",
      fmt::format("{:.2f} %", 100.0 * number("vertical_stress_error")), "0");
  row("throw / depth", fmt::format("{:.4f}", number("throw_over_depth")), of_study("0.085"));
  bool const is_free = !json.contains("footing_width");  // places of the reference study are those of its free field
  row("outcrop_x [m]: steepest line meets the surface", fmt::format("{:.2f}", number("outcrop_x")),
      is_free ? of_study("-12.5 (surface starts to deflect); dip alone -14.4", fault_line) : fault_line);
  row("steepest_x [m]", fmt::format("{:.2f}", number("steepest_x")),
      is_free ? of_study("sharp band: -14.5 to -6.5") : "");
  row("outcrop_width [m]", fmt::format("{:.2f}", number("outcrop_width")),
      is_free ? of_study("mild and broad slope, no figure given") : "");
  row("surface_x50 [m]: half of the throw has passed", fmt::format("{:.2f}", number("surface_x50")), fault_line);
  row("surface_x05, surface_x95 [m]", fmt::format("{:.2f}, {:.2f}", number("surface_x05"), number("surface_x95")),
      "a sharp band: both at surface_x50");
  row("surface_mean [m]: mean of the settlement profile", fmt::format("{:.2f}", number("surface_mean")),
      "follows from the dilated area (docs/grounds.md)");
  row("dilated_area [m2]: growth of the ground's area", fmt::format("{:.2f}", number("dilated_area")),
      "0 for a rigid hanging wall; over the throw: shift of the mean");
  if (json.contains("dilated_area_of_packings"))
    row("dilated_area_of_packings [m2]: by their void ratios",
        fmt::format("{:.2f}", number("dilated_area_of_packings")), "as the line above");
  row("steepest slope of the surface [degrees]", fmt::format("{:.1f}", degrees(std::atan(number("surface_slope_max")))),
      of_study("not reported"));
  row("rupture_dip [degrees]: tip to surface_x50", fmt::format("{:.1f}", degrees(number("rupture_dip"))),
      "the fault's dip, and its dilation above that");
  for (auto const& band : json["bands"]) {
    auto const of_band = [&](char const* key) { return band[key].get<double>(); };
    row(fmt::format("at {:.2f} of the depth: x50, width [m], dip", of_band("height_over_depth")),
        fmt::format("{:.1f}, {:.1f}, {:.0f}", of_band("band_x50"), of_band("band_width"), degrees(of_band("band_dip"))),
        "as the line above; across, the width of a shear band");
  }
  if (json.contains("strip_margin"))
    row("least distance of the band from the strip's edges [m]", fmt::format("{:.1f}", number("strip_margin")),
        "below 0 the band leaves the strip: compare with a wider --strip-width");
  auto const& distorted = json["distorted_element"];
  row("most distorted element: number, shear [%], mean ratio",
      fmt::format("{}, {:.0f}, {:.2f}", distorted["number"].get<int>(), 100.0 * distorted["shear"].get<double>(),
                  distorted["mean_ratio"].get<double>()),
      "a regular element has shear 0 and mean ratio 1");
  row("settlement of the far footwall / throw", fmt::format("{:.4f}", number("settlement_footwall_over_throw")), "0");
  row("settlement of the far hanging wall / throw", fmt::format("{:.4f}", number("settlement_hanging_wall_over_throw")),
      "1");
  if (json.contains("tilt")) {
    row("tilt of the footing towards the hanging wall [degrees]", fmt::format("{:.3f}", degrees(number("tilt"))),
        of_study("no figure given"));
    row("settlement of the footing [m]", fmt::format("{:.3f}", number("settlement")), of_study("no figure given"));
    row("contact pressure [kPa]",
        fmt::format("{:.0f}-{:.0f}", number("contact_pressure_min") / 1e3, number("contact_pressure_max") / 1e3),
        "mean: the bearing pressure");
    row("imbalance of the footing over its weight", fmt::format("{:.1e}", number("force_imbalance")), "0");
  }
  if (json.contains("water")) {
    for (auto const& [when, water] : json["water"].items()) {
      auto const at = [&, &water = water](char const* key) {
        return water[key].is_number() ? water[key].template get<double>() : std::nan("");
      };
      std::string name = when;
      std::ranges::replace(name, '_', ' ');
      row(fmt::format("{}, {:.4g} s: excess pressure [kPa]", name, at("time")),
          fmt::format("{:.1f}, {:.1f}", at("excess_pressure_min") / 1e3, at("excess_pressure_max") / 1e3),
          fmt::format("largest over the overburden, r_u: {:.2f}", at("pressure_ratio_max")));
      row("  water that has left, vapour [m3 per m]", fmt::format("{:.3f}, {:.3f}", at("expelled"), at("vapour")), "");
      row("  surface_x50 [m], steepest slope [degrees]",
          fmt::format("{:.2f}, {:.1f}", at("surface_x50"), degrees(std::atan(at("surface_slope_max")))), "");
      if (std::isfinite(at("tilt")))
        row("  settlement [m] and tilt [degrees] of the footing",
            fmt::format("{:.3f}, {:.3f}", at("settlement"), degrees(at("tilt"))), "");
    }
  }
  row("largest residual of an accepted step", fmt::format("{:.2e}", number("max_accepted_residual")),
      of_study("not reported"));
  row("share of the time outside the material points",
      fmt::format("{:.1f} %", 100.0 * number("share_of_time_outside_points")), of_study("not reported"));
  return text;
}

}  // namespace fault_rupture
