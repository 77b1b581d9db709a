// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <concepts>

#include "scarp/contact/contact_law.hpp"
#include "scarp/contact/coulomb.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/simd/select.hpp"

namespace scarp {

/// Forces in addition to a contact's springs.
/// push(S_n, approach): normal force [N] in addition to a spring of tangent stiffness S_n [N/m].
/// drag(shear, S_t, limit, approach): adds to the spring's shear force inside the limit; returns the loss [J].
template <class Damping>
concept ContactDamping = requires(Damping const& damping, double& shear, ContactKinematics<2, double> const& approach) {
  { Damping::needs_motion } -> std::convertible_to<bool>;
  { damping.push(1.0, approach) } -> std::same_as<double>;
  { damping.drag(shear, 1.0, 1.0, approach) } -> std::same_as<double>;
};

/// No viscous force at contacts; models ContactDamping.
struct NoContactDamping {
  static constexpr bool needs_motion = false;  ///< no input of its own

  template <int Dim, class T>
  constexpr T push(T const&, ContactKinematics<Dim, T> const&) const {
    return broadcast<T>(0);
  }
  template <int Dim, class T>
  constexpr T drag(Tangential<Dim, T>&, T const&, T const&, ContactKinematics<Dim, T> const&) const {
    return broadcast<T>(0);
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

/// Kelvin-Voigt contacts: dashpots \f$ c = 2\gamma\sqrt{m^* S} \f$ parallel to both springs of a Hertz contact (form of
/// Tsuji et al. 1992), so that spheres rebound with one restitution at every speed. The contact never pulls.
/// restitution in (0, 1]; the damping ratio follows from it
struct HertzRestitution {
  static constexpr bool needs_motion = true;  ///< of the dashpots: motion, reduced mass and time step

  double restitution = 1.0;                               ///< e, speed of separation over speed of approach
  double damping_ratio = damping_ratio_for(restitution);  ///< gamma, share of critical damping, see `damping_ratio_for`

  void validate() const {
    require_between("restitution of the contact law", require_positive("restitution of the contact law", restitution),
                    0.0, 1.0);
    if (double const wanted = damping_ratio_for(restitution); !(std::abs(damping_ratio - wanted) <= 1e-9))
      reject("the damping ratio is {} and the restitution {} (they do not fit, it would be {}): make the damping anew",
             damping_ratio, restitution, wanted);
  }

  template <int Dim, class T>
  constexpr T push(T const& stiffness, ContactKinematics<Dim, T> const& approach) const {
    return stiffness_of_step(stiffness, approach) * approach.overlap_increment;
  }

  template <int Dim, class T>
  constexpr T drag(Tangential<Dim, T>& shear, T const& stiffness, T const& limit,
                   ContactKinematics<Dim, T> const& approach) const {
    T const work_of_spring = dot(shear, approach.tangential_increment);
    coulomb_slide<Dim, T>(shear, approach.tangential_increment, stiffness_of_step(stiffness, approach), limit);
    return work_of_spring - dot(shear, approach.tangential_increment);
  }

 private:
  /// In one step a dashpot acts like a spring of stiffness \f$ c / \Delta t \f$ without memory.
  template <int Dim, class T>
  constexpr T stiffness_of_step(T const& stiffness, ContactKinematics<Dim, T> const& approach) const {
    using std::sqrt;
    T const dashpot = broadcast<T>(2.0 * damping_ratio) * sqrt(approach.reduced_mass * stiffness);
    return lanes::select(approach.time_step > broadcast<T>(0), dashpot / approach.time_step, broadcast<T>(0));
  }
};

static_assert(ContactDamping<NoContactDamping>);
static_assert(ContactDamping<HertzRestitution>);

/// What a grain is made of.
struct ElasticGrain {
  double modulus = 0.0;  ///< Young's [Pa]
  double poisson = 0.0;  ///< Poisson's ratio

  /// \throws InputError for a modulus or a ratio that no material has
  void validate() const {
    require_positive("Young's modulus of a grain", modulus);
    require_between("Poisson's ratio of a grain", poisson, -1.0, 0.5);
  }
};

/// Two elastic spheres: Hertz along the normal, Mindlin's stiffness without slip along the tangent, Coulomb's limit.
/// \f$ F_n = \tfrac43 E^* a\,u,\; F_t \leftarrow F_t - 8 G^* a\,\Delta s,\; |F_t| \le \mu F_n,\; a = \sqrt{R^* u} \f$
/// Where the contact radius a shrinks, F_t first shrinks in proportion. In this incremental form no closed path of
/// motion creates energy, whereas the total form \f$ F_t = -8 G^* a\,s \f$ does (Thornton, Cummins and Cleary 2013,
/// Powder Technology 233; LAMMPS: mindlin_rescale).
/// \f$ 1/E^* = \sum (1 - \nu_i^2)/E_i,\; 1/G^* = \sum (2 - \nu_i)/G_i \f$ [Pa]; friction coefficient dimensionless
/// `dissipated` closes the balance of energy exactly along the tangent, to second order in the step along the normal,
/// and to first order for the damping.
template <ContactDamping Damping = NoContactDamping>
struct HertzMindlin {
  static constexpr ContactInputs inputs{.shear = true, .scalars = 1, .radius = true, .motion = Damping::needs_motion};

  double reduced_modulus = 0.0;        ///< E* [Pa]
  double reduced_shear_modulus = 0.0;  ///< G* [Pa]
  double friction = 0.0;               ///< mu, coefficient of Coulomb's limit
  Damping damping{};                   ///< viscous forces in addition to the springs

  void validate() const {
    require_positive("reduced modulus of the contact law", reduced_modulus);
    require_not_negative("reduced shear modulus of the contact law", reduced_shear_modulus);
    require_not_negative("friction of the contact law", friction);
    detail::validated(damping);
  }

  /// Spheres of one material. \throws InputError for a modulus or a ratio that no material has
  static HertzMindlin of(ElasticGrain const& grain, double friction, Damping damping = {}) {
    return between(grain, grain, friction, damping);
  }

  /// Spheres of two materials. \throws InputError for a modulus or a ratio that no material has
  static HertzMindlin between(ElasticGrain const& first, ElasticGrain const& second, double friction,
                              Damping damping = {}) {
    detail::validated(first);
    detail::validated(second);
    auto const compliance = [](ElasticGrain const& grain) {
      return (1.0 - grain.poisson * grain.poisson) / grain.modulus;
    };
    auto const shear_compliance = [](ElasticGrain const& grain) {
      return (2.0 - grain.poisson) * 2.0 * (1.0 + grain.poisson) / grain.modulus;  // G = E / 2(1 + nu)
    };
    return {.reduced_modulus = 1.0 / (compliance(first) + compliance(second)),
            .reduced_shear_modulus = 1.0 / (shear_compliance(first) + shear_compliance(second)),
            .friction = friction,
            .damping = damping};
  }

  template <int Dim, class T>
  constexpr ContactForce<Dim, T> respond(ContactKinematics<Dim, T> const& approach,
                                         ContactMemory<Dim, T>& memory) const {
    using std::sqrt;
    T const overlap = lanes::at_least(approach.overlap, broadcast<T>(0));
    T const contact_radius = sqrt(approach.reduced_radius * overlap);
    T const elastic = broadcast<T>(4.0 / 3.0 * reduced_modulus) * contact_radius * overlap;
    T const tangential_stiffness = broadcast<T>(8.0 * reduced_shear_modulus) * contact_radius;

    T const viscous = damping.push(broadcast<T>(2.0 * reduced_modulus) * contact_radius, approach);
    T const normal = lanes::at_least(elastic + viscous, broadcast<T>(0));
    T const limit = broadcast<T>(friction) * normal;

    T lost = (normal - elastic) * approach.overlap_increment;
    lost = lost + resize(contact_radius, approach.slip_increment, memory);
    lost = lost + coulomb_slide<Dim, T>(memory.shear, approach.slip_increment, tangential_stiffness, limit);
    Tangential<Dim, T> shear = memory.shear;
    lost = lost + damping.drag(shear, tangential_stiffness, limit, approach);
    return {.normal = normal, .shear = shear, .dissipated = lost};
  }

  /// \f$ S_n = 2 E^* a,\; S_t = 8 G^* a \f$ [N/m] at an overlap and a reduced radius [m]
  constexpr ContactStiffness stiffness(double overlap, double reduced_radius) const {
    double const contact_radius = std::sqrt(reduced_radius * lanes::at_least(overlap, 0.0));
    return {.normal = 2.0 * reduced_modulus * contact_radius,
            .tangential = 8.0 * reduced_shear_modulus * contact_radius};
  }

  constexpr double damping_ratio() const {
    if constexpr (requires { damping.damping_ratio; }) return damping.damping_ratio;
    return 0.0;
  }

  /// \f$ \tfrac{8}{15} E^* a\,u^2 + F_t^2 / 16 G^* a \f$
  template <int Dim, class T>
  constexpr T stored_energy(ContactKinematics<Dim, T> const& approach, ContactMemory<Dim, T> const& memory) const {
    using std::sqrt;
    T const overlap = lanes::at_least(approach.overlap, broadcast<T>(0));
    T const contact_radius = sqrt(approach.reduced_radius * overlap);
    return broadcast<T>(8.0 / 15.0 * reduced_modulus) * contact_radius * overlap * overlap +
           shear_energy<Dim, T>(memory.shear, contact_radius);
  }

 private:
  template <int Dim, class T>
  constexpr T shear_energy(Tangential<Dim, T> const& shear, T const& contact_radius) const {
    // An open contact has neither force nor stiffness.
    return dot(shear, shear) /
           lanes::at_least(broadcast<T>(16.0 * reduced_shear_modulus) * contact_radius, smallest_normal<T>());
  }

  /// Gives the stored shear spring the new contact radius.
  /// \return energy [J] that leaves the spring; the last term makes up for the step's mean force, see coulomb_slide
  template <int Dim, class T>
  constexpr T resize(T const& contact_radius, Tangential<Dim, T> const& slip, ContactMemory<Dim, T>& memory) const {
    T const former_radius = memory.scalars[0];
    T const former_energy = shear_energy<Dim, T>(memory.shear, former_radius);
    T const kept =
        lanes::at_most(contact_radius / lanes::at_least(former_radius, smallest_normal<T>()), broadcast<T>(1));
    T const work_of_former = dot(memory.shear, slip);
    memory.shear = scaled(memory.shear, kept);
    memory.scalars[0] = contact_radius;
    return former_energy - shear_energy<Dim, T>(memory.shear, contact_radius) -
           broadcast<T>(0.5) * (broadcast<T>(1) - kept) * work_of_former;
  }
};

static_assert(ContactLaw<HertzMindlin<HertzRestitution>>);
static_assert(Frictional<HertzMindlin<>>);
static_assert(HasStoredEnergy<HertzMindlin<>>);

template <>
inline constexpr bool is_precompiled<HertzMindlin<>> = detail::has_library;

}  // namespace scarp
