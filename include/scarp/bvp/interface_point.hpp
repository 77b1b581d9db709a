// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/tensor.hpp"

namespace scarp {

/// What an interface says of one of its points.
struct InterfacePoint {
  Vector<2> place = Vector<2>::Zero();   ///< of the standing body [m]
  double area = 0.0;                     ///< [m2]
  Vector<2> stress = Vector<2>::Zero();  ///< of the ground on the standing body [Pa]
  double pressure = 0.0;                 ///< [Pa], positive pushes apart
  double shear = 0.0;                    ///< [Pa], on the standing body, along its base, ground on the left
  double gap = 0.0;                      ///< [m], negative: overlap
};

}  // namespace scarp
