// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "choice.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/solver/quasi_newton.hpp"

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
};

struct Sand;
/// Puts the packings of a sand on a device.
using SandOnDevice = scarp::AnyProvider<2>(Choice const& choice, Sand const& sand);

/// sites: of all points that will be soil; on_device: called for a sand where the choice has a device
/// \throws scarp::PreparationError
AnySoil any_soil(Choice const& choice, std::vector<scarp::Site<2>> const& sites, SandOnDevice* on_device = nullptr);

}  // namespace fault_rupture
