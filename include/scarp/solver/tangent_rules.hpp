// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <concepts>
#include <limits>
#include <type_traits>

#include "scarp/core/error.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/voigt.hpp"
#ifdef SCARP_DEFINITIONS
#include <Eigen/Eigenvalues>
#endif

namespace scarp {

/// start(provider, learned): a point's tangent at the start of a step, from the provider's and the one that the step
/// before ended with.
template <class Rule, int Dim>
concept StartsTangent = requires(Rule const& rule, VoigtTangent<Dim> const& tangent) {
  { rule.template start<Dim>(tangent, tangent) } -> std::same_as<VoigtTangent<Dim>>;
};

/// update(tangent, provider, change of strain, change of stress): how an iteration's response changes the tangent.
template <class Rule, int Dim>
concept LearnsFromResponses = requires(Rule const& rule, VoigtTangent<Dim> const& tangent,
                                       EngineeringStrain<Dim> const& strain, VoigtStress<Dim> const& stress) {
  { rule.template update<Dim>(tangent, tangent, strain, stress) } -> std::same_as<VoigtTangent<Dim>>;
};

/// at_trial(trial, first): the tangent from that of the provider's trial state; `first` is the one that the run began
/// with.
template <class Rule, int Dim>
concept FollowsTrialTangent = requires(Rule const& rule, VoigtTangent<Dim> const& tangent) {
  { rule.template at_trial<Dim>(tangent, tangent) } -> std::same_as<VoigtTangent<Dim>>;
};

/// Which tangent a point has while a step is iterated.
template <class Rule, int Dim>
concept TangentRule = StartsTangent<Rule, Dim> &&(LearnsFromResponses<Rule, Dim> || FollowsTrialTangent<Rule, Dim>);

/// Two rules, of which the materials decide: `exact` and `learned`.
template <class Rule, int Dim>
concept ChoosesTangentRule = requires(Rule const& rule) {
  requires TangentRule<std::remove_cvref_t<decltype(rule.exact)>, Dim>;
  requires TangentRule<std::remove_cvref_t<decltype(rule.learned)>, Dim>;
};

namespace detail {
/// A tangent [Pa] raised until no eigenvalue of its symmetric part is below `least` [Pa].
template <int Dim>
SCARP_EXPORT VoigtTangent<Dim> raised(VoigtTangent<Dim> const& tangent, double least);
}  // namespace detail

/// Tangents that learn at every material point: each iteration's change of strain and stress corrects the point's
/// tangent by Broyden's rank-one update, so that thousands of points gather curvature at once where a global
/// quasi-Newton method gathers one direction. A step starts from a mix of the provider's tangent and what the last step
/// has learned. The symmetric part is bounded below by a floor, without which softening makes the system indefinite.
struct PointwiseBroyden {
  double provider_share = 0.5;      ///< of the provider's tangent in the start of a step; the rest is learned
  double floor = 0.02;              ///< least eigenvalue, relative to the mean diagonal of the provider's tangent
  double min_strain_change = 1e-7;  ///< a smaller change teaches nothing but noise

  /// \throws InputError for a share outside of 0 to 1, a floor above 1 or a negative change of strain
  void validate() const {
    require_between("share of the provider's tangent", provider_share, 0.0, 1.0);
    require_between("floor of a learned tangent", floor, std::numeric_limits<double>::lowest(), 1.0);
    require_not_negative("least change of strain that teaches", min_strain_change);
  }

  /// Start of a step from the provider's tangent and the one learned in the step before.
  template <int Dim>
  VoigtTangent<Dim> start(VoigtTangent<Dim> const& provider, VoigtTangent<Dim> const& learned) const {
    return provider_share * provider + (1.0 - provider_share) * learned;
  }

  /// Broyden's update by an iteration's change of strain (engineering shear) and stress [Pa]; then the floor is
  /// applied.
  /// \f$ C \leftarrow C + (\Delta\sigma - C \Delta\epsilon)\, \Delta\epsilon^T / |\Delta\epsilon|^2 \f$
  /// (Broyden 1965, Math. Comp. 19, 577)
  template <int Dim>
  VoigtTangent<Dim> update(VoigtTangent<Dim> tangent, VoigtTangent<Dim> const& provider,
                           EngineeringStrain<Dim> const& strain_change, VoigtStress<Dim> const& stress_change) const {
    double const squared = strain_change.squaredNorm();
    if (!(squared > min_strain_change * min_strain_change)) return tangent;
    tangent += (stress_change - tangent * strain_change) * strain_change.transpose() / squared;
    return detail::raised<Dim>(tangent, floor * provider.trace() / voigt_size<Dim>);
  }
};

static_assert(TangentRule<PointwiseBroyden, 2> && TangentRule<PointwiseBroyden, 3>);

/// Newton's method: every iteration uses the provider's tangent at its trial state. Residuals fall quadratically where
/// that is the derivative of the response and the response is smooth.
struct ConsistentTangent {
  double floor = 0.0;  ///< share of the first tangent that is mixed in, against singular systems at a limit load

  /// \throws InputError for a floor outside of 0 to 1
  void validate() const { require_between("share of the first tangent", floor, 0.0, 1.0); }

  /// What the last accepted iteration ended with: the provider's tangent of the committed state with the floor in it.
  template <int Dim>
  VoigtTangent<Dim> start(VoigtTangent<Dim> const&, VoigtTangent<Dim> const& learned) const {
    return learned;
  }

  /// Mean [Pa] of the trial state's tangent and the run's first one, weighted by the floor.
  template <int Dim>
  VoigtTangent<Dim> at_trial(VoigtTangent<Dim> const& trial, VoigtTangent<Dim> const& first) const {
    return (1.0 - floor) * trial + floor * first;
  }
};

static_assert(TangentRule<ConsistentTangent, 2> && TangentRule<ConsistentTangent, 3>);

/// The rule that suits the materials: `exact` where all of them have exact tangents (see has_exact_tangent), else
/// `learned`.
struct MaterialTangent {
  ConsistentTangent exact{};   ///< of materials like elasticity and Mohr-Coulomb's
  PointwiseBroyden learned{};  ///< where a material is a packing, or states nothing of its tangent

  /// \throws InputError for a setting of either rule outside of its range
  void validate() const {
    exact.validate();
    learned.validate();
  }
};

/// What a tangent can learn from two responses of one point: a strain and the change of stress that it made.
template <int Dim>
struct SecantPair {
  EngineeringStrain<Dim> strain;  ///< engineering shear
  VoigtStress<Dim> stress;        ///< [Pa]
};

/// From the response to one gradient to that to another, both from the same start, in the axes of the first: the
/// rotation between them turns the stress that was there and is no stiffness. Nothing, where no rotation leads from one
/// to the other.
template <int Dim>
SecantPair<Dim> corotated_secant_pair(Gradient<Dim> const& from, Gradient<Dim> const& to,
                                      VoigtStress<Dim> const& before, VoigtStress<Dim> const& after) {
  Gradient<Dim> const identity = Gradient<Dim>::Identity();
  RotatedIncrement<Dim> const moved((to - from) * (identity + from).inverse());
  if (!moved.verdict.acceptable()) return {EngineeringStrain<Dim>::Zero(), VoigtStress<Dim>::Zero()};
  Tensor<Dim> const unturned = moved.turn.transpose() * from_voigt_stress<Dim, double>(after) * moved.turn;
  return {to_engineering_strain<Dim, double>(moved.strain), to_voigt_stress<Dim, double>(unturned) - before};
}

#ifdef SCARP_DEFINITIONS
template <int Dim>
VoigtTangent<Dim> detail::raised(VoigtTangent<Dim> const& tangent, double least) {
  Eigen::SelfAdjointEigenSolver<VoigtTangent<Dim>> const parts((tangent + tangent.transpose()) / 2.0);
  VoigtTangent<Dim> lifted = tangent;
  for (int k = 0; k < voigt_size<Dim>; ++k) {
    double const missing = least - parts.eigenvalues()(k);
    if (missing > 0.0) lifted += missing * parts.eigenvectors().col(k) * parts.eigenvectors().col(k).transpose();
  }
  return lifted;
}
#endif

}  // namespace scarp
