// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <concepts>

#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/coulomb.hpp"
#include "scarp/core/select.hpp"

namespace scarp {

/// Forces beside a contact's springs.
/// push(S_n, approach): normal force [N] beside a spring of tangent stiffness S_n [N/m].
/// drag(shear, S_t, limit, approach): adds to the spring's shear force inside the limit; returns the loss [J].
template <class Damping>
concept ContactDamping = requires(Damping const& damping, double& shear, Approach<2, double> const& approach) {
  { Damping::needs_motion } -> std::convertible_to<bool>;
  { damping.push(1.0, approach) } -> std::same_as<double>;
  { damping.drag(shear, 1.0, 1.0, approach) } -> std::same_as<double>;
};

struct NoContactDamping {
  static constexpr bool needs_motion = false;

  template <int Dim, class T>
  T push(T const&, Approach<Dim, T> const&) const {
    return constant<T>(0);
  }
  template <int Dim, class T>
  T drag(Tangential<Dim, T>&, T const&, T const&, Approach<Dim, T> const&) const {
    return constant<T>(0);
  }
};

/// Damping ratio gamma at which a Hertz contact that never pulls returns the restitution e, exactly and at every speed:
/// \f$ \ln e = -2\,\eta\,\arccos\eta / \sqrt{1 - \eta^2},\; \eta = \sqrt{6/5}\,\gamma,\; c = 2\gamma\sqrt{m^* S_n} \f$
/// In \f$ u^{5/4} \f$ the contact is a linear spring with a dashpot of damping ratio eta (Antypov and Elliott 2011, EPL
/// 94), whose restitution up to the moment without force is known (Schwager and Poeschel 2007, Granular Matter 9). The
/// polynomial of Thornton, Cummins and Cleary 2013 fits the same curve, but strays by up to 0.015 in e for e > 0.9.
/// restitution in (0, 1]
inline double damping_ratio_for(double restitution) {
  auto const decay = [](double eta) {
    double const square = 1.0 - eta * eta;
    if (std::abs(square) < 1e-12) return 2.0;
    return 2.0 * eta * (square > 0.0 ? std::acos(eta) / std::sqrt(square) : std::acosh(eta) / std::sqrt(-square));
  };
  double low = 0.0;
  double high = 1.0 / std::sqrt(restitution);  // decay(eta) > 2 ln(2 eta)
  for (int halving = 0; halving < 60; ++halving) {
    double const middle = 0.5 * (low + high);
    (decay(middle) < -std::log(restitution) ? low : high) = middle;
  }
  return std::sqrt(5.0 / 6.0) * low;
}

/// Dashpots \f$ c = 2\gamma\sqrt{m^* S} \f$ beside both springs of a Hertz contact (form of Tsuji et al. 1992), so that
/// spheres rebound with one restitution at every speed. The contact never pulls.
/// restitution in (0, 1]; the damping ratio follows from it
struct HertzRestitution {
  static constexpr bool needs_motion = true;

  double restitution = 1.0;
  double damping_ratio = damping_ratio_for(restitution);

  template <int Dim, class T>
  T push(T const& stiffness, Approach<Dim, T> const& approach) const {
    return stiffness_of_step(stiffness, approach) * approach.closing;
  }

  template <int Dim, class T>
  T drag(Tangential<Dim, T>& shear, T const& stiffness, T const& limit, Approach<Dim, T> const& approach) const {
    T const work_of_spring = inner_product(shear, approach.sweep);
    coulomb_slide<Dim, T>(shear, approach.sweep, stiffness_of_step(stiffness, approach), limit);
    return work_of_spring - inner_product(shear, approach.sweep);
  }

 private:
  /// In one step a dashpot acts like a spring of stiffness \f$ c / \Delta t \f$ that remembers nothing.
  template <int Dim, class T>
  T stiffness_of_step(T const& stiffness, Approach<Dim, T> const& approach) const {
    using std::sqrt;
    T const dashpot = constant<T>(2.0 * damping_ratio) * sqrt(approach.reduced_mass * stiffness);
    return lanes::select(approach.time_step > constant<T>(0), dashpot / approach.time_step, constant<T>(0));
  }
};

static_assert(ContactDamping<NoContactDamping>);
static_assert(ContactDamping<HertzRestitution>);

}  // namespace scarp
