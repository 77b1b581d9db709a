// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "scarp/solver/tangent_rule.hpp"

namespace scarp {

/// Tangents that learn at every material point: each iteration's change of strain and stress corrects the point's tangent by
/// Broyden's rank-one update, so that thousands of points gather curvature at once where a global quasi-Newton method gathers
/// one direction. A step starts from a mix of the provider's tangent and what the last step has learned.
/// The symmetric part is kept above a floor, without which softening makes the system indefinite.
struct PointSecant {
  double provider_share = 0.5;        ///< of the provider's tangent in the start of a step; the rest is learned
  double floor = 0.02;                ///< least eigenvalue, relative to the mean diagonal of the provider's tangent
  double least_strain_change = 1e-7;  ///< a smaller change teaches nothing but noise

  /// Start of a step from the provider's tangent and the one learned in the step before.
  template <int Dim>
  VoigtTangent<Dim> start(VoigtTangent<Dim> const& provider, VoigtTangent<Dim> const& learned) const {
    return provider_share * provider + (1.0 - provider_share) * learned;
  }

  template <int Dim>
  VoigtTangent<Dim> update(VoigtTangent<Dim> tangent, VoigtTangent<Dim> const& provider,
                           EngineeringStrain<Dim> const& strain_change, VoigtStress<Dim> const& stress_change) const {
    double const squared = strain_change.squaredNorm();
    if (!(squared > least_strain_change * least_strain_change)) return tangent;
    tangent += (stress_change - tangent * strain_change) * strain_change.transpose() / squared;
    return raised<Dim>(tangent, floor * provider.trace() / voigt_size<Dim>);
  }

 private:
  template <int Dim>
  static VoigtTangent<Dim> raised(VoigtTangent<Dim> const& tangent, double least) {
    Eigen::SelfAdjointEigenSolver<VoigtTangent<Dim>> const parts((tangent + tangent.transpose()) / 2.0);
    VoigtTangent<Dim> lifted = tangent;
    for (int k = 0; k < voigt_size<Dim>; ++k) {
      double const missing = least - parts.eigenvalues()(k);
      if (missing > 0.0) lifted += missing * parts.eigenvectors().col(k) * parts.eigenvectors().col(k).transpose();
    }
    return lifted;
  }
};

static_assert(TangentRule<PointSecant, 2> && TangentRule<PointSecant, 3>);

}  // namespace scarp
