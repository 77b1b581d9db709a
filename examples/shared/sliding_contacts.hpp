// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Geometry>

#include "scarp/core/index.hpp"
#include "scarp/dem/contacts.hpp"

namespace examples {

namespace detail {

template <int Dim>
bool has_shear(scarp::Contact<Dim> const& contact) {
  constexpr double round_off = 1e-12;
  return contact.shear_force().norm() > round_off * contact.force.norm();
}

/// Any direction in the tangent plane.
template <int Dim>
scarp::Vector<Dim> contact_tangent_direction(scarp::Contact<Dim> const& contact) {
  return contact.normal().unitOrthogonal();  // (-n_y, n_x) in the plane
}

template <int Dim>
scarp::Vector<Dim> shear_direction(scarp::Contact<Dim> const& contact) {
  return has_shear(contact) ? scarp::Vector<Dim>(contact.shear_force().normalized())
                            : contact_tangent_direction(contact);
}

}  // namespace detail

/// Whether a contact is at its shear limit: its law, strained by a little more along the present shear force, carries
/// less than half of that. So an unbroken bond does not slide, whatever Coulomb's limit.
/// nearness: increment of shear force by which the contact is tried, as a share of its force. While grains move,
/// contacts that slide under a growing normal force stand a little below the limit: it grows once more after their last
/// slip.
template <int Dim, class Law>
bool slides(scarp::Contact<Dim> const& contact, Law const& law, double nearness = 1e-2) {
  double const tangential = contact.stiffness.tangential;
  if (!(tangential > 0.0)) return false;
  double const more = nearness * contact.force.norm();
  scarp::Vector<Dim> const direction = detail::shear_direction(contact);
  auto approach = contact.approach;
  auto memory = contact.memory;
  if constexpr (Dim == 2) {
    approach.slip_increment = -more / tangential * direction.dot(detail::contact_tangent_direction(contact));
  } else {
    for (int a = 0; a < Dim; ++a) approach.slip_increment[scarp::detail::index(a)] = -more / tangential * direction(a);
  }
  auto const shear = scarp::as_vector(law.respond(approach, memory).shear, contact.touch.normal);
  return (Eigen::Map<scarp::Vector<Dim> const>(shear.data()) - contact.shear_force()).dot(direction) < 0.5 * more;
}

/// Contacts at their shear limit as a share of all contacts of a packing; zero without contacts.
template <class PackingType>
double sliding_share(PackingType const& packing, typename PackingType::Law const& law) {
  double sliding = 0.0;
  double contacts = 0.0;
  scarp::for_each_contact(packing, law, [&](scarp::Contact<PackingType::dim> const& contact) {
    ++contacts;
    if (slides(contact, law)) ++sliding;
  });
  return contacts > 0.0 ? sliding / contacts : 0.0;
}

}  // namespace examples
