// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tri6.hpp"

/// The types of element that the template tests run over; a new element is named here.
#define ALL_ELEMENTS \
  scarp::Tri3, scarp::Tri6, scarp::Quad4, scarp::Quad8, scarp::Tet4, scarp::Tet10, scarp::Hex8, scarp::Hex20
