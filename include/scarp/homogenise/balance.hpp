// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/dem/packing.hpp"
#include "scarp/homogenise/sliding_contacts.hpp"

namespace scarp {

/// Stress and equilibrium of a packing, from one pass over its contacts.
template <int Dim>
struct Balance {
  Tensor<Dim> stress =
      Tensor<Dim>::Zero();   ///< Love and Weber, \f$ \sigma = -\frac1V \sum f \otimes l \f$ [Pa], tension positive
  std::size_t contacts = 0;  ///< number of touching pairs
  double mean_contact_force = 0.0;     ///< [N]
  double mean_unbalanced_force = 0.0;  ///< mean over the grains of |sum of forces| [N]
  double unbalanced_ratio = 0.0;       ///< mean unbalanced over mean contact force; zero without contacts
  double sliding_share = 0.0;          ///< contacts at their shear limit, as a share of all
  double deepest_overlap = 0.0;        ///< [m]
};

/// \throws InputError for a packing without contacts; what: names it
inline void require_contacts(std::string_view what, std::size_t contacts) {
  if (contacts == 0)
    reject("{} has 0 contacts (it carries no stress and has no stiffness): compress it until its grains touch", what);
}

/// Love and Weber's mean stress, with f the force on the second grain and l the branch from first to second; forces of dashpots
/// are not in it.
template <class PackingType>
Balance<PackingType::dim> balance(PackingType const& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  Balance<dim> result;
  std::vector<Vector<dim>> net(packing.grain_count(), Vector<dim>::Zero());
  double sum = 0.0;
  for_each_contact(packing, law, [&](Contact<dim> const& contact) {
    ++result.contacts;
    result.stress -= contact.force * contact.branch.transpose();
    net[contact.first] -= contact.force;
    net[contact.second] += contact.force;
    sum += contact.force.norm();
    result.deepest_overlap = std::max(result.deepest_overlap, contact.touch.overlap);
    if (SlidingContacts{}.slides(contact, law)) result.sliding_share += 1.0;
  });
  result.stress /= packing.volume();
  if (result.contacts == 0) return result;
  double unbalanced = 0.0;
  for (auto const& force : net) unbalanced += force.norm();
  result.mean_unbalanced_force = unbalanced / static_cast<double>(net.size());
  result.mean_contact_force = sum / static_cast<double>(result.contacts);
  result.unbalanced_ratio = result.mean_unbalanced_force / result.mean_contact_force;
  result.sliding_share /= static_cast<double>(result.contacts);
  return result;
}

/// The part of the stress that moving grains carry, \f$ -\frac1V \sum m\, v \otimes v \f$ with the fluctuation velocities
/// [Pa], tension positive. Apart from Love and Weber's, to which it is small in a quasi-static packing.
template <class PackingType>
Tensor<PackingType::dim> kinetic_stress(PackingType const& packing) {
  constexpr int dim = PackingType::dim;
  Tensor<dim> sum = Tensor<dim>::Zero();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    Vector<dim> velocity;
    for (int a = 0; a < dim; ++a) velocity(a) = static_cast<double>(packing.velocity(i, a));
    sum -= velocity * velocity.transpose() / static_cast<double>(packing.population->inverse_mass()[i]);
  }
  return sum / packing.volume();
}

}  // namespace scarp
