// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/contact/contact_law.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Spring with a slider (stick and slip after Coulomb): \f$ f \leftarrow f - k\,\Delta s,\; |f| \le limit \f$; for a
/// force with its slip or a moment with its roll. A limit of zero empties the spring.
/// \return work against the slider minus what the spring loses by it, \f$ (f_0 + f_1)(f_{trial} - f_1)/2k \f$ [J]: with
/// the mean of old and new force as the force of the step the energy balance closes exactly
template <int Dim, class T>
constexpr T coulomb_slide(Tangential<Dim, T>& force, Tangential<Dim, T> const& slip, T const& stiffness,
                          T const& limit) {
  using std::sqrt;
  T const halved_compliance = broadcast<T>(0.5) / lanes::at_least(stiffness, smallest_normal<T>());
  if constexpr (Dim == 2) {
    T const trial = force - stiffness * slip;
    T const limited = lanes::at_least(lanes::at_most(trial, limit), -limit);
    T const lost = (force + limited) * (trial - limited) * halved_compliance;
    force = limited;
    return lost;
  } else {
    std::array<T, 3> trial;
    for (std::size_t k = 0; k < 3; ++k) trial[k] = force[k] - stiffness * slip[k];
    T const scale =
        lanes::at_most(limit / sqrt(lanes::at_least(dot(trial, trial), smallest_normal<T>())), broadcast<T>(1));
    T lost = broadcast<T>(0);
    for (std::size_t k = 0; k < 3; ++k) {
      T const limited = trial[k] * scale;
      lost = lost + (force[k] + limited) * (trial[k] - limited) * halved_compliance;
      force[k] = limited;
    }
    return lost;
  }
}

}  // namespace scarp
