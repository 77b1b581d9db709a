// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "../shared/process_usage.hpp"
#include "../shared/renamed_keys.hpp"
#include "any_scene.hpp"
#include "footing_log.hpp"
#include "scarp/budget/budget_part.hpp"
#include "scarp/core/described.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_survey.hpp"
#include "scarp/io/atomic_file.hpp"
#include "scarp/observe/distortion.hpp"
#include "scarp/observe/totals.hpp"
#include "surface_mean.hpp"
#include "team.hpp"

namespace fault_rupture {

/// The ground after the geostatic stage, before anything is placed and the fault moves.
struct AtRest {
  double k0 = 0.0;  ///< mean over the soil's points of horizontal over vertical stress
  double k0_min = 0.0;
  double k0_max = 0.0;
  double void_ratio = 0.0;  ///< mean over the soil's points; these three are not finite where it has no packings
  double void_ratio_min = 0.0;
  double void_ratio_max = 0.0;
  double vertical_error = 0.0;      ///< largest |vertical stress / overburden - 1|
  scarp::GroundAtRest<2> ground{};  ///< with what stands on it
  double solid_volume = 0.0;        ///< of the grains, per metre out of the plane [m2]; 0 without packings

  SCARP_MEMBERS(k0, k0_min, k0_max, void_ratio, void_ratio_min, void_ratio_max, vertical_error, ground, solid_volume)
};

/// Totals of earlier processes in a resumed run.
struct RunNotes {
  AtRest rest{};
  double reaction_at_rest = std::numeric_limits<double>::quiet_NaN();  ///< see generalised_reaction [N]
  examples::RunUsage used;

  SCARP_MEMBERS(rest, reaction_at_rest, used)
};

inline AtRest at_rest(Problem const& problem, Scene const& scene) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  AtRest rest{0.0, infinity, -infinity, 0.0, infinity, -infinity, 0.0, {}, 0.0};
  auto const& grid = problem.discretisation();
  int const soil = scarp::region_number(grid.mesh(), "soil");
  int points = 0;
  int packings = 0;
  for (int point = 0; point < grid.point_count(); ++point) {
    auto const site = grid.site(point, scene.ground.surface_level());
    if (site.region != soil) continue;
    ++points;
    auto const stress = committed_stress(problem, point);
    double const ratio = stress(0) / stress(1);
    rest.k0 += ratio;
    rest.k0_min = std::min(rest.k0_min, ratio);
    rest.k0_max = std::max(rest.k0_max, ratio);
    double const overburden = scene.overburden(site.depth);
    rest.vertical_error = std::max(rest.vertical_error, std::abs(-stress(1) / overburden - 1.0));
    visit_point(problem, point, [&](auto const& of, int number) {
      for (auto const& [quantity, value] : of.quantities(number)) {
        if (quantity != "void_ratio") continue;
        ++packings;
        rest.void_ratio += value;
        rest.void_ratio_min = std::min(rest.void_ratio_min, value);
        rest.void_ratio_max = std::max(rest.void_ratio_max, value);
      }
    });
  }
  rest.k0 /= points;
  rest.void_ratio /= packings;
  return rest;
}

/// A footing's motion and what presses on its base; nothing for bare ground.
/// load: factor of the committed state; below 0 a part of the footing's weight acts
inline void add_footing(nlohmann::ordered_json& json, Scene const& scene, Problem const& problem, double load) {
  if (!scene.footing) return;
  auto const motion = scene.footing->motion(problem, load);
  auto const pressure = base_pressure(motion);
  auto const& strip = scene.footing->strip;
  double const weight = strip.bearing * strip.width;
  double const acting = std::clamp(load - scene.stages.start, 0.0, 1.0) * weight;
  json["bearing_pressure"] = strip.bearing;
  json["footing_centre"] = strip.centre;
  json["footing_width"] = strip.width;
  json["tilt"] = motion.tilt;
  json["settlement"] = motion.settlement;
  json["horizontal_displacement"] = motion.horizontal;
  json["contact_pressure_min"] = pressure.least;
  json["contact_pressure_max"] = pressure.largest;
  json["contact_share"] = pressure.pressed;
  json["force_imbalance"] = std::abs(scarp::support(motion) - acting) / weight;
}

/// Where and how sharply the offset comes through the ground; lengths [m], angles [rad].
/// fault_line_x50: where a rigid hanging wall would come out, on the fault's own line [m]
inline void add_rupture(nlohmann::ordered_json& json, scarp::RuptureSurvey const& survey, double fault_line_x50) {
  auto const& surface = survey.surface;
  json["outcrop_x"] = surface.outcrop_x;
  json["steepest_x"] = surface.steepest_x;
  json["outcrop_width"] = surface.outcrop_width;
  json["surface_x05"] = surface.surface_x05;
  json["surface_x50"] = surface.surface_x50;
  json["surface_x95"] = surface.surface_x95;
  json["surface_slope_max"] = surface.surface_slope_max;
  json["rupture_dip"] = surface.rupture_dip;
  json["largest_share"] = surface.largest_share;
  json["fault_line_x50"] = fault_line_x50;
  for (auto const& band : survey.bands) {
    json["bands"].push_back({{"height_over_depth", band.height / survey.depth},
                             {"band_x50", band.band_x50},
                             {"band_width", band.band_width},
                             {"band_across", band.band_across},
                             {"band_dip", band.band_dip}});
  }
}

/// The strip of small elements: its edges, evenly from bedrock to the surface, and on bare ground the least distance
/// between them and the band, which has gone from 5 to 95 % of the offset; a footing spreads the settlement beside the
/// band. [m]
/// bottom: y of the bedrock in the mesh [m]
inline void add_strip(nlohmann::ordered_json& json, PilotSize const& strip, scarp::RuptureSurvey const& survey,
                      double bottom, bool is_bare) {
  constexpr int levels = 25;
  json["strip_size"] = strip.fine;
  json["strip_width"] = 2.0 * strip.margin;
  for (int k = 0; k <= levels; ++k) json["strip_edges"].push_back(strip.edges(bottom + survey.depth * k / levels));
  if (!is_bare) return;
  double margin = std::numeric_limits<double>::infinity();
  for (auto const& band : survey.bands) {
    auto const [left, right] = strip.edges(bottom + band.height);
    bool const has_strip = left < right;
    double const distance =
        has_strip ? std::min(band.band_x05 - left, right - band.band_x05 - band.band_width) : -band.band_width;
    if (!(distance >= margin)) margin = distance;  // also where a level has no band
  }
  json["strip_margin"] = margin;
}

/// reaction: of the moving bedrock, less that at rest [N]
inline nlohmann::ordered_json summary(Choice const& choice, Scene const& scene, Problem const& problem,
                                      RunNotes const& notes, double reaction, scarp::RunReport const& run) {
  auto const& rest = notes.rest;
  auto const& grid = problem.discretisation();
  auto const& ground = rest.ground.of(grid.nodes());
  auto const profile = scarp::surface_profile(grid.mesh(), ground, grid.positions());
  double const thrown = std::clamp(run.load, 0.0, scene.stages.throw_to);
  auto const offset = scarp::offset_at(scene.fault, thrown);
  auto const survey = scarp::rupture_survey(grid.mesh(), ground, grid.positions(), offset);
  double const from_side = 0.2 * choice.depth;  // where the far field is read: the sides themselves are prescribed
  nlohmann::ordered_json json;
  json["status"] = run.verdict.acceptable() ? "ok" : std::string(name(run.verdict.reason));
  json["repeats_study"] = repeats_study(choice);
  json["depth"] = scene.ground.depth();
  json["element"] = element_name;
  json["elements"] = grid.mesh().elements.size();
  double const bottom = scene.ground.surface_level() - scene.ground.depth();
  if (scene.ground.strip) add_strip(json, *scene.ground.strip, survey, bottom, choice.scene == Case::free);
  auto const distorted = scarp::largest_distortion(grid, "soil");
  json["distorted_element"] = {{"number", distorted.element},
                               {"x", distorted.place.x()},
                               {"y", distorted.place.y()},
                               {"shear", distorted.shear},
                               {"mean_ratio", distorted.mean_ratio}};
  if (choice.soil == Soil::dem) {
    json["grains_per_rve"] = choice.grains;
    json["seed"] = choice.seed;
    for (auto const& layer : choice.layers) json["layer_tops"].push_back(layer.top);
  }
  json["throw_over_depth"] = thrown / scene.ground.depth();
  json["k0"] = rest.k0;
  json["k0_min"] = rest.k0_min;
  json["k0_max"] = rest.k0_max;
  if (choice.soil == Soil::dem) {
    json["void_ratio"] = rest.void_ratio;
    json["void_ratio_min"] = rest.void_ratio_min;
    json["void_ratio_max"] = rest.void_ratio_max;
  }
  json["vertical_stress_error"] = rest.vertical_error;
  add_rupture(json, survey, offset.tip - survey.depth / std::tan(scene.fault.dip));
  auto const mean = surface_mean(grid.mesh(), ground, grid.positions(), offset);
  json["surface_mean"] = mean.surface_mean;
  json["dilated_area"] = mean.dilated_area;
  if (rest.solid_volume > 0.0) {
    // Area that the solids of now fill at the packings' void ratios, less that which those at rest do.
    double const area = scarp::region_area(grid.mesh(), "soil", grid.positions());
    double const excess = area * (1.0 - rest.solid_volume / scarp::solid_volume(problem));
    json["dilated_area_of_packings"] = mean.dilated_area - excess;
  }
  json["reaction"] = reaction;
  json["settlement_footwall_over_throw"] =
      offset.share(scarp::settlement_at(profile, profile.front().x_initial + from_side));
  json["settlement_hanging_wall_over_throw"] =
      offset.share(scarp::settlement_at(profile, profile.back().x_initial - from_side));
  add_footing(json, scene, problem, run.load);
  json["tolerance"] = scene.tolerance;
  json["max_accepted_residual"] = run.largest_residual;
  json["steps"] = run.steps;
  json["rejected_steps"] = run.refused;
  json["last_rejection"] = std::string(name(run.last_failure));
  if (choice.soil == Soil::dem) json["floor_share"] = scarp::floor_share(problem);
  json["iterations"] = run.iterations;
  json["dem_steps"] = run.inner_steps;
  json["share_of_time_in_points"] = run.seconds > 0.0 ? run.material_seconds / run.seconds : 0.0;
  json["share_of_time_outside_points"] = 1.0 - json["share_of_time_in_points"].get<double>();
  json["threads"] = problem.executor().threads();
  if (ranks() > 1) json["ranks"] = ranks();
  json["cpu_seconds"] = notes.used.cpu_seconds();
  json["wall_seconds"] = notes.used.wall_seconds();
  json["peak_memory_bytes"] = notes.used.peak_memory_bytes();
  examples::add_keys_from_before(json);
  return json;
}

/// By how much the mean of the profile is off for volume that the ground has gained and its packings have not; nothing
/// without packings and before the fault moves. depth: of the ground [m]
inline void add_volume_part(scarp::BudgetParts& parts, nlohmann::ordered_json const& json, double depth, double bound) {
  double const offset = depth * json["throw_over_depth"].get<double>();
  if (!json.contains("dilated_area_of_packings") || !(offset > 0.0)) return;
  double const excess = json["dilated_area"].get<double>() - json["dilated_area_of_packings"].get<double>();
  parts.push_back(
      {.name = "volume",
       .value = std::abs(excess) / (offset * depth),
       .bound = bound,
       .meaning = "dilated area that the packings do not have, over the throw and the depth of the ground"});
}

}  // namespace fault_rupture
