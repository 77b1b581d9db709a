// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/finite_strain.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Any provider that is left out of load steps in which a learned tangent predicts its answer well enough: what was
/// left out adds up, and one response follows all of it when the prediction is no longer trusted. Meant for packings far
/// from where the ground yields. From the provider's last answer sigma the stress is predicted as
/// \f$ \sigma_1 = R\,(\sigma + C : E)\,R^T \f$ with rotation R and strain E of all that was skipped and the increment.
/// C starts as the provider's tangent; every answer corrects it along its strain.
///
/// Whether a point is asked is fixed by `plan` for a whole load step, so that the answer stays smooth while a solver
/// iterates. A prediction that has run to twice the bounds by then is `not_converged` with `extrapolated`; its refined
/// plan asks the provider.
template <CheckedProvider Provider>
struct Lazy {
  static constexpr int dim = Provider::dim;

  struct Plan {
    bool asks = true;        ///< the provider; else its answer is predicted
    PlanOf<Provider> own{};  ///< for all that was skipped and the increment

    /// Steps of inner work; one for a provider that asks for none.
    explicit operator long() const {
      if constexpr (PlansWork<Provider>) {
        return asks ? static_cast<long>(own) : 0;
      } else {
        return asks ? 1 : 0;
      }
    }
  };

  struct State {
    typename Provider::State own;                           ///< as it answered last
    VoigtStress<dim> stress = VoigtStress<dim>::Zero();     ///< [Pa], answered or predicted
    VoigtTangent<dim> tangent = VoigtTangent<dim>::Zero();  ///< C [Pa], in the axes of the last answer
    Gradient<dim> skipped = Gradient<dim>::Zero();          ///< of all increments since
    double missed = 0.0;                                    ///< [Pa] by which C missed an answer,
    double reach = 1.0;          ///< and the strain that it was an answer to, Frobenius norms
    Status status = Status::ok;  ///< of the last answer

    SCARP_MEMBERS(own, stress, tangent, skipped, missed, reach, status)
  };

  Provider provider{};
  double tolerance = 0.01;        ///< error of a predicted stress over the mean pressure; 0 asks always
  double largest_strain = 1e-3;   ///< that is predicted at once
  double loose_pressure = 0.0;    ///< [Pa]; at less the error is judged as at this pressure
  double learning_strain = 1e-5;  ///< answers to less are the noise of a packing and teach nothing
  double memory = 0.5;            ///< share of an earlier error that a better answer leaves

  /// \throws InputError for bounds that are negative or not finite
  void validate() const {
    require_not_negative("tolerance of a predicted stress", tolerance);
    require_positive("largest strain that is predicted", largest_strain);
    require_not_negative("loose pressure", loose_pressure);
    require_positive("strain from which a tangent learns", learning_strain);
    require_not_negative("share of an earlier error that is remembered", memory);
  }

  State initial_state(Site<dim> const& site) const {
    validate();
    typename Provider::State own = provider.initial_state(site);
    VoigtTangent<dim> const tangent = provider.tangent(own);
    VoigtStress<dim> const stress = provider.stress(own);
    // Before the first answer the tangent may be all wrong.
    return {.own = std::move(own), .stress = stress, .tangent = tangent, .missed = tangent.norm()};
  }

  State blank_state(Site<dim> const& site) const { return {.own = scarp::blank_state(provider, site)}; }

  VoigtStress<dim> stress(State const& state) const { return state.stress; }

  /// The provider's; where the last answer was predicted, the learned one.
  VoigtTangent<dim> tangent(State const& state) const {
    return state.skipped.isZero(0.0) ? provider.tangent(state.own) : state.tangent;
  }

  Plan plan(State const& committed, Gradient<dim> const& increment) const {
    Gradient<dim> const total = all_since_answer(committed, increment);
    Plan plan{.asks = !trusted(committed, RotatedIncrement<dim>(total), 1.0)};
    if constexpr (PlansWork<Provider>) plan.own = provider.plan(committed.own, total);
    return plan;
  }

  Plan refined(Plan plan) const {
    if constexpr (PlansWork<Provider>) {
      if (plan.asks) plan.own = provider.refined(plan.own);
    }
    plan.asks = true;
    return plan;
  }

  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }

  /// Verdicts are the provider's where it is asked; see above for predictions.
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial, Plan const& plan) const {
    Gradient<dim> const total = all_since_answer(committed, increment);
    RotatedIncrement<dim> const moved(total);
    if (plan.asks) return asked(committed, total, moved, trial, plan);
    trial = committed;
    if (!moved.verdict.acceptable()) return {committed.stress, moved.verdict};
    trial.skipped = total;
    trial.stress = turned(unturned_prediction(committed, moved), moved.turn);
    bool const believed = trusted(committed, moved, 2.0);
    return {trial.stress, believed ? Verdict{} : Verdict{Status::not_converged, Reason::extrapolated}};
  }

 private:
  static Gradient<dim> all_since_answer(State const& state, Gradient<dim> const& increment) {
    if (state.skipped.isZero(0.0)) return increment;
    return state.skipped + increment + increment * state.skipped;
  }

  bool trusted(State const& state, RotatedIncrement<dim> const& moved, double leniency) const {
    if (tolerance == 0.0 || state.status != Status::ok || !moved.verdict.acceptable()) return false;
    double const pressure = -provider.stress(state.own).template head<dim>().sum() / dim;
    double const strain = moved.strain.norm();
    return strain <= leniency * largest_strain &&
           expected_error(state, strain) <= leniency * tolerance * std::max(pressure, loose_pressure);
  }

  /// [Pa]: up to the strain of an answer that was missed it grows like the strain, as that of a wrong tangent does;
  /// beyond like its square, as curvature does. More than all of the change it hardly is.
  static double expected_error(State const& state, double strain) {
    double const ratio = strain / state.reach;
    return std::min(state.missed * ratio * std::max(1.0, ratio), state.tangent.norm() * strain);
  }

  VoigtStress<dim> unturned_prediction(State const& state, RotatedIncrement<dim> const& moved) const {
    return provider.stress(state.own) + state.tangent * to_engineering_strain<dim, double>(moved.strain);
  }

  static VoigtStress<dim> turned(VoigtStress<dim> const& stress, Tensor<dim> const& turn) {
    Tensor<dim> const result = turn * from_voigt_stress<dim, double>(stress) * turn.transpose();
    return to_voigt_stress<dim, double>(result);
  }

  Response<dim> asked(State const& committed, Gradient<dim> const& total, RotatedIncrement<dim> const& moved,
                      State& trial, Plan const& plan) const {
    Response<dim> const response = respond_as_planned(provider, committed.own, total, trial.own, plan.own);
    trial.stress = response.stress;
    trial.skipped.setZero();
    trial.tangent = committed.tangent;
    trial.missed = committed.missed;
    trial.reach = committed.reach;
    trial.status = response.verdict.status;
    if (tolerance > 0.0 && moved.verdict.acceptable()) learn(committed, moved, response.stress, trial);
    return response;
  }

  /// Broyden's correction of the tangent along the strain, then its turn into the new axes.
  void learn(State const& committed, RotatedIncrement<dim> const& moved, VoigtStress<dim> const& answer,
             State& trial) const {
    double const size = moved.strain.norm();
    if (trial.status == Status::ok && size > learning_strain) {
      EngineeringStrain<dim> const strain = to_engineering_strain<dim, double>(moved.strain);
      Tensor<dim> const back = moved.turn.transpose();
      VoigtStress<dim> const missed = turned(answer, back) - unturned_prediction(committed, moved);
      double const remembered = memory * committed.missed * size / committed.reach;
      trial.missed = std::max(from_voigt_stress<dim, double>(missed).norm(), remembered);
      trial.reach = size;
      trial.tangent += missed * strain.transpose() / strain.squaredNorm();
    }
    trial.tangent = in_turned_axes(trial.tangent, moved.turn);
  }

  /// A tangent that has turned with the material, column by column.
  static VoigtTangent<dim> in_turned_axes(VoigtTangent<dim> const& tangent, Tensor<dim> const& turn) {
    VoigtTangent<dim> result;
    for (int k = 0; k < voigt_size<dim>; ++k) {
      Gradient<dim> const before = turn.transpose() * unit_strain<dim>(k) * turn;
      result.col(k) = turned(tangent * to_engineering_strain<dim, double>(before), turn);
    }
    return result;
  }
};

}  // namespace scarp
