// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <array>
#include <utility>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/tensor/voigt.hpp"

namespace points_library {

using Tensor3 = scarp::Tensor<3>;

/// Which components STRESS has, and in which axes of the material they stand.
struct Components {
  std::array<std::pair<int, int>, 6> pairs{};  ///< of the host's axes
  std::array<int, 3> axis{0, 1, 2};            ///< of the material, by that of the host
  int size = 0;

  /// dim: of the material. In a host's plane y is vertical; in space the material's vertical is its last axis.
  /// \throws InputError for lengths that do not fit the dimension
  static Components of(int dim, int ntens, bool kratos) {
    if (dim == 2 && ntens == 3) return {{{{0, 0}, {1, 1}, {0, 1}}}, {0, 1, 2}, 3};
    if (ntens == 4) return {{{{0, 0}, {1, 1}, {2, 2}, {0, 1}}}, {0, dim == 3 ? 2 : 1, dim == 3 ? 1 : 2}, 4};
    if (dim == 3 && ntens == 6) {
      std::pair<int, int> const yz{1, 2}, zx{0, 2};
      return {{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, kratos ? yz : zx, kratos ? zx : yz}}, {0, 1, 2}, 6};
    }
    scarp::reject("NTENS is {} for a material of dimension {} (3 or 4 in 2, 4 or 6 in 3 are expected): change one",
                  ntens, dim);
  }

  /// strain: components with engineering shear
  Tensor3 strain_tensor(double const* strain) const {
    Tensor3 tensor = Tensor3::Zero();
    for (int k = 0; k < size; ++k) {
      auto const [i, j] = pairs[scarp::detail::index(k)];
      tensor(i, j) = tensor(j, i) = i == j ? strain[k] : strain[k] / 2.0;
    }
    return tensor;
  }

  Tensor3 in_material_axes(Tensor3 const& host) const {
    Tensor3 own;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) own(axis[scarp::detail::index(i)], axis[scarp::detail::index(j)]) = host(i, j);
    }
    return own;
  }

  /// Place of component k among those of a material, -1 for one that it does not have.
  template <int Dim>
  int place(int k) const {
    auto const [i, j] = pairs[scarp::detail::index(k)];
    std::pair<int, int> const own{axis[scarp::detail::index(i)], axis[scarp::detail::index(j)]};
    constexpr auto known = scarp::voigt_indices<Dim>();
    for (int c = 0; c < scarp::voigt_size<Dim>; ++c) {
      auto const& one = known[scarp::detail::index(c)];
      if (one == own || one == std::pair{own.second, own.first}) return c;
    }
    return -1;
  }
};

/// Displacement gradient whose stretch has the strain E at its half-way configuration, and the rotation R before it:
/// \f$ I + G = (I + E/2)(I - E/2)^{-1} R = (I + E (I - E/2)^{-1}) R \f$. `RotatedIncrement` finds E again, in axes that
/// have not turned; DSTRAN and DROT of Abaqus are E and R. Zero strain, and what is zero out of a plane, stay exactly
/// zero.
inline Tensor3 gradient_of(Tensor3 const& strain, Tensor3 const& rotation) {
  Tensor3 const identity = Tensor3::Identity();
  return strain * (identity - strain / 2.0).inverse() * rotation + (rotation - identity);
}

}  // namespace points_library
