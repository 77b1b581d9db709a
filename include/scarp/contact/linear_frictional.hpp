// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/contact/contact_law.hpp"
#include "scarp/core/constant.hpp"

namespace scarp {

/// Linear springs with Coulomb's limit, no tension.
/// \f$ F_n = k_n u_n,\; F_t \leftarrow F_t - k_t\,\Delta s,\; |F_t| \le \mu F_n \f$   (Cundall and Strack 1979; the study's law)
/// Open contacts have F_n = 0, hence F_t = 0: clamping expresses both opening and sliding without a branch.
/// stiffnesses [N/m], friction coefficient dimensionless
struct LinearFrictional {
  static constexpr bool remembers_shear = true;

  double normal_stiffness = 0.0;
  double tangential_stiffness = 0.0;
  double friction = 0.0;

  template <class T>
  T respond(Approach<2, T> const& approach, T& shear) const {
    using std::max;
    using std::min;
    T const normal = max(constant<T>(normal_stiffness) * approach.overlap, constant<T>(0));
    T const limit = constant<T>(friction) * normal;
    shear = max(min(shear - constant<T>(tangential_stiffness) * approach.slip, limit), -limit);
    return normal;
  }

  template <class T>
  T respond(Approach<3, T> const& approach, std::array<T, 3>& shear) const {
    using std::max;
    using std::min;
    using std::sqrt;
    T const normal = max(constant<T>(normal_stiffness) * approach.overlap, constant<T>(0));
    T squared = constant<T>(0);
    for (std::size_t k = 0; k < 3; ++k) {
      shear[k] = shear[k] - constant<T>(tangential_stiffness) * approach.slip[k];
      squared = squared + shear[k] * shear[k];
    }
    T const smallest = constant<T>(1e-30);  // newton squared; only keeps 0/0 away
    T const scale = min(constant<T>(friction) * normal / sqrt(max(squared, smallest)), constant<T>(1));
    for (std::size_t k = 0; k < 3; ++k) shear[k] = shear[k] * scale;
    return normal;
  }

  ContactStiffness stiffness(double) const { return {normal_stiffness, tangential_stiffness}; }
};

static_assert(ContactLaw<LinearFrictional>);
static_assert(Frictional<LinearFrictional>);

}  // namespace scarp
