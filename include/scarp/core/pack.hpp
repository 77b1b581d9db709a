// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <experimental/simd>

namespace scarp {

/// As many scalars as one vector register of the target holds; laws and shapes accept it in place of a scalar.
template <class Scalar>
using Pack = std::experimental::native_simd<Scalar>;

template <class Scalar>
Pack<Scalar> load(Scalar const* from) {
  return Pack<Scalar>(from, std::experimental::element_aligned);
}

template <class Scalar>
void store(Pack<Scalar> const& values, Scalar* to) {
  values.copy_to(to, std::experimental::element_aligned);
}

/// Lane k is base[row[k] * stride].
template <class Scalar>
Pack<Scalar> gather(Scalar const* base, std::int32_t const* row, std::size_t stride) {
  return Pack<Scalar>([&](auto lane) { return base[static_cast<std::size_t>(row[lane]) * stride]; });
}

}  // namespace scarp
