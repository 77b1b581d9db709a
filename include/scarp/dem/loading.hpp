// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Holds a stress by straining the cell along a direction: \f$ \sigma : D / (D : D) = \f$ target. One component with
/// the unit tensor of that component as D, the mean stress with the identity.
template <int Dim>
struct StressControl {
  Tensor<Dim> direction = Tensor<Dim>::Zero();  ///< D, symmetric
  double target = 0.0;                          ///< [Pa], tension positive

  /// Whether a strain is negative in some direction: a principal minor is.
  static bool shortens_some(Tensor<Dim> const& strain) {
    double const size = strain.norm();
    double const slight = -1e-12 * size * size;
    auto const minor = [&](int a, int b) { return strain(a, a) * strain(b, b) - strain(a, b) * strain(b, a); };
    bool some = false;
    for (int a = 0; a < Dim; ++a) {
      some = some || strain(a, a) * size < slight;
      for (int b = 0; b < a; ++b) some = some || minor(a, b) < slight;
    }
    if constexpr (Dim == 3) {
      double const determinant = strain(0, 0) * minor(1, 2) -
                                 strain(0, 1) * (strain(1, 0) * strain(2, 2) - strain(1, 2) * strain(2, 0)) +
                                 strain(0, 2) * (strain(1, 0) * strain(2, 1) - strain(1, 1) * strain(2, 0));
      some = some || determinant < slight * size;
    }
    return some;
  }

  /// Target minus the held component of a stress [Pa].
  double missing(Tensor<Dim> const& stress) const {
    return target - stress.cwiseProduct(direction).sum() / direction.squaredNorm();
  }
  /// Grains that do not pull at each other carry pressure only: no stress whose component along D is zero or above
  /// where D extends every direction, or zero or below where it shortens every one.
  bool reachable(bool pulls) const {
    if (!std::isfinite(target)) return false;
    return pulls || ((target < 0.0 || shortens_some(direction)) && (target > 0.0 || shortens_some(-direction)));
  }
};

/// Control of one stress component in Voigt order, target [Pa].
template <int Dim>
StressControl<Dim> component_control(int component, double target) {
  VoigtStress<Dim> unit = VoigtStress<Dim>::Zero();
  unit(component) = 1.0;
  return {from_voigt_stress<Dim>(unit), target};
}

/// What a cell does in every step: a displacement gradient that is prescribed, and stresses that are held by further
/// strains along directions that are orthogonal to each other. Held components of the prescribed gradient are to be
/// zero.
template <int Dim>
struct Loading {
  Tensor<Dim> gradient_per_step = Tensor<Dim>::Zero();  ///< prescribed
  std::vector<StressControl<Dim>> controls;             ///< stresses that are held

  /// All stress components held.
  static Loading stress(VoigtStress<Dim> const& target) {
    Loading loading;
    for (int k = 0; k < voigt_size<Dim>; ++k) loading.controls.push_back(component_control<Dim>(k, target(k)));
    return loading;
  }

  /// \throws InputError for directions that hold nothing, the same twice or a rotation, and for a prescribed strain
  /// that is no number or strains along one of them
  void validate() const {
    if (!gradient_per_step.allFinite())
      reject("the prescribed displacement gradient of a step has components that are no numbers: give ordinary ones");
    for (std::size_t k = 0; k < controls.size(); ++k) {
      auto const& direction = controls[k].direction;
      require_positive("size of the direction of a held stress", direction.norm());
      constexpr double slight = 1e-12;
      if (!((direction - direction.transpose()).norm() <= slight * direction.norm()))
        reject("held stress {} has a direction that is not symmetric (a stress has no such component): give one", k);
      for (std::size_t other = 0; other < k; ++other) {
        double const common = controls[other].direction.cwiseProduct(direction).sum();
        if (std::abs(common) > 1e-12 * controls[other].direction.norm() * direction.norm()) {
          reject(
              "held stresses {} and {} have directions in common (one would strain the cell against the other): hold "
              "orthogonal ones",
              other, k);
        }
      }
      double const along = gradient_per_step.cwiseProduct(direction).sum();
      constexpr double large = 1e-3;  // more than large increments of a path that keeps the component add to it
      if (std::abs(along) > large * gradient_per_step.norm() * direction.norm())
        reject(
            "the prescribed displacement gradient of a step strains along the direction of held stress {} (by {}; a "
            "component is prescribed or held): take that part out",
            k, along / direction.squaredNorm());
    }
  }

  /// The prescribed gradient with its sign changed; held stresses keep theirs.
  Loading reversed() const {
    Loading other = *this;
    other.gradient_per_step = -gradient_per_step;
    return other;
  }

  /// Whether grains, which may pull at each other or not, may carry the prescribed stress.
  bool reachable(bool pulls) const {
    for (auto const& control : controls) {
      if (!control.reachable(pulls)) return false;
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

/// One-dimensional (oedometric, K0) compression along the last axis. rate: axial strain per step, positive shortens
template <int Dim>
Loading<Dim> oedometer(double rate) {
  Loading<Dim> loading;
  loading.gradient_per_step(Dim - 1, Dim - 1) = -rate;
  return loading;
}

/// Compression along the last axis at constant lateral stress: biaxial in the plane, triaxial in space. rate: strain
/// per step; lateral_pressure [Pa], positive in compression
template <int Dim>
Loading<Dim> drained_compression(double rate, double lateral_pressure) {
  Loading<Dim> loading = oedometer<Dim>(rate);
  for (int k = 0; k < Dim - 1; ++k) loading.controls.push_back(component_control<Dim>(k, -lateral_pressure));
  return loading;
}

}  // namespace scarp
