// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/dem/contacts.hpp"

namespace scarp {

namespace detail {

/// Largest eigenvalue of a contact's stiffness over mobility [1/s2]: its springs along the normal and the tangents act on
/// centres and spins through the arms; a spring against rolling at most adds its own.
/// mobilities: centre of both grains together [1/kg], spin of each [1/(kg m2)]
template <int Dim>
double stiffest_mode(Contact<Dim> const& contact, ContactStiffness const& stiffness, double centres, double spin_first,
                     double spin_second) {
  std::array<Point<Dim, double>, Dim> axes;
  axes[0] = contact.touch.normal;
  if constexpr (Dim == 2) {
    axes[1] = {-axes[0][1], axes[0][0]};
  } else {
    Point<3, double> helper{};
    helper[std::abs(axes[0][0]) < 0.6 ? 0 : 1] = 1.0;
    axes[1] = cross(axes[0], helper);
    double const size = std::sqrt(squared_size(axes[1]));
    for (double& component : axes[1]) component /= size;
    axes[2] = cross(axes[0], axes[1]);
  }
  Tensor<Dim> modes;
  for (int k = 0; k < Dim; ++k) {
    for (int l = 0; l <= k; ++l) {
      auto const& e = axes[static_cast<std::size_t>(k)];
      auto const& f = axes[static_cast<std::size_t>(l)];
      double const springs = std::sqrt((k == 0 ? stiffness.normal : stiffness.tangential) *
                                       (l == 0 ? stiffness.normal : stiffness.tangential));
      modes(k, l) =
          springs *
          ((k == l ? centres : 0.0) +
           spin_first * inner_product(cross(contact.touch.arm_first, e), cross(contact.touch.arm_first, f)) +
           spin_second * inner_product(cross(contact.touch.arm_second, e), cross(contact.touch.arm_second, f)));
    }
  }
  Eigen::SelfAdjointEigenSolver<Tensor<Dim>> solver;
  solver.computeDirect(modes, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(Dim - 1) + stiffness.rolling * (spin_first + spin_second);
}

}  // namespace detail

/// Largest stable time step [s] of the explicit scheme, \f$ \Delta t = 2/\omega_{max} \f$, as a lower bound: every grain's
/// mass and inertia is shared out among its near pairs and the stiffest single pair, spin included, bounds the whole packing
/// (element eigenvalue bound of Irons and Treharne 1971). Pairs that may soon touch count as closed, all as deep as they can
/// get before the list is made anew. Without any pair, the step of the lightest grain between two others.
/// Dashpots of damping ratio \f$ \xi \f$ shorten the step by \f$ \sqrt{1 + \xi^2} - \xi \f$.
template <class PackingType>
double critical_step(PackingType const& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  auto const& population = *packing.population;
  double const deeper = std::max(packing.pairs.skin, 0.0);
  std::vector<double> shares(packing.grain_count(), 0.0);
  std::vector<Contact<dim>> contacts;
  for_each_near_pair(packing, law, [&](Contact<dim> const& contact) {
    shares[contact.first] += 1.0;
    shares[contact.second] += 1.0;
    contacts.push_back(contact);
  });
  double stiffest = 0.0;  // largest eigenvalue of a contact's stiffness over its share of mass [1/s2]
  for (auto const& contact : contacts) {
    double const depth = std::max(contact.touch.overlap, 0.0) + deeper;
    double const first = shares[contact.first];
    double const second = shares[contact.second];
    stiffest = std::max(stiffest, detail::stiffest_mode<dim>(
                                      contact, law.stiffness(depth, contact.approach.reduced_radius),
                                      first * static_cast<double>(population.inverse_mass()[contact.first]) +
                                          second * static_cast<double>(population.inverse_mass()[contact.second]),
                                      first * static_cast<double>(population.inverse_inertia()[contact.first]),
                                      second * static_cast<double>(population.inverse_inertia()[contact.second])));
  }
  if (contacts.empty()) {
    double lightest = 0.0;
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      lightest = std::max(lightest, static_cast<double>(population.inverse_mass()[i]));
    }
    stiffest = 4.0 * law.stiffness(deeper, population.largest_radius()).normal * lightest;
  }
  double const ratio = damping_ratio_of(law);
  return 2.0 / std::sqrt(stiffest) * (std::sqrt(1.0 + ratio * ratio) - ratio);
}

}  // namespace scarp
