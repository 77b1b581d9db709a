// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "any_scene.hpp"
#include "scarp/core/described.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/rupture_survey.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/observers.hpp"

namespace fault_rupture {

#ifndef FAULT_RUPTURE_WATER
/// Nothing to log.
struct WaterLog : scarp::NeverStops {
  WaterLog(std::filesystem::path const&, Scene const&, double, scarp::CsvStart) {}
  void attempted(Problem const&, scarp::StepReport const&) {}
  static void add_to(nlohmann::ordered_json&) {}
};
#else
/// Pore water over time, from when the fault begins to move: a row of water.csv for every accepted step.
class WaterLog : public scarp::NeverStops {
 public:
  /// unit: of loads in tables [m]
  WaterLog(std::filesystem::path const& folder, Scene const& scene, double unit, scarp::CsvStart start)
      : scene_(scene), unit_(unit), table_(folder / "water.csv", {names.begin(), names.end()}, start) {}

  void attempted(Problem const& problem, scarp::StepReport const& report) {
    rest_.attempted(problem, report);
    if (!report.verdict.acceptable()) return;
    if (!(report.load > 0.0)) expelled_ = problem.attached<Water>().expelled();
    if (report.load < 0.0) return;
    rows_.push_back(row_of(problem, report.load));
    std::apply([&](auto... values) { table_.add(values...); }, rows_.back());
  }

  /// What the water did by the end of the throw, a minute later and at the end, as far as the run has come.
  void add_to(nlohmann::ordered_json& json) const {
    if (rows_.empty()) return;
    auto const add = [&](char const* when, Row const& row) {
      for (std::size_t k = 0; k < names.size(); ++k) json["water"][when][names[k]] = row[k];
    };
    double const thrown = scene_.rupture_time;
    for (auto const& [when, time] :
         {std::pair("after_the_throw", thrown), std::pair("after_a_minute", thrown + 60.0)}) {
      auto const is_then = [time = time](Row const& row) { return std::abs(row[1] - time) <= 1e-9 * time; };
      if (auto const row = std::ranges::find_if(rows_, is_then); row != rows_.end()) add(when, *row);
    }
    add("at_the_end", rows_.back());
  }

  SCARP_MEMBERS_EXCEPT((scene_, unit_), table_, rest_, rows_, expelled_)

 private:
  using Water = scarp::PoreWater<Grid, scarp::KozenyCarman>;
  static constexpr std::array names{"throw_over_depth",
                                    "time",
                                    "excess_pressure_min",
                                    "excess_pressure_max",
                                    "pressure_ratio_max",
                                    "expelled",
                                    "vapour",
                                    "surface_x50",
                                    "surface_slope_max",
                                    "settlement",
                                    "tilt"};
  using Row = std::array<double, names.size()>;

  Row row_of(Problem const& problem, double load) const {
    auto const& grid = problem.discretisation();
    auto const& water = problem.attached<Water>();
    auto const pressures = water.pressures();
    auto const [least, most] = std::ranges::minmax(pressures);
    double ratio = 0.0;
    for (std::size_t node = 0; node < pressures.size(); ++node) {
      double const carried = scene_.overburden(scene_.ground.surface_level() - grid.nodes()[node].y());
      if (carried > 0.0) ratio = std::max(ratio, pressures[node] / carried);
    }
    auto const offset = scarp::offset_at(scene_.fault, std::min(load, scene_.stages.throw_to));
    auto const survey = scarp::rupture_survey(grid.mesh(), rest_.of(grid.nodes()), grid.positions(), offset);
    double settlement = std::numeric_limits<double>::quiet_NaN();
    double tilt = settlement;
    if (scene_.footing) {
      auto const motion = scene_.footing->motion(problem, load);
      settlement = motion.settlement;
      tilt = motion.tilt;
    }
    return {std::min(load, scene_.stages.throw_to) / unit_,
            water.time(),
            least,
            most,
            ratio,
            water.expelled() - expelled_,
            water.vapour(),
            survey.surface.surface_x50,
            survey.surface.surface_slope_max,
            settlement,
            tilt};
  }

  Scene const& scene_;
  double unit_;
  scarp::CsvLog table_;
  scarp::GroundAtRest<2> rest_;
  std::vector<Row> rows_;
  double expelled_ = 0.0;  ///< until the fault begins to move [m3]
};
#endif

}  // namespace fault_rupture
