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
