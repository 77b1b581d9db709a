// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "choice.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/solver/quasi_newton.hpp"
#include "to_device.hpp"

namespace fault_rupture {

/// Writes one of the soil's packings into a folder.
using PackingWriter = std::function<void(std::filesystem::path const&)>;

/// A soil of the reference study and how its scenes are solved.
struct AnySoil {
  scarp::AnyProvider<2> provider;
  scarp::QuasiNewton<> solver;
  double tolerance = 0.0;                  ///< of the force residual
  double max_displacement_gradient = 0.0;  ///< of a load step
  double pressure_floor = 0.0;             ///< [Pa], below which a point's balance counts less
  PackingWriter write_packing{};           ///< nothing for soils without packings
  double shear_modulus = 0.0;              ///< of a soil without packings, about that of one with [Pa]
};

/// sites: of all points that will be soil
/// \throws scarp::PreparationError
AnySoil any_soil(Choice const& choice, std::vector<scarp::Site<2>> const& sites, ToDevice const& to_device = {});

}  // namespace fault_rupture
