// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Stress [Pa] in the mirror that turns the first axis round, x -> -x: shear stresses on it change sign.
template <int Dim>
VoigtStress<Dim> mirrored_stress(VoigtStress<Dim> stress) {
  Tensor<Dim> mirror = Tensor<Dim>::Identity();
  mirror(0, 0) = -1.0;
  return to_voigt_stress<Dim, double>(mirror * from_voigt_stress<Dim, double>(stress) * mirror);
}

/// Turns the members of a state round, x -> -x: stresses, tangents and packings (see `mirrored`); other numbers stay.
template <int Dim>
struct Mirror {
  template <class T>
  void operator()(std::string_view name, T& value) const {
    if constexpr (requires { mirrored(value); }) {
      value = mirrored(std::move(value));
    } else if constexpr (std::same_as<T, VoigtStress<Dim>>) {
      value = mirrored_stress<Dim>(value);
    } else if constexpr (std::same_as<T, VoigtStress<3>>) {
      value = mirrored_stress<3>(value);
    } else if constexpr (std::same_as<T, VoigtTangent<Dim>>) {
      for (int k = 0; k < value.cols(); ++k) value.col(k) = mirrored_stress<Dim>(value.col(k));
      for (int k = 0; k < value.rows(); ++k) value.row(k) = mirrored_stress<Dim>(value.row(k).transpose()).transpose();
    } else if constexpr (Described<T>) {
      T::members(value, *this);
    } else if constexpr (!std::is_arithmetic_v<T> && !std::is_enum_v<T>) {
      reject("a state cannot be mirrored (nothing is known of the mirror image of its member '{}'): copy it as it is",
             name);
    }
  }
};

}  // namespace scarp
