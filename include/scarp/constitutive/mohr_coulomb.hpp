// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/detail/mohr_coulomb_return.hpp"
#include "scarp/constitutive/geostatic_stress.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/principal.hpp"

namespace scarp {

/// Linear elasticity below a Mohr-Coulomb surface with tension cut-off; flow by the angle of dilation (associated where
/// tension is cut off); strength constant or a function of the plastic shear strain. In two dimensions plane strain
/// with the stress out of the plane as part of the state. The stress update is an implicit Euler step from the
/// committed stress, turned by the increment's rotation.
/// \tparam Dim 2 or 3
/// \tparam InitialStress an `InitialStressField`
/// \tparam StrengthType a `StrengthLaw`
template <int Dim, class InitialStress = StressFree<Dim>, StrengthLaw StrengthType = ConstantStrength>
  requires InitialStressField<InitialStress, Dim>
struct MohrCoulomb {
  static constexpr int dim = Dim;
  static constexpr bool exact_tangent = true;  ///< but for the rotation of an increment

  /// Stress, hardening variable and tangent of a point.
  struct State {
    VoigtStress<3> stress = VoigtStress<3>::Zero();  ///< of all three dimensions [Pa]
    double plastic_shear = 0.0;                      ///< accumulated difference of the outer principal plastic strains
    VoigtTangent<Dim> tangent = VoigtTangent<Dim>::Zero();  ///< consistent with the increment that led here [Pa]

    SCARP_MEMBERS(stress, plastic_shear, tangent)
  };

  IsotropicElasticity elasticity{};  ///< below the yield surface
  StrengthType strength{};           ///< constant, or a function of the plastic shear strain
  InitialStress initial{};           ///< every point's start, by depth

  /// The stress out of the plane starts as the horizontal one in it.
  /// \throws InputError for a strength or elasticity that cannot be, and for a stress outside the strength
  State initial_state(Site<Dim> const& site) const {
    validate();
    VoigtStress<Dim> const start = initial_stress<Dim>(initial, site);
    Tensor<3> const stress = in_space<Dim>(from_voigt_stress<Dim, double>(start), start(0));
    require_within_strength(principal(stress).values, site);
    return {to_voigt_stress<3, double>(stress), 0.0, elasticity.template stiffness<Dim>()};
  }

  /// A strength that changes is checked at every decade of the plastic shear strain, whatever its law checks itself.
  /// \throws InputError for a strength or elasticity that cannot be
  void validate() const {
    elasticity.validate();
    detail::validated(strength).at(0.0).validate();
    if constexpr (StrengthType::changes) {
      constexpr double least = 1e-6;
      constexpr double most = 1e3;
      for (double shear = least; shear <= most; shear *= 10.0) strength.at(shear).validate();
    }
  }

  /// For a state that comes from elsewhere.
  /// \throws InputError where its stress lies outside the strength that its plastic shear strain leaves, since another
  /// law has made it
  void require_fitting(State const& state) const {
    Vector<3> const values = principal(from_voigt_stress<3, double>(state.stress)).values;
    Strength const left = strength.at(state.plastic_shear);
    constexpr double round_off = 1e-6;
    if (detail::mohr_coulomb_excess(left, values) <= round_off * std::max(values.cwiseAbs().maxCoeff(), left.cohesion))
      return;
    reject(
        "the state has principal stresses of {:.6g}, {:.6g} and {:.6g} Pa (the strength of these points, cohesion {} "
        "Pa and "
        "friction {:.6g} rad, does not bear them: another law has made it): give a state of points with one law",
        values(0), values(1), values(2), left.cohesion, left.friction);
  }

  VoigtStress<Dim> stress(State const& state) const { return part_of_stress<Dim>(state.stress); }

  /// Derivative of the last stress update with respect to its strain; before any, the elastic stiffness.
  VoigtTangent<Dim> tangent(State const& state) const { return state.tangent; }

  /// Fails with `not_finite`, `element_inverted`, or `no_return` where no strength belongs to the increment, since a
  /// strength that rises at once by more than the increment bears lies in its way; `trial` is then a copy of
  /// `committed`.
  Response<Dim> respond(State const& committed, Gradient<Dim> const& increment, State& trial) const {
    trial = committed;
    RotatedIncrement<Dim> const moved(increment);
    if (!moved.verdict.acceptable()) return {stress(committed), moved.verdict};
    Tensor<3> const strain = in_space<Dim>(moved.strain, 0.0), turn = in_space<Dim>(moved.turn, 1.0);
    Tensor<3> const predicted = from_voigt_stress<3, double>(committed.stress) + elasticity.stress<3>(strain);
    if (!predicted.allFinite()) return {stress(committed), {Status::failed, Reason::not_finite}};
    Principal const outer = principal(predicted);
    double plastic_shear = committed.plastic_shear;
    auto returned = softened_return(outer.values, plastic_shear);
    if (!returned.found) return {stress(committed), {Status::failed, Reason::no_return}};
    if constexpr (StrengthType::changes) soften_tangent(returned, outer.values, plastic_shear);
    Tensor<3> const directions = turn * outer.directions;
    Tensor<3> const principal_stress = returned.stress.asDiagonal();
    trial.stress = to_voigt_stress<3, double>(turned<3>(directions, principal_stress));
    trial.plastic_shear = plastic_shear;
    trial.tangent = tangent_of(returned, outer.values, directions);
    return {stress(trial), {}};
  }

 private:
  using Return = detail::PrincipalReturn;

  void require_within_strength(Vector<3> const& stress, Site<Dim> const& site) const {
    Strength const start = strength.at(0.0);
    constexpr double round_off = 1e-10;
    if (detail::mohr_coulomb_excess(start, stress) <=
        round_off * std::max(stress.cwiseAbs().maxCoeff(), start.cohesion))
      return;
    double const sine = std::sin(start.friction);
    reject(
        "the initial stress of point {} in region {}, {} m deep, has principal stresses of {}, {} and {} Pa (its "
        "strength, "
        "cohesion {} Pa and friction {} rad, does not bear them): give more strength or another initial stress; "
        "without "
        "cohesion K0 lies between {:.3f} and {:.3f}",
        site.index, site.region, site.depth, stress(0), stress(1), stress(2), start.cohesion, start.friction,
        (1.0 - sine) / (1.0 + sine), (1.0 + sine) / (1.0 - sine));
  }

  Return returned_at(Vector<3> const& trial, double plastic_shear) const {
    return detail::mohr_coulomb_return(strength.at(plastic_shear), elasticity.lame_lambda, elasticity.shear_modulus,
                                       trial);
  }

  static double shear_of(Vector<3> const& plastic_strain) {
    return plastic_strain.maxCoeff() - plastic_strain.minCoeff();
  }

  /// The return whose plastic shear strain gives the strength that it returned to. plastic_shear: committed, then new
  Return softened_return(Vector<3> const& trial, double& plastic_shear) const {
    Return returned = returned_at(trial, plastic_shear);
    if constexpr (!StrengthType::changes) {
      plastic_shear += shear_of(returned.plastic_strain);
      return returned;
    }
    double const before = plastic_shear;
    double low = before;
    double gap_low =
        shear_of(returned.plastic_strain);  // plastic shear that the strength at `low` lets happen beyond it
    if (!returned.found || gap_low == 0.0) return returned;
    double high = before + gap_low;
    double gap_high = 0.0;
    constexpr int most = 200;
    for (int k = 0;; ++k) {
      returned = returned_at(trial, high);
      gap_high = before + shear_of(returned.plastic_strain) - high;
      if (!returned.found || k == 2 * most) return {};
      if (!(gap_high > 0.0)) break;
      low = high;
      gap_low = gap_high;
      high += k < most ? 2.0 * gap_high : high - before;  // the gap is small near the snap-back rate
    }
    for (int k = 0; k < most; ++k) {  // Illinois' variant of the false position
      double const middle = high - gap_high * (high - low) / (gap_high - gap_low);
      returned = returned_at(trial, middle);
      double const gap = before + shear_of(returned.plastic_strain) - middle;
      plastic_shear = middle;
      if (!returned.found || std::abs(gap) <= 1e-14 * (high - before) + 1e-16) return returned;
      // Near incompressibility one bit of the shear changes the gap by more than that. It jumps where there is no root.
      bool const to_the_bit = std::abs(high - low) <= 4.0 * std::numeric_limits<double>::epsilon() * middle;
      if (to_the_bit && std::abs(gap) <= 1e-9 * middle) return returned;
      if (gap * gap_high < 0.0) {
        low = high;
        gap_low = gap_high;
      } else {
        gap_low *= 0.5;
      }
      high = middle;
      gap_high = gap;
    }
    return {};
  }

  /// Adds to a return's tangent what the change of strength with the plastic shear strain does,
  /// \f$ d\sigma = D\,d\varepsilon + \sigma_\kappa\,d\kappa,\; d\kappa = w\cdot d\varepsilon^p \f$ with w = +1 and -1
  /// at the outer principal strains.
  void soften_tangent(Return& returned, Vector<3> const& trial, double plastic_shear) const {
    if (returned.planes == 0) return;
    constexpr double step = 1e-6;  // of plastic strain; the strength is smooth over it but for single kinks
    double const back = std::min(step, plastic_shear);  // since there is no strength before the first plastic strain
    Vector<3> const slope =
        (returned_at(trial, plastic_shear + step).stress - returned_at(trial, plastic_shear - back).stress) /
        (step + back);
    Vector<3> weight = Vector<3>::Zero();
    Eigen::Index largest = 0;
    Eigen::Index smallest = 0;
    returned.plastic_strain.maxCoeff(&largest);
    returned.plastic_strain.minCoeff(&smallest);
    weight(largest) = 1.0;
    weight(smallest) = -1.0;
    double const twice_shear = 2.0 * elasticity.shear_modulus;  // weight adds up to zero: no volumetric part
    Vector<3> const by_strain = weight - returned.tangent.transpose() * weight / twice_shear;
    double const by_itself = -weight.dot(slope) / twice_shear;
    returned.tangent += slope * by_strain.transpose() / (1.0 - by_itself);
  }

  VoigtTangent<Dim> tangent_of(Return const& returned, Vector<3> const& trial, Tensor<3> const& directions) const {
    VoigtTangent<3> const whole =
        isotropic_derivative(returned.tangent, trial / (2.0 * elasticity.shear_modulus), returned.stress, directions);
    if constexpr (Dim == 3) {
      return whole;
    } else {
      constexpr std::array in_plane{0, 1, 5};
      VoigtTangent<2> part;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) part(i, j) = whole(in_plane[detail::index(i)], in_plane[detail::index(j)]);
      }
      return part;
    }
  }
};

static_assert(ConstitutiveProvider<MohrCoulomb<2>>);
static_assert(ConstitutiveProvider<MohrCoulomb<3>>);

}  // namespace scarp
