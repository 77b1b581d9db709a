// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// Which configuration a step is measured from and balanced in, and what follows for the stiffness.
/// `follows_motion`: commits move the configuration that gradients refer to, and forces are balanced in the
/// configuration at the end of the increment.
template <class Policy>
concept HasConfiguration = requires {
  { Policy::follows_motion } -> std::convertible_to<bool>;
};

/// seen(gradient): the part of a displacement gradient that the material is driven by.
template <class Policy>
concept FiltersGradient = requires(Gradient<2> const& plane, Gradient<3> const& space) {
  { Policy::template material_gradient<2>(plane) } -> std::same_as<Gradient<2>>;
  { Policy::template material_gradient<3>(space) } -> std::same_as<Gradient<3>>;
};

/// flux_change(L, stress, tangent): change of what the internal force integrates against the shape gradients, per
/// volume, for a further displacement gradient L in the configuration that forces are balanced in.
template <class Policy>
concept GivesFluxChange = requires(Gradient<2> const& further, VoigtStress<2> const& stress,
                                   VoigtTangent<2> const& tangent) {
  { Policy::template flux_change<2>(further, stress, tangent) } -> std::same_as<Tensor<2>>;
};

/// Strain of a load step from its displacement gradient, and the configuration that forces are summed in.
template <class Policy>
concept Kinematics = HasConfiguration<Policy> && FiltersGradient<Policy> && GivesFluxChange<Policy>;

/// Large displacements and rotations. The increment's gradient refers to the configuration at the start of the step;
/// \f$ f_a = \int_v \sigma \nabla N_a\,dv \f$ is integrated over the one at its end.
struct UpdatedLagrangian {
  static constexpr bool follows_motion = true;

  /// The whole gradient: the material sees the rotation too.
  template <int Dim>
  static Gradient<Dim> material_gradient(Gradient<Dim> const& gradient) {
    return gradient;
  }

  /// Variation of \f$ \int \sigma \nabla N\,dv \f$ with the co-rotational stress change
  /// \f$ \delta\sigma = C : L + W\sigma - \sigma W,\; W = (L - L^T)/2 \f$, of the volume and of the gradients:
  /// \f$ C : L + W\sigma - \sigma W + tr(L)\sigma - \sigma L^T \f$
  /// The first term is the material part; the others are the geometric part, which need not be symmetric.
  template <int Dim>
  static Tensor<Dim> flux_change(Gradient<Dim> const& further, VoigtStress<Dim> const& stress,
                                 VoigtTangent<Dim> const& tangent) {
    VoigtStress<Dim> const material = tangent * to_engineering_strain<Dim, double>(further);
    Tensor<Dim> const carried = from_voigt_stress<Dim, double>(stress);
    Tensor<Dim> const spin = (further - further.transpose()) / 2.0;
    return from_voigt_stress<Dim, double>(material) + spin * carried - carried * spin + further.trace() * carried -
           carried * further.transpose();
  }
};

/// Displacements too small to change geometry or turn stress: everything refers to the initial configuration.
struct SmallStrain {
  static constexpr bool follows_motion = false;

  /// The symmetric part: the rotation would turn the stress.
  template <int Dim>
  static Gradient<Dim> material_gradient(Gradient<Dim> const& gradient) {
    return (gradient + gradient.transpose()) / 2.0;
  }

  /// Change of stress [Pa] by the tangent alone: geometry and stress do not turn.
  template <int Dim>
  static Tensor<Dim> flux_change(Gradient<Dim> const& further, VoigtStress<Dim> const&,
                                 VoigtTangent<Dim> const& tangent) {
    VoigtStress<Dim> const material = tangent * to_engineering_strain<Dim, double>(further);
    return from_voigt_stress<Dim, double>(material);
  }
};

static_assert(Kinematics<UpdatedLagrangian>);
static_assert(Kinematics<SmallStrain>);

}  // namespace scarp
