// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/core/voigt.hpp"

namespace scarp {

/// Holds a stress by straining the cell along a direction: \f$ \sigma : D / (D : D) = \f$ target. One component with the unit
/// tensor of that component as D, the mean stress with the identity.
template <int Dim>
struct StressControl {
  Tensor<Dim> direction = Tensor<Dim>::Zero();
  double target = 0.0;  ///< [Pa], tension positive

  double missing(Tensor<Dim> const& stress) const {
    return target - stress.cwiseProduct(direction).sum() / direction.squaredNorm();
  }
  /// Grains without bonds carry pressure only.
  bool reachable(bool bonded) const {
    return std::isfinite(target) && (bonded || direction.trace() == 0.0 || target < 0.0);
  }
};

/// Control of one stress component in Voigt order, target [Pa].
template <int Dim>
StressControl<Dim> component_control(int component, double target) {
  VoigtStress<Dim> unit = VoigtStress<Dim>::Zero();
  unit(component) = 1.0;
  return {from_voigt_stress<Dim>(unit), target};
}

/// Control of the mean stress: -pressure [Pa].
template <int Dim>
StressControl<Dim> mean_stress_control(double pressure) {
  return {Tensor<Dim>::Identity(), -pressure};
}

/// What a cell does in every step: a displacement gradient that is prescribed, and stresses that are held by further strains
/// along directions that are orthogonal to each other. Held components of the prescribed gradient are to be zero.
template <int Dim>
struct Loading {
  Tensor<Dim> gradient_per_step = Tensor<Dim>::Zero();
  std::vector<StressControl<Dim>> controls;

  /// All stress components held.
  static Loading stress(VoigtStress<Dim> const& target) {
    Loading loading;
    for (int k = 0; k < voigt_size<Dim>; ++k) loading.controls.push_back(component_control<Dim>(k, target(k)));
    return loading;
  }

  Loading reversed() const {
    Loading other = *this;
    other.gradient_per_step = -gradient_per_step;
    return other;
  }

  /// Whether grains, bonded to each other or not, may carry what is asked.
  bool reachable(bool bonded) const {
    for (auto const& control : controls) {
      if (!control.reachable(bonded)) return false;
    }
    return true;
  }

  /// Largest target in size [Pa], the scale of what is missing.
  double stress_scale() const {
    double scale = 0.0;
    for (auto const& control : controls) scale = std::max(scale, std::abs(control.target));
    return scale;
  }

  /// Largest missing stress in size [Pa].
  double worst_missing(Tensor<Dim> const& stress) const {
    double worst = 0.0;
    for (auto const& control : controls) worst = std::max(worst, std::abs(control.missing(stress)));
    return worst;
  }
};

}  // namespace scarp
