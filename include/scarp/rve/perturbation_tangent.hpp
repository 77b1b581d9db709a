// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/index.hpp"
#include "scarp/dem/time_stepping.hpp"
#include "scarp/homogenise/contact_tangent.hpp"

namespace scarp {

/// Derivative of a packing's stress by trial: a copy is settled, then strained a little in each mode and settled again.
/// The stress is Cauchy's of the strained cell, so that terms of the order of the stress itself are in the tangent.
/// The most exact tangent for its strain and by far the most expensive: some hundred to thousand DEM steps a settling.
/// \tparam Boundary a `ConstrainsGrains`
template <DampsMotion Damping = LocalDamping, class Boundary = Periodic>
struct PerturbationTangent {
  double strain =
      1e-5;  ///< engineering, of each mode; no plateau where contacts slide, see docs/theory/homogenisation.md
  int strain_steps = 20;  ///< time steps that apply it
  double unbalanced_tolerance =
      1e-6;                ///< of settled packings: times the stress it must stay well below stiffness x strain
  int max_steps = 50'000;  ///< of each settling
  int check_every = 50;    ///< steps between looks at the balance
  Damping damping{};       ///< of the trials, whatever damping the packing responds with
  [[no_unique_address]] Boundary boundary{};              ///< as of the packing
  TangentFallback on_fallback = report_tangent_fallback;  ///< called for each tangent that is less exact than requested

  /// \throws InputError for a strain or numbers of steps that are not positive
  void validate() const {
    require_positive("strain of a packing's modes", strain);
    require_at_least("number of steps that strain a packing", strain_steps, 1);
    require_positive("unbalanced tolerance of a settled packing", unbalanced_tolerance);
    require_at_least("most steps of a settling", max_steps, 1);
    require_at_least("number of steps between looks at the balance", check_every, 1);
    detail::validated(damping);
    detail::validated(boundary);
  }

  /// Central differences. What was reached by then is used where a packing does not settle, after `on_fallback` was called.
  template <class PackingType>
  VoigtTangent<PackingType::dim> operator()(PackingType const& packing, typename PackingType::Law const& law) const {
    auto const result = differentiate(packing, law);
    if (!result.verdict.acceptable() && on_fallback != nullptr) {
      on_fallback("a packing did not settle while its tangent was evaluated by perturbation", result.verdict);
    }
    return result.tangent;
  }

  /// `towards`: modes where it is not zero are strained to that side only, since a sliding contact responds to one side
  /// unlike to the other.
  /// \return not_converged / unbalanced when a settling reached its largest number of steps, else what the stepper reports; `steps`
  /// receives the DEM steps taken
  template <class PackingType>
  TangentResult<PackingType::dim> differentiate(
      PackingType const& packing, typename PackingType::Law const& law,
      EngineeringStrain<PackingType::dim> const& towards = EngineeringStrain<PackingType::dim>::Zero(),
      long* steps = nullptr) const {
    validate();
    constexpr int dim = PackingType::dim;
    TangentResult<dim> result{VoigtTangent<dim>::Zero(), {}};
    long taken = 0;
    Trial<PackingType> trial{law, {}};
    trial.stepper.damping = damping;
    trial.stepper.boundary = boundary;
    PackingType base = packing;
    result.verdict = trial.stepper.stop(base, law);
    VoigtStress<dim> const start = trial.settle(*this, base, result.verdict, taken);
    for (int k = 0; k < voigt_size<dim>; ++k) {
      Tensor<dim> const mode = unit_strain<dim>(k);
      auto const strained = [&](double amount) {
        PackingType copy = base;
        return trial.strain(*this, copy, (amount / strain_steps * mode).eval(), result.verdict, taken);
      };
      if (towards(k) == 0.0) {
        result.tangent.col(k) = (strained(strain) - strained(-strain)) / (2.0 * strain);
      } else {
        double const amount = std::copysign(strain, towards(k));
        result.tangent.col(k) = (strained(amount) - start) / amount;
      }
    }
    if (steps != nullptr) *steps = taken;
    return result;
  }

 private:
  template <class PackingType>
  struct Trial {
    static constexpr int dim = PackingType::dim;
    typename PackingType::Law const& law;
    TimeStepper<PackingType, Damping, Boundary> stepper;

    VoigtStress<dim> strain(PerturbationTangent const& how, PackingType& packing, Tensor<dim> const& step,
                            Verdict& verdict, long& taken) {
      stepper.damping = how.damping;  // of every mode alike
      for (int k = 0; k < how.strain_steps; ++k) {
        if (Verdict const moved = stepper.step(packing, law, step); !moved.acceptable()) verdict = moved;
      }
      taken += how.strain_steps;
      if (Verdict const stopped = stepper.stop(packing, law); verdict.acceptable()) verdict = stopped;
      return settle(how, packing, verdict, taken);
    }

    /// Stress [Pa] at the last look. A verdict that is not acceptable stays.
    VoigtStress<dim> settle(PerturbationTangent const& how, PackingType& packing, Verdict& verdict, long& taken) {
      StepObservation<dim> seen;
      for (int step = 0; step < how.max_steps; ++step) {
        Verdict moved;
        if (step % how.check_every == 0) {
          moved = stepper.template step<Observe::balance>(packing, law, Tensor<dim>::Zero(), &seen);
        } else {
          moved = stepper.step(packing, law, Tensor<dim>::Zero());
        }
        ++taken;
        if (!moved.acceptable()) verdict = moved;
        if (!verdict.acceptable() && verdict.reason != Reason::unbalanced) break;
        if (step % how.check_every == 0 && seen.unbalanced_ratio <= how.unbalanced_tolerance) {
          return to_voigt_stress<dim>(seen.stress);
        }
      }
      if (verdict.acceptable()) verdict = {Status::not_converged, Reason::unbalanced};
      return to_voigt_stress<dim>(seen.stress);
    }
  };
};

}  // namespace scarp
