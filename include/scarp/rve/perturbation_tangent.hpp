// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/homogenise/contact_tangent.hpp"

namespace scarp {

/// Derivative of a packing's stress by trial: a copy comes to rest, is strained a little in each mode and comes to rest
/// again.
/// The stress is Cauchy's of the strained cell, so that terms of the order of the stress itself are in the tangent.
/// The most exact tangent for its strain and by far the most expensive: some hundred to thousand DEM steps a settling.
/// \tparam Boundary a `ConstrainsGrains`
template <DampsMotion Damping = LocalDamping, class Boundary = Periodic>
struct PerturbationTangent {
  double strain =
      1e-5;  ///< engineering, of each mode; no plateau where contacts slide, see docs/theory/homogenisation.md
  int strain_steps = 20;  ///< time steps that apply it
  double unbalanced_tolerance =
      1e-6;                ///< of packings at rest: times the stress it must stay well below stiffness x strain
  int max_steps = 50'000;  ///< of each settling
  int check_every = 50;    ///< steps between looks at the balance
  Damping damping{};       ///< of the trials, whatever damping the packing responds with
  [[no_unique_address]] Boundary boundary{};              ///< as of the packing
  TangentFallback on_fallback = report_tangent_fallback;  ///< called for each tangent that is less exact than requested

  /// \throws InputError for a strain or numbers of steps that are not positive
  void validate() const {
    require_positive("strain of a packing's modes", strain);
    require_at_least("number of steps that strain a packing", strain_steps, 1);
    require_positive("unbalanced tolerance of a packing at rest", unbalanced_tolerance);
    require_at_least("most steps of a settling", max_steps, 1);
    require_at_least("number of steps between looks at the balance", check_every, 1);
    detail::validated(damping);
    detail::validated(boundary);
  }

  /// Central differences. What was reached by then is used where a packing does not come to rest, after `on_fallback`
  /// was called.
  template <class PackingType>
  VoigtTangent<PackingType::dim> operator()(PackingType const& packing, typename PackingType::Law const& law) const {
    auto const result = differentiate(packing, law);
    if (!result.verdict.acceptable() && on_fallback != nullptr) {
      on_fallback("a packing did not come to rest while its tangent was evaluated by perturbation", result.verdict);
    }
    return result.tangent;
  }

  /// `towards`: modes where it is not zero are strained to that side only, since a sliding contact responds to one side
  /// unlike to the other.
  /// \return not_converged / unbalanced when a settling reached its largest number of steps, else what the stepper
  /// reports; `steps` receives the DEM steps taken
  template <class PackingType>
  TangentResult<PackingType::dim> differentiate(
      PackingType const& packing, typename PackingType::Law const& law,
      EngineeringStrain<PackingType::dim> const& towards = EngineeringStrain<PackingType::dim>::Zero(),
      long* steps = nullptr) const {
    validate();
    constexpr int dim = PackingType::dim;
    TangentResult<dim> result{VoigtTangent<dim>::Zero(), {}};
    Verdict& verdict = result.verdict;  // one that is not acceptable stays
    long taken = 0;
    TimeStepper<PackingType, Damping, Boundary> stepper;
    stepper.damping = damping;
    stepper.boundary = boundary;
    auto const stress_at_rest = [&](PackingType& grains) {
      StepObservation<dim> seen;
      for (int step = 0; step < max_steps; ++step) {
        bool const looks = step % check_every == 0;
        Verdict const moved = looks ? stepper.template step<Observe::balance>(grains, law, Tensor<dim>::Zero(), &seen)
                                    : stepper.step(grains, law, Tensor<dim>::Zero());
        ++taken;
        if (!moved.acceptable()) verdict = moved;
        if (!verdict.acceptable() && verdict.reason != Reason::unbalanced) break;
        if (looks && seen.unbalanced_ratio <= unbalanced_tolerance) return to_voigt_stress<dim>(seen.stress);
      }
      if (verdict.acceptable()) verdict = {Status::not_converged, Reason::unbalanced};
      return to_voigt_stress<dim>(seen.stress);
    };
    PackingType base = packing;
    verdict = stepper.stop(base, law);
    VoigtStress<dim> const start = stress_at_rest(base);
    for (int k = 0; k < voigt_size<dim>; ++k) {
      auto const stress_at = [&](double amount) -> VoigtStress<dim> {
        PackingType grains = base;
        Tensor<dim> const step = amount / strain_steps * unit_strain<dim>(k);
        stepper.damping = damping;  // of every mode alike
        for (int each = 0; each < strain_steps; ++each) {
          if (Verdict const moved = stepper.step(grains, law, step); !moved.acceptable()) verdict = moved;
        }
        taken += strain_steps;
        if (Verdict const stopped = stepper.stop(grains, law); verdict.acceptable()) verdict = stopped;
        return stress_at_rest(grains);
      };
      if (towards(k) == 0.0) {
        result.tangent.col(k) = (stress_at(strain) - stress_at(-strain)) / (2.0 * strain);
      } else {
        double const amount = std::copysign(strain, towards(k));
        result.tangent.col(k) = (stress_at(amount) - start) / amount;
      }
    }
    if (steps != nullptr) *steps = taken;
    return result;
  }
};

}  // namespace scarp
