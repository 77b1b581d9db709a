// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/rotated_increment.hpp"
#include "scarp/core/voigt.hpp"

namespace scarp {

/// What a tangent can learn from two answers of one point: a strain and the change of stress that it made.
template <int Dim>
struct AnswerChange {
  EngineeringStrain<Dim> strain;
  VoigtStress<Dim> stress;  ///< [Pa]
};

/// From the answer to one gradient to that to another, both from the same start, in the axes of the former: the rotation
/// between them turns the stress that was there and is no stiffness. Nothing, where no rotation leads from one to the other.
template <int Dim>
AnswerChange<Dim> unturned_change(Gradient<Dim> const& from, Gradient<Dim> const& to, VoigtStress<Dim> const& before,
                                  VoigtStress<Dim> const& after) {
  Gradient<Dim> const identity = Gradient<Dim>::Identity();
  RotatedIncrement<Dim> const moved((to - from) * (identity + from).inverse());
  if (!moved.verdict.acceptable()) return {EngineeringStrain<Dim>::Zero(), VoigtStress<Dim>::Zero()};
  Tensor<Dim> const unturned = moved.turn.transpose() * from_voigt_stress<Dim, double>(after) * moved.turn;
  return {to_engineering_strain<Dim, double>(moved.strain), to_voigt_stress<Dim, double>(unturned) - before};
}

}  // namespace scarp
