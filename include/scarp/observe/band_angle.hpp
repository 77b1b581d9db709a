// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "scarp/core/tensor.hpp"

namespace scarp {

struct StrainedPlace {
  Vector<2> place = Vector<2>::Zero();  ///< [m]
  double strain = 0.0;                  ///< deviatoric
  double volume = 0.0;                  ///< [m3]
};

/// Inclination of a shear band [rad], anticlockwise from x, from 0 up to pi: that of the long axis of inertia of all places, each
/// weighted by its volume and the square of its strain, so that strains of the far field count little. NaN where nothing is
/// strained, or as much along every axis.
inline double band_angle(std::vector<StrainedPlace> const& places) {
  constexpr double round_off = 1e-12;
  double mass = 0.0;
  Vector<2> centre = Vector<2>::Zero();
  for (auto const& [place, strain, volume] : places) {
    mass += strain * strain * volume;
    centre += strain * strain * volume * place;
  }
  if (!(mass > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  centre /= mass;
  Tensor<2> spread = Tensor<2>::Zero();
  for (auto const& [place, strain, volume] : places)
    spread += strain * strain * volume / mass * (place - centre) * (place - centre).transpose();
  Eigen::SelfAdjointEigenSolver<Tensor<2>> solver;
  solver.computeDirect(spread);
  auto const& spreads = solver.eigenvalues();
  if (!(spreads(1) - spreads(0) > round_off * spreads(1))) return std::numeric_limits<double>::quiet_NaN();
  Vector<2> const axis = solver.eigenvectors().col(1);
  double const angle = std::atan2(axis(1), axis(0));
  return angle < 0.0 ? angle + std::numbers::pi : angle == std::numbers::pi ? 0.0 : angle;
}

}  // namespace scarp
