// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/loading.hpp"

namespace examples {

/// \file
/// Tests of the laboratory as loadings of a packing. Their last axis is the axial one; shear stresses are not held,
/// their strains are zero.

/// Equal shortening along all axes. rate: strain of each axis per step
template <int Dim>
scarp::Loading<Dim> isotropic_compression(double rate) {
  return {-rate * scarp::Tensor<Dim>::Identity(), {}};
}

/// Axial compression at constant volume. rate: strain per step
template <int Dim>
scarp::Loading<Dim> undrained_compression(double rate) {
  scarp::Loading<Dim> loading = scarp::oedometer<Dim>(rate);
  for (int k = 0; k < Dim - 1; ++k) loading.gradient_per_step(k, k) = rate / (Dim - 1);
  return loading;
}

/// The first axis lengthens and the second shortens alike; in the plane this is undrained compression.
/// rate: strain of each per step
template <int Dim>
scarp::Loading<Dim> pure_shear(double rate) {
  scarp::Loading<Dim> loading;
  loading.gradient_per_step(0, 0) = rate;
  loading.gradient_per_step(1, 1) = -rate;
  return loading;
}

/// The first axis' displacement grows along the last one; constant volume. rate: shear strain per step
template <int Dim>
scarp::Loading<Dim> simple_shear(double rate) {
  scarp::Loading<Dim> loading;
  loading.gradient_per_step(0, Dim - 1) = rate;
  return loading;
}

/// Simple shear while the stress along the last axis is held. rate: shear strain per step; axial_pressure [Pa],
/// positive in compression
template <int Dim>
scarp::Loading<Dim> simple_shear_at_stress(double rate, double axial_pressure) {
  scarp::Loading<Dim> loading = simple_shear<Dim>(rate);
  loading.controls.push_back(scarp::component_control<Dim>(Dim - 1, -axial_pressure));
  return loading;
}

/// Axial compression at constant mean stress: the deviator of the strain is prescribed, the volume follows.
/// rate: axial strain per step, positive shortens; pressure [Pa], positive in compression
template <int Dim>
scarp::Loading<Dim> constant_mean_stress(double rate, double pressure) {
  scarp::Loading<Dim> loading = undrained_compression<Dim>(rate);
  loading.controls.push_back({scarp::Tensor<Dim>::Identity(), -pressure});
  return loading;
}

/// Turns a loading round whenever the strain that it prescribes has grown to an amplitude.
struct Cyclic {
  double amplitude = 0.0;  ///< of the strain, positive

  /// Direction of a cycle's next step.
  /// \return the sign, 1 or -1, of the next step, given the strain so far and the present sign
  /// \throws scarp::InputError for an amplitude that is not finite and positive
  int next_sign(double strain, int sign) const {
    scarp::require_positive("strain amplitude of a cyclic loading", amplitude);
    if (strain >= amplitude) return -1;
    if (strain <= -amplitude) return 1;
    return sign;
  }
};

}  // namespace examples
