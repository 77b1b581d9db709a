// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/loading.hpp"

namespace scarp {

/// The tests of the laboratory as loadings. `rate` is the strain of one DEM step, positive; the last axis is the axial one;
/// pressures [Pa] are positive in compression. Shear stresses are not held: their strains are zero.

template <int Dim>
Loading<Dim> isotropic_compression(double rate) {
  return {-rate * Tensor<Dim>::Identity(), {}};
}

/// One-dimensional (oedometric, K0) compression.
template <int Dim>
Loading<Dim> oedometer(double rate) {
  Loading<Dim> loading;
  loading.gradient_per_step(Dim - 1, Dim - 1) = -rate;
  return loading;
}

/// Axial compression at constant lateral stress: biaxial in the plane, triaxial in space.
template <int Dim>
Loading<Dim> drained_compression(double rate, double lateral_pressure) {
  Loading<Dim> loading = oedometer<Dim>(rate);
  for (int k = 0; k < Dim - 1; ++k) loading.controls.push_back(component_control<Dim>(k, -lateral_pressure));
  return loading;
}

/// Axial compression at constant volume.
template <int Dim>
Loading<Dim> undrained_compression(double rate) {
  Loading<Dim> loading = oedometer<Dim>(rate);
  for (int k = 0; k < Dim - 1; ++k) loading.gradient_per_step(k, k) = rate / (Dim - 1);
  return loading;
}

/// The first axis lengthens and the second shortens alike; in the plane this is undrained compression.
template <int Dim>
Loading<Dim> pure_shear(double rate) {
  Loading<Dim> loading;
  loading.gradient_per_step(0, 0) = rate;
  loading.gradient_per_step(1, 1) = -rate;
  return loading;
}

/// The first axis' displacement grows along the last one; constant volume.
template <int Dim>
Loading<Dim> simple_shear(double rate) {
  Loading<Dim> loading;
  loading.gradient_per_step(0, Dim - 1) = rate;
  return loading;
}

/// Simple shear while the stress along the last axis is held.
template <int Dim>
Loading<Dim> simple_shear_at_stress(double rate, double axial_pressure) {
  Loading<Dim> loading = simple_shear<Dim>(rate);
  loading.controls.push_back(component_control<Dim>(Dim - 1, -axial_pressure));
  return loading;
}

/// Axial compression at constant mean stress: the deviator of the strain is prescribed, the volume follows.
template <int Dim>
Loading<Dim> constant_mean_stress(double rate, double pressure) {
  Loading<Dim> loading = undrained_compression<Dim>(rate);
  loading.controls.push_back(mean_stress_control<Dim>(pressure));
  return loading;
}

/// Turns a loading round whenever the strain that it prescribes has grown to an amplitude.
struct Cyclic {
  double amplitude = 0.0;

  /// \return the sign, 1 or -1, of the next step, given the strain so far and the present sign
  int next_sign(double strain, int sign) const {
    if (strain >= amplitude) return -1;
    if (strain <= -amplitude) return 1;
    return sign;
  }
};

}  // namespace scarp
