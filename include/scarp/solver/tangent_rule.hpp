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

}  // namespace scarp
