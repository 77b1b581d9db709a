// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace scarp {

/// A number as scalar type T; a pack gets it in every lane, rounded to the pack's precision.
template <class T>
constexpr T constant(double value) {
  if constexpr (requires { typename T::value_type; }) {
    return T(static_cast<typename T::value_type>(value));
  } else {
    return static_cast<T>(value);
  }
}

}  // namespace scarp
