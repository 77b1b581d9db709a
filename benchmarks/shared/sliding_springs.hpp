// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../../examples/shared/sliding_contacts.hpp"
#include "scarp/core/error.hpp"

namespace benchmarks {

/// What contacts at their shear limit contribute to a packing's stiffness.
struct SlidingSprings {
  double shear_share = 0.0;  ///< of the tangential stiffness that stays along the direction of sliding
  bool coupled = false;      ///< the shear force follows the normal force, \f$ dF_t = \mu\,dF_n \f$; not symmetric
  double nearness = 1e-2;    ///< of the shear limit, see `examples::slides`

  /// \throws scarp::InputError for shares out of range
  void validate() const {
    scarp::require_between("share of a sliding contact's tangential stiffness", shear_share, 0.0, 1.0);
    scarp::require_positive("shear force above which contacts count as sliding, as a share,", nearness);
  }

  /// Stiffness S of a contact [N/m]: force on the second grain \f$ df = -S\,du \f$ as it moves relative to the first.
  /// \f$ S = k_n n n^T + k_t (I - n n^T) - (1 - share) (k_t s s^T - \mu k_n s n^T) \f$ with s along the shear force of
  /// a sliding contact; the last term only where coupled.
  template <int Dim, class Law>
  scarp::Tensor<Dim> spring(scarp::Contact<Dim> const& contact, Law const& law) const {
    scarp::Vector<Dim> const n = contact.normal();
    scarp::Tensor<Dim> const across = scarp::Tensor<Dim>::Identity() - n * n.transpose();
    double const normal = contact.stiffness.normal;
    double const tangential = contact.stiffness.tangential;
    scarp::Tensor<Dim> spring = normal * n * n.transpose() + tangential * across;
    if ((shear_share == 1.0 && !coupled) || !examples::slides(contact, law, nearness)) return spring;
    double const lost = 1.0 - shear_share;
    if (!examples::detail::has_shear(contact)) return spring - lost * tangential * across;
    scarp::Vector<Dim> const s = examples::detail::shear_direction(contact);
    spring -= lost * tangential * s * s.transpose();
    if (coupled) spring += lost * normal * contact.shear_force().norm() / contact.normal_force * s * n.transpose();
    return spring;
  }
};

}  // namespace benchmarks
