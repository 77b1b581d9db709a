// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <utility>
#include <vector>

#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/core/error.hpp"

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
  covered.head(grid.dof_count()) = grid.traction("footing_base", Vector<2>(0.0, -surcharge));
  loads.add(std::move(covered), TimeFunction({{start, 1.0}, {0.0, 0.0}}));
}

}  // namespace scarp
