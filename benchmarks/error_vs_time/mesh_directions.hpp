// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <type_traits>

#include "../../examples/shared/study/choice.hpp"

namespace error_vs_time {

using fault_rupture::MeshPattern;

using LeftPattern = std::integral_constant<MeshPattern, MeshPattern::left>;
using RightPattern = std::integral_constant<MeshPattern, MeshPattern::right>;
using JitteredPattern = std::integral_constant<MeshPattern, MeshPattern::jittered>;

/// size: of a crossed square cell [m]; cells of another pattern or aspect are as large as gives about as many triangles
inline void set_mesh(fault_rupture::Choice& choice, double size, MeshPattern pattern, double aspect) {
  bool const two_in_a_cell = pattern == MeshPattern::left || pattern == MeshPattern::right;  // crossed: four
  choice.size = size / std::sqrt(two_in_a_cell ? 2.0 * aspect : aspect);
  choice.pattern = pattern;
  choice.aspect = aspect;
}

}  // namespace error_vs_time
