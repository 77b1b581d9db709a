// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "specimen.hpp"

namespace triaxial_column {

/// The path of a homogeneous column between smooth platens, for one packing: the axial plane stays horizontal, the sides
/// carry the dead load of the confining pressure and no shear, the turn about the axis is held.
/// \f$ F = \begin{pmatrix} a & b & c \\ 0 & d & e \\ 0 & 0 & f \end{pmatrix} \f$
inline scarp::Loading<3> column_path(double rate, double pressure, scarp::Tensor<3> const& deformation) {
  scarp::Loading<3> loading;
  loading.gradient_per_step(2, 2) = -rate;
  auto const hold = [&](int row, int column, double target) {
    scarp::Tensor<3> direction = scarp::Tensor<3>::Zero();
    direction(row, column) = 1.0;
    loading.controls.push_back({direction, target});
  };
  hold(0, 0, -pressure / (deformation(1, 1) * deformation(2, 2)));  // over the area that the side has now
  hold(1, 1, -pressure / (deformation(0, 0) * deformation(2, 2)));
  for (auto const& [row, column] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) hold(row, column, 0.0);
  return loading;
}

/// One packing, a servo at its cell. Rows are means over some steps.
inline std::vector<Row> rve_test(Packing packing, Choice const& choice) {
  constexpr double rate = 1e-6;  // axial strain of one DEM step
  constexpr long steps_per_row = 100;
  auto const law = contact_law();
  scarp::TimeStepper<Packing, decltype(Sand::damping)> stepper;
  scarp::Tensor<3> deformation = scarp::Tensor<3>::Identity();
  scarp::CellDriver<Packing> drive(packing, law, column_path(rate, choice.pressure, deformation));
  std::vector<Row> rows{{0.0, choice.pressure, 0.0, 0.0}};
  Row sum;
  for (long step = 1; - std::log(deformation(2, 2)) < -std::log(1.0 - choice.strain) + rate * steps_per_row; ++step) {
    if (!drive.step(stepper).acceptable()) break;
    deformation += drive.strain_step() * deformation;
    sum.axial_strain -= std::log(deformation(2, 2)) / steps_per_row;
    sum.axial_stress -= drive.seen().stress(2, 2) / steps_per_row;
    sum.volumetric_strain -= std::log(deformation.determinant()) / steps_per_row;
    if (step % steps_per_row != 0) continue;
    rows.push_back(std::exchange(sum, {}));
    drive.load(column_path(rate, choice.pressure, deformation));
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
