// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/tensor.hpp"

namespace scarp {

/// How a degree of freedom moves a place: derivative of the position with respect to it.
struct Lever {
  int dof = -1;
  Vector<2> direction = Vector<2>::Zero();
};

}  // namespace scarp
