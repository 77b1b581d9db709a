// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/principal.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Direction, of length 1, of the larger (more tensile) principal stress; one of them where all are equal.
template <int Dim>
Vector<Dim> principal_direction(VoigtStress<Dim> const& stress) {
  if constexpr (Dim == 2) {
    double const angle = std::atan2(2.0 * stress(2), stress(0) - stress(1)) / 2.0;
    return {std::cos(angle), std::sin(angle)};
  } else {
    return principal(from_voigt_stress<3, double>(stress)).directions.col(0);
  }
}

/// Stress [Pa] in the mirror across a plane with a normal of length 1.
template <int Dim>
VoigtStress<Dim> mirrored_stress(VoigtStress<Dim> const& stress, Vector<Dim> const& normal) {
  Tensor<Dim> const whole = from_voigt_stress<Dim, double>(stress);
  return to_voigt_stress<Dim, double>(turned<Dim>(reflection<Dim>(normal), whole));
}

/// Mirrors the members of a state by their types: stresses, tangents, tensors of rank two and packings (see
/// `mirrored`); other numbers stay. In the plane a 3 x 3 matrix is a tangent and a vector of six numbers a stress in
/// space.
template <int Dim>
struct Mirror {
  Vector<Dim> normal;  ///< of the plane, of length 1

  /// Replaces a member by its image, those of a described type one by one.
  /// \throws InputError for a type whose image is not known
  template <class T>
  void operator()(std::string_view name, T& value) const {
    if constexpr (requires { mirrored(value, normal); }) {
      value = mirrored(std::move(value), normal);
    } else if constexpr (std::same_as<T, VoigtStress<Dim>>) {
      value = mirrored_stress<Dim>(value, normal);
    } else if constexpr (std::same_as<T, VoigtStress<3>>) {
      Vector<3> in_space = Vector<3>::Zero();
      in_space.head<Dim>() = normal;
      value = mirrored_stress<3>(value, in_space);
    } else if constexpr (std::same_as<T, Tensor<Dim>>) {
      value = turned<Dim>(reflection<Dim>(normal), value);
    } else if constexpr (std::same_as<T, VoigtTangent<Dim>>) {
      for (int k = 0; k < value.cols(); ++k) value.col(k) = mirrored_stress<Dim>(value.col(k), normal);
      for (int k = 0; k < value.rows(); ++k)
        value.row(k) = mirrored_stress<Dim>(value.row(k).transpose(), normal).transpose();
    } else if constexpr (Described<T>) {
      T::members(value, *this);
    } else if constexpr (!std::is_arithmetic_v<T> && !std::is_enum_v<T>) {
      reject("a state cannot be mirrored (nothing is known of the mirror image of its member '{}'): copy it as it is",
             name);
    }
  }
};

}  // namespace scarp
