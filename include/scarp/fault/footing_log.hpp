// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/bvp/loads.hpp"
#include "scarp/core/described.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/observers.hpp"

namespace scarp {

/// A strip footing on the ground surface and what it weighs.
struct StripFooting {
  double centre = -10.5;  ///< x [m]
  double width = 10.0;    ///< [m]
  double bearing = 91e3;  ///< mean pressure on the base [Pa]

  /// \throws InputError
  void validate() const {
    require_finite("centre of the footing", centre);
    require_positive("width of the footing", width);
    require_not_negative("mean pressure below the footing", bearing);
  }

  /// \throws InputError as validate() does
  std::vector<double> edges() const {
    validate();
    return {centre - width / 2.0, centre + width / 2.0};
  }
};

/// How a footing has moved from where the mesh has it, and what the ground presses with against its base.
struct FootingMotion {
  double settlement = 0.0;           ///< of the centre of the base, positive down [m]
  double horizontal = 0.0;           ///< along x [m]
  double tilt = 0.0;                 ///< [rad], clockwise: towards the hanging wall
  std::vector<InterfacePoint> base;  ///< points of the base with what the ground presses against them
};

/// Vertical force of the ground on the base [N], positive upwards.
inline double support(FootingMotion const& motion) {
  double sum = 0.0;
  for (auto const& point : motion.base) sum += point.stress.y() * point.area;
  return sum;
}

/// Removes the surcharge from the ground below a footing while the footing is placed.
template <class Grid>
void add_uncovered_surcharge(Grid const& grid, double surcharge, double start, LoadHistory& loads) {
  Eigen::VectorXd covered = Eigen::VectorXd::Zero(loads.size());
  covered.head(grid.dof_count()) = traction(grid, "footing_base", Vector<2>(0.0, -surcharge));
  loads.add(std::move(covered), TimeFunction({{start, 1.0}, {0.0, 0.0}}));
}

/// Extremes of the pressure on a footing's base and the share of it that is pressed.
struct BasePressure {
  double least = std::numeric_limits<double>::infinity();     ///< [Pa]
  double largest = -std::numeric_limits<double>::infinity();  ///< [Pa]
  double pressed = 0.0;                                       ///< area with pressure over the whole area
};

/// Extremes of the pressure [Pa] over the points of the base, and the pressed share of its area.
inline BasePressure base_pressure(FootingMotion const& motion) {
  BasePressure found;
  double area = 0.0;
  for (auto const& point : motion.base) {
    found.least = std::min(found.least, point.pressure);
    found.largest = std::max(found.largest, point.pressure);
    area += point.area;
    if (point.pressure > 0.0) found.pressed += point.area;
  }
  found.pressed /= area;
  return found;
}

/// How a scene's footing moves, a row for each accepted step, and the pressures on its base at every so many of them.
/// \tparam Structure a `StandsOnGround` whose motion(problem, load) is a `FootingMotion`
template <class Structure>
class FootingLog : public NeverStops {
 public:
  /// profiles: of the base, at load factors that are to / profiles apart, from 0
  FootingLog(std::filesystem::path const& folder, Structure structure, double to, int profiles, double load_unit,
             CsvStart start = CsvStart::anew)
      : motion_(folder / "footing.csv",
                {"load", "throw_over_depth", "settlement", "horizontal_displacement", "tilt", "vertical_reaction",
                 "pressure_min", "pressure_max", "contact_share",
                 // as before version 0.2, until version 0.3
                 "sideways", "support", "pressed_share"},
                start),
        base_(folder / "footing_base.csv", {"throw_over_depth", "x", "y", "area", "pressure", "shear", "gap"}, start),
        structure_(std::move(structure)),
        schedule_(detail::validated(LoadSchedule{to, profiles, load_unit})) {}

  /// Writes a row for an accepted state, and the base's pressures where a profile is due.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    FootingMotion const motion = structure_.motion(problem, report.load);
    auto const pressure = base_pressure(motion);
    motion_.add(report.load, throw_at(report.load), motion.settlement, motion.horizontal, motion.tilt, support(motion),
                pressure.least, pressure.largest, pressure.pressed, motion.horizontal, support(motion),
                pressure.pressed);
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

  void write_base(FootingMotion const& motion, double load) {
    for (auto const& point : motion.base)
      base_.add(throw_at(load), point.place.x(), point.place.y(), point.area, point.pressure, point.shear, point.gap);
  }

  CsvLog motion_;
  CsvLog base_;
  Structure structure_;
  LoadSchedule schedule_;
};

}  // namespace scarp
