// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

namespace fault_rupture {

/// What a measure of summary.json is, for tables.
struct Words {
  std::string_view key;
  char const* what;
  char const* unit = "";
  double factor = 1.0;  ///< of the unit
};
inline constexpr double degree = 180.0 / std::numbers::pi;
/// Others go by their key.
inline constexpr std::array words{
    Words{"throw_over_depth", "throw over depth", "%", 100.0},
    Words{"k0", "K0 before faulting, mean"},
    Words{"k0_min", "K0 before faulting, least"},
    Words{"k0_max", "K0 before faulting, largest"},
    Words{"void_ratio", "void ratio before faulting, mean"},
    Words{"void_ratio_min", "void ratio before faulting, least"},
    Words{"void_ratio_max", "void ratio before faulting, largest"},
    Words{"surface_x05", "5 % of the throw has passed at x", "m"},
    Words{"surface_x50", "half of the throw has passed at x", "m"},
    Words{"surface_x95", "95 % of the throw has passed at x", "m"},
    Words{"surface_mean", "mean of the settlement profile at x", "m"},
    Words{"surface_slope_max", "steepest slope of the surface", "%", 100.0},
    Words{"rupture_dip", "dip from the tip to surface_x50", "degrees", degree},
    Words{"outcrop_x", "steepest line meets the surface at x", "m"},
    Words{"steepest_x", "steepest slope at x", "m"},
    Words{"outcrop_width", "width of that slope", "m"},
    Words{"largest_share", "largest settlement over throw"},
    Words{"dilated_area", "growth of the ground's area", "m2"},
    Words{"dilated_area_of_packings", "the same by void ratios", "m2"},
    Words{"settlement_footwall_over_throw", "settlement of the far footwall over throw"},
    Words{"settlement_hanging_wall_over_throw", "settlement of the far hanging wall over throw"},
    Words{"tilt", "tilt of the footing to the hanging wall", "degrees", degree},
    Words{"settlement", "settlement of the footing", "m"},
    Words{"horizontal_displacement", "horizontal motion of the footing", "m"},
    Words{"contact_pressure_min", "least pressure on its base", "kPa", 1e-3},
    Words{"contact_pressure_max", "largest pressure on its base", "kPa", 1e-3},
    Words{"contact_share", "share of its base with pressure", "%", 100.0},
    Words{"force_imbalance", "imbalance of the footing over its weight"},
    Words{"reaction", "reaction of the moving bedrock", "kN/m", 1e-3},
    Words{"band_x50", "half of the offset passes at x", "m"},
    Words{"band_width", "width of the band along the level", "m"},
    Words{"band_across", "width across the band", "m"},
    Words{"band_dip", "dip of the band", "degrees", degree},
    Words{"strip_size", "elements in the strip", "m"},
    Words{"strip_width", "width of the strip", "m"},
    Words{"strip_margin", "least distance of the band from the strip's edges", "m"},
    Words{"vertical_stress_error", "vertical stress against overburden, largest error", "%", 100.0},
    Words{"max_accepted_residual", "largest residual of an accepted step"},
    Words{"floor_share", "share of all stress in stiffness floors"},
    Words{"iterations", "iterations"},
    Words{"steps", "accepted load steps"},
    Words{"rejected_steps", "rejected load steps"},
    Words{"dem_steps", "DEM steps", "million", 1e-6}};

/// Of a measure, by its key or, in a band, the key before " at ".
inline Words words_of(std::string_view name) {
  auto const key = name.substr(0, name.find(" at "));
  auto const found = std::ranges::find(words, key, &Words::key);
  return found != words.end() ? *found : Words{key, ""};
}

}  // namespace fault_rupture
