// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <memory>

#include "scarp/core/status.hpp"
#include "scarp/solver/linear_system.hpp"

namespace scarp::detail {

/// Forces of a ground that was linearised about an increment.
struct LinearisedGround {
  GroundStiffness stiffness;
  Eigen::VectorXd centre;  ///< that increment [m]
  Eigen::VectorXd forces;  ///< internal forces of the elements less the loads, at the centre [N]

  /// Unbalanced forces [N] when the loads have grown by `more` [N].
  Eigen::VectorXd unbalanced(Eigen::VectorXd const& increment, Eigen::VectorXd const& more) const {
    return forces + stiffness * (increment - centre) - more;
  }
};

/// Balances a linearised ground with the bodies that are attached to it. A program that attaches none compiles none.
class BodyFollowing {
 public:
  virtual ~BodyFollowing() = default;
  /// Whether the contacts of the last evaluation support the bodies in every direction.
  virtual bool is_held() const = 0;
  /// The ground's stiffness with that of the attachment where it was evaluated last.
  virtual Verdict factorize(LinearisedGround const& ground) = 0;
  /// \param increment [m], kept at its prescribed entries
  /// \param more [N] by which the loads have grown since the linearisation
  virtual Verdict follow(LinearisedGround const& ground, Eigen::VectorXd& increment, Eigen::VectorXd const& more) = 0;
};

/// accuracy: residual below which the attachment's forces need no further correction
template <class Problem>
using MakeFollowing = std::unique_ptr<BodyFollowing> (*)(Problem& problem, LinearSystem& system, double accuracy);

}  // namespace scarp::detail
