// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <concepts>

namespace scarp {

/// next(point, correction): the next iterate.
template <class Mixing>
concept MixesCorrections = requires(Mixing& mixing, Eigen::VectorXd const& vector) {
  { mixing.next(vector, vector) } -> std::same_as<Eigen::VectorXd>;
};

/// next(point, correction, force): the same from the unbalanced forces too [N], which the correction is to balance.
template <class Mixing>
concept MixesForces = requires(Mixing& mixing, Eigen::VectorXd const& vector) {
  { mixing.next(vector, vector, vector) } -> std::same_as<Eigen::VectorXd>;
};

/// What becomes of the corrections that the linear solver gives; forget() starts a new iteration. Vectors hold the free degrees
/// of freedom.
template <class Mixing>
concept MixingRule = std::copyable<Mixing> &&
    (MixesCorrections<Mixing> || MixesForces<Mixing>)&&requires(Mixing& mixing) {
  {mixing.forget()};
};

namespace detail {
/// What is missing, in words.
template <class Mixing>
struct MissingOfMixing {
  static_assert(std::copyable<Mixing>, "scarp: a mixing rule can be copied");
  static_assert(
      MixesCorrections<Mixing> || MixesForces<Mixing>,
      "scarp: a mixing rule needs `Eigen::VectorXd next(point, correction)` or `next(point, correction, force)`");
  static_assert(
      requires(Mixing & mixing) { mixing.forget(); },
      "scarp: a mixing rule needs `void forget()`: a new iteration starts");
  static constexpr bool nothing = false;
};
}  // namespace detail

/// The same; of a type that is none the compiler says in words what is missing.
template <class Mixing>
concept CheckedMixing = MixingRule<Mixing> || detail::MissingOfMixing<Mixing>::nothing;

template <MixingRule Mixing>
Eigen::VectorXd mixed(Mixing& mixing, Eigen::VectorXd const& point, Eigen::VectorXd const& correction,
                      Eigen::VectorXd const& force) {
  if constexpr (MixesForces<Mixing>) {
    return mixing.next(point, correction, force);
  } else {
    return mixing.next(point, correction);
  }
}

}  // namespace scarp
