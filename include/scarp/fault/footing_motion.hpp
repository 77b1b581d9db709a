// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <vector>

#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/bvp/loads.hpp"

namespace scarp {

/// A strip footing on the ground surface and what it weighs.
struct StripFooting {
  double centre = -10.5;  ///< x [m]
  double width = 10.0;    ///< [m]
  double bearing = 91e3;  ///< mean pressure on the base [Pa]

  std::vector<double> edges() const { return {centre - width / 2.0, centre + width / 2.0}; }
};

/// How a footing has moved from where the mesh has it, and what the ground presses with against its base.
struct FootingMotion {
  double settlement = 0.0;  ///< of the centre of the base, positive down [m]
  double sideways = 0.0;    ///< along x [m]
  double tilt = 0.0;        ///< [rad], clockwise: towards the hanging wall
  std::vector<InterfacePoint> base;
};

/// Vertical force of the ground on the base [N], positive upwards.
inline double support(FootingMotion const& motion) {
  double sum = 0.0;
  for (auto const& point : motion.base) sum += point.stress.y() * point.area;
  return sum;
}

/// Takes the surcharge from the ground below a footing while the footing is placed.
template <class Grid>
void add_uncovered_surcharge(Grid const& grid, double surcharge, double start, LoadHistory& loads) {
  Eigen::VectorXd covered = Eigen::VectorXd::Zero(loads.size());
  covered.head(grid.dof_count()) = traction(grid, "footing_base", Vector<2>(0.0, -surcharge));
  loads.add(std::move(covered), TimeFunction({{start, 1.0}, {0.0, 0.0}}));
}

}  // namespace scarp
