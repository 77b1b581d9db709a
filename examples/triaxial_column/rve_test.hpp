// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>

#include "scarp/points/laboratory_paths.hpp"
#include "specimen.hpp"

namespace triaxial_column {

/// One packing on the path of a homogeneous column between smooth platens: the axial plane stays horizontal, the sides
/// carry the dead load of the confining pressure, over the area that they have now, and no shear; the turn about the
/// axis is held.
inline std::vector<Row> rve_test(Packing const& packing, Choice const& choice) {
  constexpr double increment = 1e-4;  // of the axial strain
  Sand const sand{.law = contact_law(), .source = {packing}, .strain_per_step = 1e-6};
  scarp::MaterialPoints<3> point(sand, std::array{scarp::Site<3>{}});
  scarp::PointPath<3> path(point, scarp::drained_path<3>(), {.tolerance = 1e-4});
  scarp::SerialExecutor serial;
  std::vector<Row> rows{{0.0, choice.pressure, 0.0, 0.0}};
  while (rows.back().axial_strain < -std::log1p(-choice.strain)) {
    auto const& moved = path.deformation(0);
    scarp::PathConditions<3> conditions;
    for (int k = 0; k < scarp::voigt_size<3>; ++k)
      conditions.push_back({.of_stress = scarp::VoigtStress<3>::Unit(k), .target = 0.0});
    conditions[0].target = -choice.pressure / (moved(1, 1) * moved(2, 2));
    conditions[1].target = -choice.pressure / (moved(0, 0) * moved(2, 2));
    conditions[2] = {.of_strain = scarp::EngineeringStrain<3>::Unit(2), .target = path.strain(0)(2) - increment};
    path.load(conditions);
    if (!path.advance(1.0, serial).verdict.acceptable()) break;
    rows.push_back({-path.strain(0)(2), -path.stress(0)(2), -path.strain(0).head<3>().sum(), 0.0});
  }
  return rows;
}

/// Linear between the rows.
inline Row at_strain(std::vector<Row> const& rows, double strain) {
  std::size_t k = 1;
  while (k + 1 < rows.size() && rows[k].axial_strain < strain) ++k;
  Row const& left = rows[k - 1];
  Row const& right = rows[k];
  double const share = (strain - left.axial_strain) / (right.axial_strain - left.axial_strain);
  return {strain, left.axial_stress + share * (right.axial_stress - left.axial_stress),
          left.volumetric_strain + share * (right.volumetric_strain - left.volumetric_strain), 0.0};
}

}  // namespace triaxial_column
