// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Geometry>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/dem/contacts.hpp"

namespace scarp {

/// What contacts at their shear limit contribute to a packing's stiffness. A contact slides when its law, strained by a
/// little more along the present shear force, does not carry it; so an unbroken bond does not slide, whatever Coulomb's limit.
struct SlidingContacts {
  double shear_share = 0.0;  ///< of the tangential stiffness that stays along the direction of sliding
  bool coupled = false;      ///< the shear force follows the normal force, \f$ dF_t = \mu\,dF_n \f$; not symmetric
  /// Increment of shear force by which contacts are tried, as a share of the contact's force. While grains move, contacts that slide under a
  /// growing normal force stand a little below the limit: it grows once more after their last slip.
  double nearness = 1e-2;

  /// \throws InputError for shares out of range
  void validate() const {
    require_between("share of a sliding contact's tangential stiffness", shear_share, 0.0, 1.0);
    require_positive("shear force above which contacts count as sliding, as a share,", nearness);
  }

  /// Whether a contact is at its shear limit: its shear force grows by less than half of a trial increment along it.
  template <int Dim, class Law>
  bool slides(Contact<Dim> const& contact, Law const& law) const {
    double const tangential = contact.stiffness.tangential;
    if (!(tangential > 0.0)) return false;
    double const more = nearness * contact.force.norm();
    Vector<Dim> const direction = shear_direction(contact);
    auto approach = contact.approach;
    auto memory = contact.memory;
    if constexpr (Dim == 2) {
      approach.slip_increment = -more / tangential * direction.dot(tangent(contact));
    } else {
      for (int a = 0; a < Dim; ++a) approach.slip_increment[detail::index(a)] = -more / tangential * direction(a);
    }
    auto const shear = as_vector(law.respond(approach, memory).shear, contact.touch.normal);
    return (Eigen::Map<Vector<Dim> const>(shear.data()) - contact.shear_force()).dot(direction) < 0.5 * more;
  }

  /// Stiffness S of a contact [N/m]: force on the second grain \f$ df = -S\,du \f$ as it moves relative to the first.
  /// \f$ S = k_n n n^T + k_t (I - n n^T) - (1 - share) (k_t s s^T - \mu k_n s n^T) \f$ with s along the shear force of
  /// a sliding contact; the last term only where coupled.
  template <int Dim, class Law>
  Tensor<Dim> spring(Contact<Dim> const& contact, Law const& law) const {
    Vector<Dim> const n = contact.normal();
    Tensor<Dim> const across = Tensor<Dim>::Identity() - n * n.transpose();
    double const normal = contact.stiffness.normal;
    double const tangential = contact.stiffness.tangential;
    Tensor<Dim> spring = normal * n * n.transpose() + tangential * across;
    if ((shear_share == 1.0 && !coupled) || !slides(contact, law)) return spring;
    double const lost = 1.0 - shear_share;
    if (!has_shear(contact)) return spring - lost * tangential * across;
    Vector<Dim> const s = shear_direction(contact);
    spring -= lost * tangential * s * s.transpose();
    if (coupled) spring += lost * normal * contact.shear_force().norm() / contact.normal_force * s * n.transpose();
    return spring;
  }

 private:
  template <int Dim>
  static bool has_shear(Contact<Dim> const& contact) {
    constexpr double round_off = 1e-12;
    return contact.shear_force().norm() > round_off * contact.force.norm();
  }

  /// Any direction in the tangent plane.
  template <int Dim>
  static Vector<Dim> tangent(Contact<Dim> const& contact) {
    return contact.normal().unitOrthogonal();  // (-n_y, n_x) in the plane
  }

  template <int Dim>
  static Vector<Dim> shear_direction(Contact<Dim> const& contact) {
    return has_shear(contact) ? Vector<Dim>(contact.shear_force().normalized()) : tangent(contact);
  }
};

/// Contacts at their shear limit as a share of all contacts of a packing; zero without contacts.
template <class PackingType>
double sliding_share(PackingType const& packing, typename PackingType::Law const& law) {
  double sliding = 0.0;
  double contacts = 0.0;
  for_each_contact(packing, law, [&](Contact<PackingType::dim> const& contact) {
    ++contacts;
    if (SlidingContacts{}.slides(contact, law)) ++sliding;
  });
  return contacts > 0.0 ? sliding / contacts : 0.0;
}

}  // namespace scarp
