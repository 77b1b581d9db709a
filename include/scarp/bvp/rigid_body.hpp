// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>

#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// How a degree of freedom moves a place: derivative of the position with respect to it.
struct DofJacobian {
  int dof = -1;                             ///< number of the degree of freedom, -1 for none
  Vector<2> direction = Vector<2>::Zero();  ///< dimensionless
};

/// A rigid body in the plane with three degrees of freedom in addition to those of a mesh: the displacement of its
/// reference point along x and y [m] and its rotation times `arm`, counter-clockwise [m], so that all three are lengths
/// and their forces newtons.
class RigidBody {
 public:
  static constexpr int extra_dofs = 3;
  static constexpr int jacobians = 3;  ///< degrees of freedom that move a place of the body

  /// reference [m]: the point that loads act on; arm [m]: such as half the width
  /// \throws InputError for an arm that is not finite and positive
  RigidBody(Vector<2> const& reference, double arm) : reference_(reference), arm_(require_positive("arm", arm)) {}

  /// Committed place of the reference point [m] and rotation [rad], counter-clockwise.
  Vector<2> const& reference() const { return reference_; }
  /// Committed rotation [rad], counter-clockwise.
  double rotation() const { return angle_; }

  /// Where a place of the body, given relative to the reference point before any rotation [m], is now.
  Vector<2> place(Vector<2> const& own) const { return reference_ + scarp::rotation(angle_) * own; }

  /// The place [m] after an increment [m] of the body's degrees of freedom, which begin at `first`.
  Vector<2> place(Vector<2> const& own, Eigen::VectorXd const& increment, int first) const {
    return reference_ + increment.segment<2>(first) + turned(increment(first + 2)) * own;
  }

  /// A direction of the body after an increment [m] of its degrees of freedom, which begin at `first`.
  Vector<2> turned(Vector<2> const& own, Eigen::VectorXd const& increment, int first) const {
    return turned(increment(first + 2)) * own;
  }

  /// Derivatives of a place of the body [m], at an increment [m], by its degrees of freedom, which begin at `first`.
  std::array<DofJacobian, jacobians> jacobians_at(Vector<2> const& own, Eigen::VectorXd const& increment,
                                                  int first) const {
    Vector<2> const arm = turned(increment(first + 2)) * own;
    return {{{first, Vector<2>::UnitX()},
             {first + 1, Vector<2>::UnitY()},
             {first + 2, Vector<2>(-arm.y(), arm.x()) / arm_}}};
  }

  /// Makes the place after an increment [m] the committed one; the body's degrees of freedom begin at `first`.
  void commit(Eigen::VectorXd const& increment, int first) {
    reference_ += increment.segment<2>(first);
    angle_ += increment(first + 2) / arm_;
  }

  SCARP_MEMBERS_EXCEPT((arm_), reference_, angle_)

 private:
  Tensor<2> turned(double along_arm) const { return scarp::rotation(angle_ + along_arm / arm_); }

  Vector<2> reference_;
  double arm_;
  double angle_ = 0.0;
};

}  // namespace scarp
