// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include "scarp/contact/contact_law.hpp"
#include "scarp/core/constant.hpp"

namespace scarp {

/// Linear repulsion without tangential force: \f$ F_n = k_n u_n \f$ for u_n > 0. `normal_stiffness` [N/m].
struct Frictionless {
  static constexpr bool remembers_shear = false;

  double normal_stiffness = 0.0;

  template <int Dim, class T, class Shear>
  T respond(Approach<Dim, T> const& approach, Shear&) const {
    using std::max;
    return max(constant<T>(normal_stiffness) * approach.overlap, constant<T>(0));
  }

  ContactStiffness stiffness(double) const { return {normal_stiffness, 0.0}; }
};

static_assert(ContactLaw<Frictionless>);

}  // namespace scarp
