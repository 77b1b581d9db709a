// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>
#include <utility>

#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/core/status.hpp"
#include "scarp/tensor/voigt.hpp"

SCARP_NAMED_MEMBER(empty_state)
SCARP_NAMED_MEMBER(quantities)
SCARP_NAMED_MEMBER(balance)

namespace scarp {

/// Where a material point sits when its state is made.
template <int Dim>
struct Site {
  int index = 0;                               ///< number of the point in its mesh
  int region = 0;                              ///< number of the region in its mesh
  Vector<Dim> position = Vector<Dim>::Zero();  ///< [m]
  double depth = 0.0;                          ///< below the ground surface [m]
  int element = -1;                            ///< number of its element in its mesh, -1 for none
  int place = 0;                               ///< number of the point in its element
  double size = 1.0;  ///< of its element [m]: root of its volume, half of that with nodes between the corners
};

/// \throws InputError for a depth [m] above the ground surface: a material of ground has nothing to carry there
inline void require_below_surface(double depth) {
  constexpr double round_off = 1e-6;
  if (depth < -round_off) {
    reject(
        "a point lies {} m above the ground surface (its depth is to be positive): give the height of the ground's "
        "upper nodes as level of the surface, and lengths upwards in metres",
        -depth);
  }
}

/// Stress and verdict of a material point for an increment.
template <int Dim>
struct [[nodiscard]] Response {
  VoigtStress<Dim> stress = VoigtStress<Dim>::Zero();  ///< Cauchy [Pa] at the end of the increment, tension positive
  Verdict verdict;                                     ///< whether the response may be committed, and why not
};

/// A provider names its state, a copyable type.
template <class Model>
concept HasState = std::copyable<typename Model::State>;

/// A provider names the dimension of its stresses, 2 or 3.
template <class Model>
concept HasDimension = requires {
  requires Model::dim == 2 || Model::dim == 3;
};

/// initial_state(site): the state of a point at rest at a site.
template <class Model>
concept MakesInitialState = HasState<Model> && HasDimension<Model> &&
    requires(Model const& model, Site<Model::dim> const& site) {
  { model.initial_state(site) } -> std::same_as<typename Model::State>;
};

/// respond(committed, increment, trial): pure; `committed` is never touched, `trial` is overwritten.
template <class Model>
concept Responds = HasState<Model> && HasDimension<Model> &&
    requires(Model const& model, typename Model::State const& committed, Gradient<Model::dim> const& increment,
             typename Model::State& trial) {
  { model.respond(committed, increment, trial) } -> std::same_as<Response<Model::dim>>;
};

/// stress(state): the Cauchy stress [Pa] that a state carries.
template <class Model>
concept HasStress = HasState<Model> && HasDimension<Model> &&
    requires(Model const& model, typename Model::State const& state) {
  { model.stress(state) } -> std::same_as<VoigtStress<Model::dim>>;
};

/// tangent(state): stiffness for a further increment from `state`; evaluated only where a solver needs it.
template <class Model>
concept GivesTangent = HasState<Model> && HasDimension<Model> &&
    requires(Model const& model, typename Model::State const& state) {
  { model.tangent(state) } -> std::same_as<VoigtTangent<Model::dim>>;
};

/// A material model at an integration point: immutable parameters plus a copyable state.
template <class Model>
concept ConstitutiveProvider = MakesInitialState<Model> && Responds<Model> && HasStress<Model> && GivesTangent<Model>;

/// A provider whose number of inner steps is fixed for a load step, so that its response stays a smooth function of the
/// increment while the solver iterates: plan(committed, predicted), respond(..., plan). An increment that needs more
/// than `plan_slack` times the planned steps gets a plan of its own. Where a response is `not_converged` in the end,
/// refined(plan) has more inner steps.
template <class Model>
concept HasPlan = ConstitutiveProvider<Model> && requires {
  typename Model::Plan;
} && requires(Model const& model, typename Model::State const& committed, Gradient<Model::dim> const& increment,
              typename Model::State& trial, typename Model::Plan const& plan) {
  { model.plan(committed, increment) } -> std::same_as<typename Model::Plan>;
  { model.refined(plan) } -> std::same_as<typename Model::Plan>;
  { model.respond(committed, increment, trial, plan) } -> std::same_as<Response<Model::dim>>;
};

/// An increment may need so many times the inner steps that were planned for an earlier iterate.
inline constexpr double plan_slack = 1.5;

/// Whether a provider's tangent of a trial state is the derivative of its response, as Newton's method needs it. A
/// provider states it by `static constexpr bool exact_tangent = true`.
template <class Model>
constexpr bool has_exact_tangent() {
  if constexpr (requires { Model::exact_tangent; }) return Model::exact_tangent;
  return false;
}

/// No inner steps are planned.
struct NoPlan {
  /// Number of inner steps: none.
  explicit operator long() const { return 0; }
};

namespace detail {
template <class Model>
struct PlanOf {
  using type = NoPlan;
};
template <HasPlan Model>
struct PlanOf<Model> {
  using type = typename Model::Plan;
};
}  // namespace detail

/// The plan type of a provider; `NoPlan` for one that needs none.
template <class Model>
using PlanOf = typename detail::PlanOf<Model>::type;

/// A provider's response, with the plan where it makes plans.
template <ConstitutiveProvider Model>
Response<Model::dim> respond_as_planned(Model const& model, typename Model::State const& committed,
                                        Gradient<Model::dim> const& increment, typename Model::State& trial,
                                        [[maybe_unused]] PlanOf<Model> const& plan) {
  if constexpr (HasPlan<Model>) {
    return model.respond(committed, increment, trial, plan);
  } else {
    return model.respond(committed, increment, trial);
  }
}

/// One increment of a single point: where the response is acceptable, `state` becomes the one at its end. A response
/// that does not converge is repeated with more inner steps, at most max_refinements times.
template <ConstitutiveProvider Model>
Response<Model::dim> advance(Model const& model, typename Model::State& state, Gradient<Model::dim> const& increment,
                             [[maybe_unused]] int max_refinements = 8) {
  auto trial = state;
  Response<Model::dim> response;
  if constexpr (HasPlan<Model>) {
    auto plan = model.plan(state, increment);
    response = model.respond(state, increment, trial, plan);
    for (int k = 0; k < max_refinements && response.verdict.status == Status::not_converged; ++k) {
      auto more = model.refined(plan);
      if (static_cast<long>(more) == static_cast<long>(plan)) break;
      plan = std::move(more);
      response = model.respond(state, increment, trial, plan);
    }
  } else {
    response = model.respond(state, increment, trial);
  }
  if (response.verdict.acceptable()) state = std::move(trial);
  return response;
}

namespace detail {

/// Names the missing member of a type that is no `ConstitutiveProvider`.
template <class Model>
consteval bool check_provider() {
  static_assert(HasDimension<Model>, "scarp: a provider needs `static constexpr int dim`, 2 or 3");
  static_assert(HasState<Model>, "scarp: a provider needs a type `State` that can be copied");
  if constexpr (HasState<Model> && HasDimension<Model>) {
    static_assert(MakesInitialState<Model>, "scarp: a provider needs `State initial_state(Site<dim> const&) const`");
    static_assert(Responds<Model>,
                  "scarp: a provider needs `Response<dim> respond(State const& committed, Gradient<dim> const& "
                  "increment, State& trial) const`");
    static_assert(HasStress<Model>, "scarp: a provider needs `VoigtStress<dim> stress(State const&) const` [Pa]");
    static_assert(GivesTangent<Model>, "scarp: a provider needs `VoigtTangent<dim> tangent(State const&) const` [Pa]");
  }
  if constexpr (ConstitutiveProvider<Model>) {
    using State = typename Model::State;
    static_assert(
        requires(Model const& model, State const& state) { model.quantities(state); } || !names_quantities<Model>,
        "scarp: quantities of a provider is never called: it needs `Quantities quantities(State const&) const`");
    static_assert(
        requires(Model const& model, State const& state) { model.balance(state); } || !names_balance<Model>,
        "scarp: balance of a provider is never called: it needs `PackingBalance balance(State const&) const`");
    static_assert(
        requires(Model const& model, Site<Model::dim> const& site) { model.empty_state(site); } ||
            !names_empty_state<Model>,
        "scarp: empty_state of a provider is never called: it needs `State empty_state(Site<dim> const&) const`");
    // Providers have these two under constraints: a member whose constraint fails has no address. Neither has one that
    // is overloaded or a template.
    static_assert(
        requires(Model const& model, State const& state) { model.picture(state); } || !requires { &Model::picture; },
        "scarp: picture of a provider is never called: it needs `PackingPicture picture(State const&) const`");
    static_assert(
        HasPlan<Model> || !requires { &Model::plan; },
        "scarp: plan of a provider is never called: it needs `Plan`, `Plan plan(State const&, Gradient<dim> "
        "const&) const`, `Plan refined(Plan const&) const` and a `respond` with `Plan const&` at the end");
  }
  return ConstitutiveProvider<Model>;
}

}  // namespace detail

/// A `ConstitutiveProvider`; for another type the compiler names the missing member.
template <class Model>
concept CheckedProvider = detail::check_provider<Model>();

/// A state that a saved one can be read into, with all that is not saved because it follows from the provider and the
/// site. Providers whose states contain such data return it by `State empty_state(Site<dim> const&) const`, and so do
/// adaptors, for the provider inside.
/// \throws InputError for states that cannot be made so
template <ConstitutiveProvider Provider>
typename Provider::State empty_state([[maybe_unused]] Provider const& provider,
                                     [[maybe_unused]] Site<Provider::dim> const& site) {
  if constexpr (requires { provider.empty_state(site); }) {
    return provider.empty_state(site);
  } else if constexpr (std::default_initializable<typename Provider::State>) {
    return {};
  } else {
    reject(
        "a state cannot be sent to another process (it has no default constructor, and its provider makes no blank "
        "one): give it one");
  }
}

}  // namespace scarp
