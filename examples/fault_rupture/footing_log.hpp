// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "scarp/core/described.hpp"
#include "scarp/fault/strip_footing.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/observers.hpp"

namespace fault_rupture {

/// Extremes of the pressure on a footing's base and the share of it that is pressed.
struct BasePressure {
  double least = std::numeric_limits<double>::infinity();     ///< [Pa]
  double largest = -std::numeric_limits<double>::infinity();  ///< [Pa]
  double pressed = 0.0;                                       ///< area with pressure over the whole area
};

/// Extremes of the pressure [Pa] over the points of the base, and the pressed share of its area.
inline BasePressure base_pressure(scarp::FootingMotion const& motion) {
  BasePressure found;
  double area = 0.0;
  for (auto const& point : motion.base) {
    found.least = std::min(found.least, point.pressure);
    found.largest = std::max(found.largest, point.pressure);
    area += point.area;
    if (point.pressure > 0.0) found.pressed += point.area;
  }
  if (area > 0.0) found.pressed /= area;
  return found;
}

/// How a scene's footing moves, a row for each accepted step, and the pressures on its base at every so many of them.
/// \tparam Structure a `StandsOnGround` whose motion(problem, load) is a `FootingMotion`
template <class Structure>
class FootingLog : public scarp::NeverStops {
 public:
  /// profiles: of the base, at load factors that are to / profiles apart, from 0
  FootingLog(std::filesystem::path const& folder, Structure structure, double to, int profiles, double load_unit,
             scarp::CsvStart start = scarp::CsvStart::anew)
      : motion_(folder / "footing.csv",
                {"load", "throw_over_depth", "settlement", "horizontal_displacement", "tilt", "vertical_reaction",
                 "pressure_min", "pressure_max", "contact_share",
                 // as before version 0.2, until version 0.3
                 "sideways", "support", "pressed_share"},
                start),
        base_(folder / "footing_base.csv", {"throw_over_depth", "x", "y", "area", "pressure", "shear", "gap"}, start),
        structure_(std::move(structure)),
        schedule_(scarp::detail::validated(scarp::LoadSchedule{to, profiles, load_unit})) {}

  /// Writes a row for an accepted state, and the base's pressures where a profile is due.
  template <class Problem>
  void attempted(Problem const& problem, scarp::StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    scarp::FootingMotion const motion = structure_.motion(problem, report.load);
    auto const pressure = base_pressure(motion);
    motion_.add(report.load, throw_at(report.load), motion.settlement, motion.horizontal, motion.tilt,
                scarp::support(motion), pressure.least, pressure.largest, pressure.pressed, motion.horizontal,
                scarp::support(motion), pressure.pressed);
    if (schedule_.takes(report.load)) write_base(motion, report.load);
  }

  /// Writes the pressures of a run that stopped between two profiles.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    if (schedule_.takes_end(load)) write_base(structure_.motion(problem, load), load);
  }

  SCARP_MEMBERS_EXCEPT((structure_), motion_, base_, schedule_)

 private:
  double throw_at(double load) const { return std::max(load, 0.0) / schedule_.unit; }

  void write_base(scarp::FootingMotion const& motion, double load) {
    for (auto const& point : motion.base)
      base_.add(throw_at(load), point.place.x(), point.place.y(), point.area, point.pressure, point.shear, point.gap);
  }

  scarp::CsvLog motion_;
  scarp::CsvLog base_;
  Structure structure_;
  scarp::LoadSchedule schedule_;
};

}  // namespace fault_rupture
