// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/dem/contacts.hpp"

namespace scarp {

/// Largest stable time step [s] of the explicit scheme, \f$ \Delta t = 2/\omega_{max} \f$, as a lower bound: every grain's
/// mass and inertia is shared out among its near pairs and the stiffest single pair, spin included, bounds the whole packing
/// (element eigenvalue bound of Irons and Treharne 1971). Pairs that may soon touch count as closed. Without any pair, the
/// step of the lightest grain between two others.
template <class PackingType>
double critical_step(PackingType const& packing, typename PackingType::Law const& law) {
  static_assert(PackingType::dim == 2, "arms and spins are written for the plane");
  auto const& population = *packing.population;
  std::vector<double> shares(packing.grain_count(), 0.0);
  std::vector<Contact<2>> contacts;
  for_each_near_pair(packing, law, [&](Contact<2> const& contact) {
    shares[contact.first] += 1.0;
    shares[contact.second] += 1.0;
    contacts.push_back(contact);
  });
  if (contacts.empty()) {
    double lightest = 0.0;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      lightest = std::max(lightest, static_cast<double>(population.inverse_mass()[i]));
    }
    return 2.0 / std::sqrt(4.0 * law.stiffness(0.0).normal * lightest);
  }
  double stiffest = 0.0;  // largest eigenvalue of a contact's stiffness over its share of mass [1/s2]
  for (auto const& contact : contacts) {
    ContactStiffness const stiffness = law.stiffness(contact.touch.overlap);
    double const first = shares[contact.first];
    double const second = shares[contact.second];
    double const masses = first * static_cast<double>(population.inverse_mass()[contact.first]) +
                          second * static_cast<double>(population.inverse_mass()[contact.second]);
    double const inertia_first = first * static_cast<double>(population.inverse_inertia()[contact.first]);
    double const inertia_second = second * static_cast<double>(population.inverse_inertia()[contact.second]);
    auto const& n = contact.touch.normal;
    auto const lever = [&](Point<2, double> const& arm, double x, double y) { return arm[0] * y - arm[1] * x; };
    double const normal_first = lever(contact.touch.arm_first, n[0], n[1]);
    double const normal_second = lever(contact.touch.arm_second, n[0], n[1]);
    double const shear_first = lever(contact.touch.arm_first, -n[1], n[0]);
    double const shear_second = lever(contact.touch.arm_second, -n[1], n[0]);
    // Two springs on one pair: the 2 x 2 problem of their mobilities.
    double const nn = stiffness.normal * (masses + inertia_first * normal_first * normal_first +
                                          inertia_second * normal_second * normal_second);
    double const tt = stiffness.tangential * (masses + inertia_first * shear_first * shear_first +
                                              inertia_second * shear_second * shear_second);
    double const nt = std::sqrt(stiffness.normal * stiffness.tangential) *
                      (inertia_first * normal_first * shear_first + inertia_second * normal_second * shear_second);
    double const mean = (nn + tt) / 2.0;
    stiffest = std::max(stiffest, mean + std::sqrt((nn - tt) * (nn - tt) / 4.0 + nt * nt));
  }
  return 2.0 / std::sqrt(stiffest);
}

}  // namespace scarp
