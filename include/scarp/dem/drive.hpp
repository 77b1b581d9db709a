// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/core/interruption.hpp"
#include "scarp/dem/loading.hpp"
#include "scarp/dem/time_stepping.hpp"

namespace scarp {

/// Gains of the servo control, how a cell responds to a missing stress: it strains in proportion, and where a strain is
/// prescribed as well also at a steady rate that is learned on the way, so that the held stress does not lag behind.
struct ServoGains {
  double fastest = 1e-4;         ///< largest strain per step of a held stress
  double response_steps = 10.0;  ///< a missing stress is made up in about so many steps
  /// Response steps after which the steady rate has learned; 16 damps the loop critically where the packing has a
  /// quarter of its springs' modulus.
  double learning_steps = 16.0;

  /// \throws InputError
  void validate() const {
    require_positive("largest strain per step of a held stress", fastest);
    require_positive("response steps of a held stress", response_steps);
    require_positive("learning steps of a held stress", learning_steps);
  }

  /// Cell strain in one step; `modulus` [Pa] is a stiffness scale of the packing, `steady` holds the learned rates, one
  /// for each control. A packing with too few contacts to be stiff and hardly any pressure is compressed at the fastest
  /// rate.
  template <int Dim>
  Tensor<Dim> strain_step(Loading<Dim> const& loading, Tensor<Dim> const& stress, double modulus, bool jammed,
                          std::vector<double>& steady) const {
    constexpr double nearly_all = 0.9;  // of the pressure is missing
    bool const learns = !loading.gradient_per_step.isZero(0.0);
    steady.resize(loading.controls.size(), 0.0);
    Tensor<Dim> step = loading.gradient_per_step;
    for (std::size_t k = 0; k < steady.size(); ++k) {
      auto const& control = loading.controls[k];
      double const missing = control.missing(stress);
      double const correction = missing / (modulus * response_steps);
      double const most = fastest / control.direction.cwiseAbs().maxCoeff();
      if (learns) {
        steady[k] = std::clamp(steady[k] + correction / (learning_steps * response_steps), -most, most);
      }
      double size = std::clamp(correction + steady[k], -most, most);
      if (!jammed && control.direction.trace() > 0.0 && control.target < 0.0 && missing < nearly_all * control.target)
        size = -most;
      step += size * control.direction;
    }
    return step;
  }
};

namespace detail {

/// Length [m] over which a contact's springs act as a stiffness scale of the packing: in the plane its thickness.
template <class PackingType>
double depth_of_contacts(PackingType const& packing) {
  return PackingType::dim == 2 ? packing.population->thickness() : 2.0 * packing.population->largest_radius();
}

/// Whether grains of a law may pull at each other.
template <class Law>
bool pulls(Law const& law) {
  return Bonds<Law> || interaction_range_of(law) > 0.0;
}

/// A law's springs at an overlap of a thousandth of the radius; which one matters only where the stiffness depends on
/// it.
template <class PackingType>
ContactStiffness slight_springs(PackingType const& packing, typename PackingType::Law const& law) {
  require_population(packing);
  double const radius = packing.population->largest_radius();
  return law.stiffness(1e-3 * radius, radius / 2.0);
}

}  // namespace detail

/// Stiffness scale [Pa] that a law's springs give a packing at a small overlap.
template <class PackingType>
double spring_modulus(PackingType const& packing, typename PackingType::Law const& law) {
  return detail::slight_springs(packing, law).normal / detail::depth_of_contacts(packing);
}

/// Viscosity scale [Pa s] of a law's dashpots, 0 without: over the time step it is their stiffness against a strain in
/// one step.
template <class PackingType>
double dashpot_modulus(PackingType const& packing, typename PackingType::Law const& law) {
  double const ratio = damping_ratio_of(law);
  if (ratio == 0.0) return 0.0;
  auto const* const lightness = packing.population->inverse_mass();
  double const heaviest = 1.0 / static_cast<double>(*std::min_element(lightness, lightness + packing.grain_count()));
  auto const springs = detail::slight_springs(packing, law);
  return detail::dashpots_of(springs, ratio, heaviest / 2.0).normal / detail::depth_of_contacts(packing);
}

/// Applies a loading to a packing, one DEM step at a time. Stress is evaluated once before the first step.
/// \tparam PackingType a `Packing`
/// \tparam what at least Observe::balance
template <class PackingType, Observe what = Observe::balance>
  requires(what != Observe::nothing)
class CellDriver {
 public:
  static constexpr int dim = PackingType::dim;  ///< of the packing's space
  using Law = typename PackingType::Law;        ///< of the contacts

  /// The packing must outlive the driver.
  /// \throws InputError for a loading or gains that their validate() rejects, and for a packing without grains
  CellDriver(PackingType& packing, Law const& law, Loading<dim> const& loading, ServoGains const& feedback = {})
      : packing_(packing),
        law_(law),
        loading_(detail::validated(loading)),
        feedback_(detail::validated(feedback)),
        springs_(spring_modulus(packing, law)),
        dashpots_(dashpot_modulus(packing, law)),
        // Frictional grains are isostatic at dim + 1 contacts per grain, each shared by two.
        fewest_contacts_(0.5 * (dim + 1) * static_cast<double>(packing.grain_count())) {}

  /// One DEM step with the cell strain that the loading and the stress before it require.
  /// \return not_converged / unreachable for a target no packing can carry, failed / not_finite, or what the stepper
  /// reports
  template <class Stepper>
  Verdict step(Stepper& stepper) {
    if (!loading_.reachable(detail::pulls(law_))) return {Status::not_converged, Reason::unreachable};
    if (!looked_ && !loading_.controls.empty()) {
      if (Verdict const verdict = stepper.observe(packing_, law_, seen_); !verdict.acceptable()) return verdict;
    }
    looked_ = true;
    strain_step_ =
        feedback_.strain_step<dim>(loading_, seen_.stress, modulus(), seen_.contacts > fewest_contacts_, steady_);
    if (Verdict const verdict = stepper.template step<what>(packing_, law_, strain_step_, &seen_);
        !verdict.acceptable())
      return verdict;
    if (!seen_.stress.allFinite()) return {Status::failed, Reason::not_finite};
    return {};
  }

  /// Another loading from the next step on; what was learned of the rates of the former one is forgotten.
  /// \throws InputError for one that its validate() rejects
  void load(Loading<dim> const& loading) {
    loading_ = detail::validated(loading);
    steady_.clear();
  }
  /// The loading that the next step follows.
  Loading<dim> const& loading() const { return loading_; }

  /// The packing as it was before the last move, and the cell's displacement gradient during that move.
  StepObservation<dim> const& seen() const { return seen_; }
  /// Displacement gradient of the cell during the last move.
  Tensor<dim> const& strain_step() const { return strain_step_; }

 private:
  double modulus() const { return dashpots_ > 0.0 ? springs_ + dashpots_ / packing_.pairs.critical_step : springs_; }

  PackingType& packing_;
  Law law_;
  Loading<dim> loading_;
  ServoGains feedback_;
  double springs_;   ///< [Pa]
  double dashpots_;  ///< [Pa s]
  double fewest_contacts_;
  bool looked_ = false;
  std::vector<double> steady_;
  StepObservation<dim> seen_;
  Tensor<dim> strain_step_ = Tensor<dim>::Zero();
};

/// Servo control: drives a packing until its held stresses are met and its forces balance.
struct Servo {
  ServoGains feedback{};               ///< strain rates that stress errors give
  double stress_tolerance = 1e-4;      ///< relative to the largest target, to 0.001 of the springs' modulus for none
  double unbalanced_tolerance = 1e-4;  ///< on the unbalanced ratio
  long max_steps = 400'000;            ///< until the servo gives up as `not_converged`
  int check_every = 20;                ///< steps between tests of the stopping rule

  /// \throws InputError
  void validate() const {
    feedback.validate();
    require_positive("stress tolerance of the servo", stress_tolerance);
    require_positive("unbalanced tolerance of the servo", unbalanced_tolerance);
    require_at_least("step limit of the servo", max_steps, 1L);
    require_at_least("number of steps between checks of the servo", check_every, 1);
  }

  /// Steps until held stresses and unbalanced ratio are within their tolerances.
  /// \return not_converged / unreachable or unbalanced after `max_steps`, or at once for a target no packing can carry;
  /// failed / too_deep for grains that have passed through each other
  template <class Stepper, class PackingType>
  Verdict reach(Stepper& stepper, PackingType& packing, typename PackingType::Law const& law,
                Loading<PackingType::dim> const& loading) const {
    validate();
    loading.validate();
    if (!loading.reachable(detail::pulls(law))) return {Status::not_converged, Reason::unreachable};
    constexpr double slight = 1e-3;  // of the springs, where no stress at all is prescribed
    double const prescribed = loading.stress_scale();
    double const tolerance = stress_tolerance * (prescribed > 0.0 ? prescribed : slight * spring_modulus(packing, law));
    CellDriver<PackingType> drive(packing, law, loading, feedback);
    for (long step = 1; step <= max_steps; ++step) {
      InterruptionCheck::run();
      if (Verdict const verdict = drive.step(stepper); !verdict.acceptable()) return verdict;
      if (step % check_every != 0 && step != max_steps) continue;
      if (drive.seen().deepest_overlap > 1.0) return {Status::failed, Reason::too_deep};  // of the reduced radius
      if (loading.worst_missing(drive.seen().stress) <= tolerance &&
          drive.seen().unbalanced_ratio <= unbalanced_tolerance)
        return {};
    }
    return {Status::not_converged,
            drive.seen().unbalanced_ratio > unbalanced_tolerance ? Reason::unbalanced : Reason::unreachable};
  }
};

}  // namespace scarp
