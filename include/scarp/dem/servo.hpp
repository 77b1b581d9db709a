// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/core/voigt.hpp"
#include "scarp/dem/time_stepping.hpp"

namespace scarp {

/// Component-wise loading of a cell: each symmetric component either follows a stress or a given strain per step.
/// Voigt order; strains per step are tensor components of the (symmetric) velocity gradient x time step.
template <int Dim>
struct ComponentLoading {
  std::array<bool, static_cast<std::size_t>(voigt_size<Dim>)> stress_controlled{};
  VoigtStress<Dim> stress = VoigtStress<Dim>::Zero();  ///< targets [Pa], tension positive
  VoigtStress<Dim> strain_per_step = VoigtStress<Dim>::Zero();

  static ComponentLoading all_stress(VoigtStress<Dim> const& target) {
    ComponentLoading loading;
    loading.stress_controlled.fill(true);
    loading.stress = target;
    return loading;
  }
};

/// Drives stress-controlled components towards their targets: the cell strains in proportion to the missing stress.
struct Servo {
  double fastest = 1e-4;           ///< largest strain per step of a controlled component
  double response_steps = 50.0;    ///< a missing stress is made up in about so many steps
  double stress_tolerance = 1e-4;  ///< relative to the largest target component
  double unbalanced_tolerance = 1e-4;
  long most_steps = 400'000;
  int check_every = 20;  ///< steps between tests of the stopping rule

  /// Cell strain in one step for a missing stress; `modulus` [Pa] is a stiffness scale of the packing. A packing with too
  /// few contacts to be stiff and hardly any pressure is compressed at the fastest rate.
  template <int Dim>
  Tensor<Dim> strain_step(ComponentLoading<Dim> const& loading, Tensor<Dim> const& stress, double modulus,
                          bool jammed) const {
    constexpr double nearly_all = 0.9;  // of the pressure is missing
    VoigtStress<Dim> step = loading.strain_per_step;
    VoigtStress<Dim> const missing = loading.stress - to_voigt_stress<Dim>(stress);
    for (int k = 0; k < voigt_size<Dim>; ++k) {
      if (!loading.stress_controlled[static_cast<std::size_t>(k)]) continue;
      step(k) = std::clamp(missing(k) / (modulus * response_steps), -fastest, fastest);
      if (!jammed && k < Dim && missing(k) < nearly_all * loading.stress(k)) step(k) = -fastest;
    }
    return from_voigt_stress<Dim>(step);
  }

  /// Stiffness scale [Pa] that a law's springs give a packing.
  template <class PackingType>
  double modulus(PackingType const& packing, typename PackingType::Law const& law) const {
    double const length =
        PackingType::dim == 2 ? packing.population->thickness() : 2.0 * packing.population->largest_radius();
    return law.stiffness(0.0).normal / length;
  }

  /// Step by step: strain-controlled components at their rate, stress-controlled ones towards their targets.
  template <class PackingType>
  class Drive {
   public:
    static constexpr int dim = PackingType::dim;
    using Law = typename PackingType::Law;

    Drive(Servo const& servo, PackingType& packing, Law const& law, ComponentLoading<dim> const& loading)
        : servo_(servo),
          packing_(packing),
          law_(law),
          loading_(loading),
          modulus_(servo.modulus(packing, law)),
          // Frictional grains are isostatic at dim + 1 contacts per grain, each shared by two.
          fewest_contacts_(0.5 * (dim + 1) * static_cast<double>(packing.grain_count())) {}

    /// \return failed / not_finite or what the stepper reports
    template <class Stepper>
    Verdict step(Stepper& stepper) {
      Tensor<dim> const strain =
          servo_.strain_step<dim>(loading_, seen_.stress, modulus_, seen_.contacts > fewest_contacts_);
      if (Verdict const verdict = stepper.template step<true>(packing_, law_, strain, &seen_); !verdict.acceptable())
        return verdict;
      if (!seen_.stress.allFinite()) return {Status::failed, Reason::not_finite};
      return {};
    }

    /// The packing as it was before the last move.
    StepObservation<dim> const& seen() const { return seen_; }

   private:
    Servo const& servo_;
    PackingType& packing_;
    Law const& law_;
    ComponentLoading<dim> const& loading_;
    double modulus_;
    double fewest_contacts_;
    StepObservation<dim> seen_;
  };

  /// Moves the packing until the controlled stresses are met and the forces balance.
  /// \return not_converged / unreachable or unbalanced after `most_steps`, or at once for a target no packing can carry
  template <class Stepper, class PackingType>
  Verdict reach(Stepper& stepper, PackingType& packing, typename PackingType::Law const& law,
                ComponentLoading<PackingType::dim> const& loading) const {
    constexpr int dim = PackingType::dim;
    double scale = 0.0;
    for (int k = 0; k < voigt_size<dim>; ++k) {
      if (!loading.stress_controlled[static_cast<std::size_t>(k)]) continue;
      if (k < dim && !(loading.stress(k) < 0.0)) return {Status::not_converged, Reason::unreachable};
      scale = std::max(scale, std::abs(loading.stress(k)));
    }
    Drive<PackingType> drive(*this, packing, law, loading);
    for (long step = 1; step <= most_steps; ++step) {
      if (Verdict const verdict = drive.step(stepper); !verdict.acceptable()) return verdict;
      if (step % check_every != 0) continue;
      VoigtStress<dim> const missing = loading.stress - to_voigt_stress<dim>(drive.seen().stress);
      double worst = 0.0;
      for (int k = 0; k < voigt_size<dim>; ++k) {
        if (loading.stress_controlled[static_cast<std::size_t>(k)]) worst = std::max(worst, std::abs(missing(k)));
      }
      if (worst <= stress_tolerance * scale && drive.seen().unbalanced_ratio <= unbalanced_tolerance) return {};
    }
    return {Status::not_converged,
            drive.seen().unbalanced_ratio > unbalanced_tolerance ? Reason::unbalanced : Reason::unreachable};
  }
};

}  // namespace scarp
