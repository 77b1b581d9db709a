// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/points/point_path.hpp"

namespace scarp {

/// \file
/// The tests of the laboratory as conditions of a `PointPath`. The length of a path is the compression of the last, the
/// axial, axis, the volumetric compression of isotropic paths and the angle of simple shear; a negative length is
/// extension or shear to the other side. Stresses that are held stay what they are where the path begins. In the plane
/// biaxial tests in plane strain, in space triaxial ones.

namespace detail {

template <int Dim>
VoigtStress<Dim> trace() {
  VoigtStress<Dim> weights = VoigtStress<Dim>::Zero();
  weights.template head<Dim>().setOnes();
  return weights;
}

/// Conditions on the normal components, completed by shear strains of zero, the one in the plane of simple shear at a
/// rate.
template <int Dim>
PathConditions<Dim> without_shear(PathConditions<Dim> conditions, double rate = 0.0) {
  constexpr int sheared = Dim == 2 ? 2 : 4;  // xy, zx
  for (int k = Dim; k < voigt_size<Dim>; ++k)
    conditions.push_back({.of_strain = VoigtStress<Dim>::Unit(k), .rate = k == sheared ? rate : 0.0});
  return conditions;
}

/// The axial axis shortens at the rate 1 under one more condition; in space the difference of the lateral stresses
/// stays.
template <int Dim>
PathConditions<Dim> axial(PathCondition<Dim> lateral) {
  PathConditions<Dim> conditions{{.of_strain = VoigtStress<Dim>::Unit(Dim - 1), .rate = -1.0}, std::move(lateral)};
  if constexpr (Dim == 3) conditions.push_back({.of_stress = VoigtStress<3>::Unit(0) - VoigtStress<3>::Unit(1)});
  return without_shear<Dim>(std::move(conditions));
}

}  // namespace detail

/// The volume shrinks while the differences of the normal stresses stay.
template <int Dim>
PathConditions<Dim> isotropic_path() {
  PathConditions<Dim> conditions{{.of_strain = detail::trace<Dim>(), .rate = -1.0}};
  for (int k = 0; k < Dim - 1; ++k)
    conditions.push_back({.of_stress = VoigtStress<Dim>::Unit(k) - VoigtStress<Dim>::Unit(Dim - 1)});
  return detail::without_shear<Dim>(std::move(conditions));
}

/// Lateral strains are `ratio` times the axial one: an oedometer for 0.
template <int Dim>
PathConditions<Dim> proportional_strain_path(double ratio) {
  require_finite("ratio of the lateral to the axial strain", ratio);
  PathConditions<Dim> conditions;
  for (int k = 0; k < Dim; ++k)
    conditions.push_back({.of_strain = VoigtStress<Dim>::Unit(k), .rate = k == Dim - 1 ? -1.0 : -ratio});
  return detail::without_shear<Dim>(std::move(conditions));
}

/// Axial compression without lateral strain.
template <int Dim>
PathConditions<Dim> oedometer_path() {
  return proportional_strain_path<Dim>(0.0);
}

/// Lateral stresses change by `ratio` times the change of the axial one: drained for 0.
template <int Dim>
PathConditions<Dim> proportional_stress_path(double ratio) {
  require_finite("ratio of lateral to axial changes of stress", ratio);
  return detail::axial<Dim>({.of_stress = VoigtStress<Dim>::Unit(0) - ratio * VoigtStress<Dim>::Unit(Dim - 1)});
}

/// Drained biaxial or triaxial test: lateral stresses held.
template <int Dim>
PathConditions<Dim> drained_path() {
  return proportional_stress_path<Dim>(0.0);
}

/// Undrained test: constant volume; in space the difference of the lateral stresses held.
template <int Dim>
PathConditions<Dim> undrained_path() {
  return detail::axial<Dim>({.of_strain = detail::trace<Dim>()});
}

/// Mean stress held, in the plane that of the stresses in it; in space also the difference of the lateral stresses.
template <int Dim>
PathConditions<Dim> constant_mean_stress_path() {
  return detail::axial<Dim>({.of_stress = detail::trace<Dim>()});
}

/// Direct simple shear at constant height, hence volume: the first axis' displacement grows along the last one.
template <int Dim>
PathConditions<Dim> simple_shear_path() {
  PathConditions<Dim> conditions;
  for (int k = 0; k < Dim; ++k) conditions.push_back({.of_strain = VoigtStress<Dim>::Unit(k)});
  return detail::without_shear<Dim>(std::move(conditions), 1.0);
}

/// Direct simple shear with the axial stress held.
template <int Dim>
PathConditions<Dim> simple_shear_at_stress_path() {
  auto conditions = simple_shear_path<Dim>();
  conditions[Dim - 1] = {.of_stress = VoigtStress<Dim>::Unit(Dim - 1)};
  return conditions;
}

}  // namespace scarp
