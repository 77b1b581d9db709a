// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/constitutive/unwrap.hpp"
#include "scarp/contact/law_checks.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/interruption.hpp"
#include "scarp/dem/drive.hpp"
#include "scarp/dem/mirrored.hpp"
#include "scarp/dem/packing_picture.hpp"
#include "scarp/homogenise/balance.hpp"
#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/homogenise/fabric.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/tensor/finite_strain.hpp"
#include "scarp/tensor/principal.hpp"

namespace scarp {

/// at(site): the packing that a point starts with.
template <class Source, class PackingType>
concept PackingSource = requires(Source const& source, Site<PackingType::dim> const& site) {
  { source.at(site) } -> std::convertible_to<PackingType>;
};

/// A discrete-element packing as constitutive law: the cell follows the increment at a constant velocity gradient
/// (\f$ L = \ln(I + G) \f$ spread over the planned time steps) and the response is Love and Weber's stress at its end.
/// Grains retain their fluctuation velocities, so that steady shearing stays steady from one load step to the next.
/// \tparam PackingType a `Packing`
template <class PackingType, PackingSource<PackingType> Source, PackingTangent<PackingType> Tangent = AffineTangent,
          DampsMotion Damping = LocalDamping, ConstrainsGrains<PackingType> Boundary = Periodic>
struct DemRve {
  static constexpr int dim = PackingType::dim;  ///< of the packing
  using Law = typename PackingType::Law;        ///< contact law of the grains
  using Plan = int;                             ///< DEM time steps of one response

  /// Packing of a point and what its last response had.
  struct State {
    PackingType packing;                                 ///< grains, contacts and cell
    VoigtStress<dim> stress = VoigtStress<dim>::Zero();  ///< [Pa], tension positive
    double unbalanced_ratio = 0.0;                       ///< mean net force of a grain over mean contact force
    double kinetic_share = 0.0;                          ///< of moving grains in the pressure
    double inertial_number = 0.0;                        ///< of the last response
    Verdict verdict{};                                   ///< of the last response

    SCARP_MEMBERS(packing, stress, unbalanced_ratio, kinetic_share, inertial_number, verdict)
  };

  Law law{};                      ///< contact law of all points
  Source source{};                ///< packings that the points start with
  double strain_per_step = 1e-5;  ///< largest principal strain of one DEM step
  double inertial_number =
      5e-3;            ///< largest of one response, \f$ I = \dot\varepsilon d \sqrt{\rho/p} \f$: loose states go slower
  int min_steps = 20;  ///< of one response, however small the increment
  int max_steps = 20'000;              ///< of one response, however large the increment
  double unbalanced_tolerance = 0.05;  ///< of every response
  /// [Pa]; a packing at less, or at less than 1e-6 of its stiffness, is judged and driven as if it carried this much
  double pressure_floor = 0.0;
  double time_step_share = default_time_step_share;  ///< of the critical step's lower bound
  bool fluid_start = false;  ///< whether a point may start with a packing without contacts, see StiffnessFloor
  Damping damping{};         ///< of the grains' motion
  [[no_unique_address]] Boundary boundary{};  ///< which grains follow the mean strain
  Tangent tangent_policy{};                   ///< stiffness of a packing as the provider's tangent

  /// A packing that was listed with another law is listed anew.
  /// \throws InputError for parameters that no response can be made with, and for a packing that carries nothing or
  /// cannot be used
  State initial_state(Site<dim> const& site) const {
    validate();
    State state;
    state.packing = source.at(site);
    if (!state.packing.population) {
      reject("point {} got a packing of zero grains (nothing can carry stress): give the provider's source a packing",
             site.index);
    }
    require_consistent(law, state.packing.population->largest_radius());
    require_positive("stiffness scale [Pa] that the contact law gives the packing", spring_modulus(state.packing, law));
    Stepper stepper;
    stepper.boundary = boundary;
    state.verdict = observe(stepper, state);
    if (state.verdict.status == Status::failed)
      reject("the packing of point {} cannot be used ({}): give the provider's source another one", site.index,
             name(state.verdict.reason));
    if (state.verdict.status == Status::fluid && !fluid_start)
      reject(
          "the packing of point {} has 0 contacts (it carries no stress and has no stiffness): compress it until its "
          "grains touch",
          site.index);
    return state;
  }

  /// For a state that comes from elsewhere; forces that another friction or tangential stiffness has made are kept.
  /// \throws InputError where contacts carry another stress by this law than the state has, since another law has made
  /// it
  void require_fitting(State const& state) const {
    if (!state.packing.population) return;
    Stepper stepper;
    stepper.boundary = boundary;
    State seen = state;
    static_cast<void>(observe(stepper, seen));
    constexpr double round_off = 1e-6;
    if ((seen.stress - state.stress).norm() <= round_off * state.stress.norm() + min_pressure(state.packing)) return;
    reject(
        "the state of a packing has the stress {:.6g}, {:.6g} Pa (xx, yy), but its contacts carry {:.6g}, {:.6g} by "
        "the law of "
        "these points (another law has made it): give a state of points with one law, or prepare a packing with this "
        "one",
        state.stress(0), state.stress(1), seen.stress(0), seen.stress(1));
  }

  /// \throws InputError for parameters that no response can be made with
  void validate() const {
    require_between("strain per DEM step", strain_per_step, 1e-12, 1e-2);
    require_positive("inertial number", inertial_number);
    require_positive("unbalanced tolerance", unbalanced_tolerance);
    require_positive("share of the critical time step", time_step_share);
    require_not_negative("pressure floor", pressure_floor);
    require_at_least("least number of DEM steps of a response", min_steps, 1);
    require_at_least("most DEM steps of a response", max_steps, min_steps);
    detail::validated(damping);
    detail::validated(boundary);
    detail::validated(tangent_policy);
  }

  /// Love and Weber's stress [Pa] at the end of the last response, tension positive.
  VoigtStress<dim> stress(State const& state) const { return state.stress; }

  /// Stiffness [Pa] of the state's packing for engineering strain.
  VoigtTangent<dim> tangent(State const& state) const { return tangent_policy(state.packing, law); }

  /// DEM steps of a response: as many as the strain of one step and the inertial number require, within the bounds.
  Plan plan(State const& committed, Gradient<dim> const& increment) const {
    double const largest = largest_strain(increment);
    if (!std::isfinite(largest)) return min_steps;
    // n time steps of dt make the strain rate largest / (n dt).
    double const steps = std::max(largest / strain_per_step,
                                  largest * inertial_time(committed) / (time_step(committed) * inertial_number));
    return static_cast<int>(
        std::clamp(std::ceil(steps), static_cast<double>(min_steps), static_cast<double>(max_steps)));
  }

  /// Void ratio, in the plane fabrics, coordination and balance.
  Quantities quantities(State const& state) const {
    Quantities quantities{{"void_ratio", state.packing.void_ratio()}};
    auto const network = contact_network(state.packing, law);
    if constexpr (dim == 2) quantities.emplace_back("contact_fabric", fabric_anisotropy(network.fabric));
    quantities.emplace_back("coordination", network.coordination.all);
    quantities.emplace_back("unbalanced_ratio", state.unbalanced_ratio);
    if constexpr (requires { particle_fabric(state.packing); })
      quantities.emplace_back("particle_fabric", fabric_anisotropy(particle_fabric(state.packing)));
    return quantities;
  }

  /// The packing as a drawing needs it.
  auto picture(State const& state) const requires requires { packing_picture(state.packing, law); }
  { return packing_picture(state.packing, law); }

  /// Packings at less than the pressure floor count by their share of it; of one that is fluid there is nothing.
  PackingBalance balance(State const& state) const {
    if (state.verdict.status == Status::fluid) return {};
    double const weight = weight_of(state);
    return {.has_packing = true,
            .unbalanced_ratio = weight * state.unbalanced_ratio,
            .kinetic_share = weight * state.kinetic_share,
            .inertial_number = state.inertial_number};
  }

  /// How much the balance of a packing counts: all, below the pressure floor by its share of that. Tension, of bonds,
  /// counts as much as pressure.
  double weight_of(State const& state) const {
    double const pressure = mean_stress_size(state.stress);
    double const floor = floor_of(state);
    return pressure < floor ? pressure / floor : 1.0;
  }

  /// Writes what was seen of a packing into its state, but for the packing itself. kinetic: sum of the principal values
  /// of the stress that moving grains carry [Pa] \return whether the state may be committed
  Verdict judge(State& state, StepObservation<dim> const& seen, double kinetic) const {
    if (!seen.stress.allFinite()) return {Status::failed, Reason::not_finite};
    state.stress = to_voigt_stress<dim>(seen.stress);
    state.unbalanced_ratio = seen.unbalanced_ratio;
    state.kinetic_share = -kinetic / std::max(std::abs(seen.stress.trace()), min_pressure(state.packing) * dim);
    if (seen.deepest_overlap > 1.0) return {Status::failed, Reason::too_deep};
    if (seen.contacts == 0.0) return {Status::fluid, Reason::no_contacts};
    bool const is_fast = state.inertial_number > 2.0 * inertial_number;
    if (is_fast || !(weight_of(state) * seen.unbalanced_ratio <= unbalanced_tolerance))
      return {Status::not_converged, Reason::unbalanced};
    return {};
  }

  /// Inertial number of a response in so many DEM steps.
  double inertial_number_of(State const& committed, Gradient<dim> const& increment, Plan steps) const {
    return largest_strain(increment) * inertial_time(committed) / (time_step(committed) * steps);
  }

  /// Twice the steps, hence half the rate.
  Plan refined(Plan steps) const { return std::min(2 * steps, max_steps); }

  /// Response to a displacement gradient in as many DEM steps as plan() gives.
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial) const {
    return respond(committed, increment, trial, plan(committed, increment));
  }

  /// A response that is not balanced to the tolerance, or has more than twice the inertial number, is `not_converged`;
  /// refined(plan) is a slower one.
  /// A strain per DEM step of more than `plan_slack` times the limit is `not_converged` with `too_few_steps`.
  /// Fails with `not_finite` on NaN or an increment beyond the logarithm's range, with `cell_collapsed` when the cell
  /// gets too thin for its grains, with `too_deep` when an overlap exceeds the reduced radius of its contact; `fluid`
  /// without contacts.
  Response<dim> respond(State const& committed, Gradient<dim> const& increment, State& trial, Plan steps) const {
    thread_local Stepper stepper;
    stepper.damping = damping;
    stepper.boundary = boundary;
    stepper.time_step_share = time_step_share;
    trial = committed;
    trial.inertial_number = inertial_number_of(committed, increment, steps);
    Tensor<dim> const strain_step = logarithm_of_increment<dim>(increment) / steps;
    trial.verdict = {};
    if (!strain_step.allFinite()) trial.verdict = {Status::failed, Reason::not_finite};
    for (int step = 0; step < steps && trial.verdict.acceptable(); ++step) {
      InterruptionCheck::run();
      trial.verdict = stepper.step(trial.packing, law, strain_step);
    }
    if (trial.verdict.acceptable()) trial.verdict = observe(stepper, trial);
    if (trial.verdict == Verdict{}) trial.verdict = verdict_of_steps(increment, steps);
    return {trial.stress, trial.verdict};
  }

  /// Whether so many DEM steps are enough for an increment.
  Verdict verdict_of_steps(Gradient<dim> const& increment, Plan steps) const {
    if (largest_strain(increment) > plan_slack * strain_per_step * steps)
      return {Status::not_converged, Reason::too_few_steps};
    return {};
  }

 private:
  using Stepper = TimeStepper<PackingType, Damping, Boundary>;

  /// [s], for a packing that was listed with another law as the next step will list it.
  double time_step(State const& state) const {
    auto const& pairs = state.packing.pairs;
    bool const is_ours = pairs.basis.agrees_with(list_basis(state.packing, law, pairs.skin));
    return time_step_share * (is_ours ? pairs.critical_step : critical_step(state.packing, law));
  }

  static double largest_strain(Gradient<dim> const& increment) {
    return largest_principal<dim>((increment + increment.transpose()) / 2.0);
  }

  /// \f$ d \sqrt{\rho/p} \f$ [s]: the time in which the pressure moves a grain by its size.
  double inertial_time(State const& state) const {
    auto const& population = *state.packing.population;
    double const pressure = std::max(mean_stress_size(state.stress), floor_of(state));
    return 2.0 * population.largest_radius() * std::sqrt(population.density() / pressure);
  }

  /// Packings at less than a millionth of their stiffness are judged and driven as if they carried that.
  double floor_of(State const& state) const {
    return std::max(pressure_floor, 1e-6 * spring_modulus(state.packing, law));
  }

  /// Pressure [Pa] that counts as none: 1e-9 for the reference study's sand, and scaled alike in other units.
  double min_pressure(PackingType const& packing) const { return 3e-17 * spring_modulus(packing, law); }

  static double mean_stress_size(VoigtStress<dim> const& stress) {
    return std::abs(stress.template head<dim>().sum()) / dim;
  }

  Verdict observe(Stepper& stepper, State& state) const {
    StepObservation<dim> seen;
    if (Verdict const verdict = stepper.observe(state.packing, law, seen); !verdict.acceptable()) return verdict;
    return judge(state, seen, kinetic_stress(state.packing).trace());
  }
};

namespace detail {
/// The packing that a source has for a site.
template <int Dim, class Source>
auto packing_from(Source const& source, Site<Dim> const& site) -> std::remove_cvref_t<decltype(source.at(site))>;
}  // namespace detail

/// DemRve{law, source}: the packings of a source, such as `PackingsByDepth` or `RandomPackings`.
template <class Source>
DemRve(auto, Source) -> DemRve<decltype(detail::packing_from<2>(std::declval<Source const&>(), {})), Source>;
template <class Source>
DemRve(auto, Source const&) -> DemRve<decltype(detail::packing_from<3>(std::declval<Source const&>(), {})), Source>;

/// DemRve{law, packing}: one packing for all points.
template <class PackingType>
DemRve(typename PackingType::Law, PackingType) -> DemRve<PackingType, SamePacking<PackingType>>;

}  // namespace scarp
