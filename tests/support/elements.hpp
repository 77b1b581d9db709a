// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/hex20.hpp"
#include "scarp/element/tet10.hpp"
#include "scarp/element/tri6.hpp"

/// Types of element that template tests run over. Compiling a test for an element takes seconds: the slow size has a
/// few that together have both dimensions, simplices and not, straight and quadratic sides; the nightly size has every
/// element.
#ifdef SCARP_TESTS_NIGHTLY
#define ALSO_NIGHTLY(...) , __VA_ARGS__
#else
#define ALSO_NIGHTLY(...)
#endif
#define SAMPLE_ELEMENTS      \
  scarp::Tri3, scarp::Quad8, \
      scarp::Tet10 ALSO_NIGHTLY(scarp::Hex8, scarp::Tri6, scarp::Quad4, scarp::Tet4, scarp::Hex20)
/// For what compiles in no time; a new element is named here and among the sample elements.
#define ALL_ELEMENTS \
  scarp::Tri3, scarp::Tri6, scarp::Quad4, scarp::Quad8, scarp::Tet4, scarp::Tet10, scarp::Hex8, scarp::Hex20

namespace samples {

#ifdef SCARP_TESTS_NIGHTLY
inline constexpr bool nightly = true;
#else
inline constexpr bool nightly = false;
#endif

}  // namespace samples
