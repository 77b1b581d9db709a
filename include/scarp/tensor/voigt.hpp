// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// Number of independent components of a symmetric tensor: 3 in 2D, 6 in 3D.
template <int Dim>
inline constexpr int voigt_size = Dim*(Dim + 1) / 2;

/// Row and column of each Voigt component: (xx, yy, xy) in 2D, (xx, yy, zz, yz, zx, xy) in 3D.
template <int Dim>
constexpr std::array<std::pair<int, int>, voigt_size<Dim>> voigt_indices() {
  static_assert(Dim == 2 || Dim == 3, "Voigt order is defined for two and three dimensions");
  if constexpr (Dim == 2) {
    return {{{0, 0}, {1, 1}, {0, 1}}};
  } else {
    return {{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}}};
  }
}

/// Cauchy stress [Pa], tension positive, in Voigt order.
template <int Dim, class Scalar = double>
using VoigtStress = Eigen::Matrix<Scalar, voigt_size<Dim>, 1>;

/// Strain in Voigt order with engineering shear, \f$ \gamma_{xy} = 2 \varepsilon_{xy} \f$. Dimensionless.
template <int Dim, class Scalar = double>
using EngineeringStrain = Eigen::Matrix<Scalar, voigt_size<Dim>, 1>;

/// Change of Voigt stress [Pa] per unit engineering strain, shape (voigt, voigt); need not be symmetric.
template <int Dim, class Scalar = double>
using VoigtTangent = Eigen::Matrix<Scalar, voigt_size<Dim>, voigt_size<Dim>>;

/// Voigt stress of the symmetric part of a stress tensor.
template <int Dim, class Scalar>
VoigtStress<Dim, Scalar> to_voigt_stress(Tensor<Dim, Scalar> const& stress) {
  VoigtStress<Dim, Scalar> voigt;
  constexpr auto indices = voigt_indices<Dim>();
  for (int k = 0; k < voigt_size<Dim>; ++k) {
    auto const [i, j] = indices[detail::index(k)];
    voigt(k) = (stress(i, j) + stress(j, i)) / Scalar(2);
  }
  return voigt;
}

/// Symmetric tensor [Pa], shape (Dim, Dim), of a Voigt stress.
template <int Dim, class Scalar>
Tensor<Dim, Scalar> from_voigt_stress(VoigtStress<Dim, Scalar> const& voigt) {
  Tensor<Dim, Scalar> stress;
  constexpr auto indices = voigt_indices<Dim>();
  for (int k = 0; k < voigt_size<Dim>; ++k) {
    auto const [i, j] = indices[detail::index(k)];
    stress(i, j) = stress(j, i) = voigt(k);
  }
  return stress;
}

/// A tensor in space with the components of one in the plane, and one on the diagonal out of the plane; in space
/// itself.
template <int Dim>
Tensor<3> in_space(Tensor<Dim> const& tensor, double out_of_plane) {
  Tensor<3> whole = Tensor<3>::Zero();
  whole.template topLeftCorner<Dim, Dim>() = tensor;
  if constexpr (Dim == 2) whole(2, 2) = out_of_plane;
  return whole;
}

/// Components in the plane of a stress in space; in space all of them.
template <int Dim>
VoigtStress<Dim> part_of_stress(VoigtStress<3> const& stress) {
  Tensor<Dim> const part = from_voigt_stress<3, double>(stress).template topLeftCorner<Dim, Dim>();
  return to_voigt_stress<Dim, double>(part);
}

/// The strain tensor of one unit component in Voigt order, the others zero.
template <int Dim>
Tensor<Dim> unit_strain(int component) {
  auto const [i, j] = voigt_indices<Dim>()[detail::index(component)];
  Tensor<Dim> strain = Tensor<Dim>::Zero();
  strain(i, j) += 0.5;
  strain(j, i) += 0.5;
  return strain;
}

/// Engineering strain of the symmetric part of a displacement gradient.
template <int Dim, class Scalar>
EngineeringStrain<Dim, Scalar> to_engineering_strain(Gradient<Dim, Scalar> const& gradient) {
  EngineeringStrain<Dim, Scalar> strain;
  constexpr auto indices = voigt_indices<Dim>();
  for (int k = 0; k < voigt_size<Dim>; ++k) {
    auto const [i, j] = indices[detail::index(k)];
    strain(k) = i == j ? gradient(i, i) : gradient(i, j) + gradient(j, i);
  }
  return strain;
}

}  // namespace scarp
