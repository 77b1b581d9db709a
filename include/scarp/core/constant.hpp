// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <limits>

namespace scarp {

/// The scalar that a pack has many of, or the scalar itself.
template <class T>
struct ScalarOf {
  using type = T;
};
template <class T>
  requires requires { typename T::value_type; }
struct ScalarOf<T> {
  using type = typename T::value_type;
};

/// A number as scalar type T; a pack gets it in every lane, rounded to the pack's precision.
template <class T>
constexpr T constant(double value) {
  return T(static_cast<typename ScalarOf<T>::type>(value));
}

/// The smallest normal number: as a floor of divisors it keeps 0/0 away in any system of units.
template <class T>
constexpr T tiny() {
  return T(std::numeric_limits<typename ScalarOf<T>::type>::min());
}

}  // namespace scarp
