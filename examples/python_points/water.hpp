// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/solver/model.hpp"

namespace python_points {

/// A pressure [Pa] or an inflow [m/s] of a boundary, times an amplitude over the load factor.
struct WaterBoundary {
  std::string side{};
  double value = 0.0;
  scarp::TimeFunction amplitude{};
};

/// Pore water in numbers, see PoreWater.
struct WaterOptions {
  double shear_modulus = 0.0;     ///< of the ground [Pa]
  double conductivity = 0.0;      ///< [m/s], of water that has no grain
  double grain = 0.0;             ///< diameter [m] of Kozeny and Carman's permeability; 0: the conductivity counts
  double void_ratio = 0.7;        ///< at the start
  double bulk_modulus = 2.2e9;    ///< of the water [Pa]
  std::optional<double> table{};  ///< height of the water table [m], for water that cavitates
  std::optional<double> largest_time_error{};  ///< of one step, estimated [Pa]
  scarp::TimeFunction clock{};                 ///< [s] over the load factor
  std::vector<std::string> drained{};
  std::vector<WaterBoundary> pressures{};
  std::vector<WaterBoundary> inflows{};
};

/// Attaches water to the elements of a model. Compiled in a source of its own. \throws InputError
template <int Dim>
void attach_water(scarp::Model<Dim>& model, WaterOptions const& options);

}  // namespace python_points
