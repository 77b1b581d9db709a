// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <concepts>

#include "scarp/core/voigt.hpp"

namespace scarp {

/// start(provider, learned): a point's tangent at the start of a step, from the provider's and the one that the step before ended with.
template <class Rule, int Dim>
concept StartsTangent = requires(Rule const& rule, VoigtTangent<Dim> const& tangent) {
  { rule.template start<Dim>(tangent, tangent) } -> std::same_as<VoigtTangent<Dim>>;
};

/// update(tangent, provider, change of strain, change of stress): what an iteration's answer teaches.
template <class Rule, int Dim>
concept LearnsFromAnswers = requires(Rule const& rule, VoigtTangent<Dim> const& tangent,
                                     EngineeringStrain<Dim> const& strain, VoigtStress<Dim> const& stress) {
  { rule.template update<Dim>(tangent, tangent, strain, stress) } -> std::same_as<VoigtTangent<Dim>>;
};

/// at_trial(trial, first): the tangent from that of the provider's trial state; `first` is the one that the run began with.
template <class Rule, int Dim>
concept FollowsTrialTangent = requires(Rule const& rule, VoigtTangent<Dim> const& tangent) {
  { rule.template at_trial<Dim>(tangent, tangent) } -> std::same_as<VoigtTangent<Dim>>;
};

/// Which tangent a point has while a step is iterated.
template <class Rule, int Dim>
concept TangentRule = StartsTangent<Rule, Dim> &&(LearnsFromAnswers<Rule, Dim> || FollowsTrialTangent<Rule, Dim>);

namespace detail {
/// What is missing, in words.
template <class Rule, int Dim>
struct MissingOfTangentRule {
  static_assert(StartsTangent<Rule, Dim>,
                "scarp: a tangent rule needs `template <int Dim> VoigtTangent<Dim> start(VoigtTangent<Dim> const& "
                "provider, VoigtTangent<Dim> const& learned) const`");
  static_assert(LearnsFromAnswers<Rule, Dim> || FollowsTrialTangent<Rule, Dim>,
                "scarp: a tangent rule needs `update<Dim>(tangent, provider, strain, stress) const` or "
                "`at_trial<Dim>(trial, first) const`, which return a VoigtTangent<Dim>");
  static constexpr bool nothing = false;
};
}  // namespace detail

/// The same; of a type that is none the compiler says in words what is missing.
template <class Rule, int Dim>
concept CheckedTangentRule = TangentRule<Rule, Dim> || detail::MissingOfTangentRule<Rule, Dim>::nothing;

}  // namespace scarp
