// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scarp/core/index.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/tensor/principal.hpp"

namespace scarp {

namespace detail {

/// The normal of a contact and its tangents.
template <int Dim>
constexpr std::array<Point<Dim, double>, static_cast<std::size_t>(Dim)> contact_axes(Point<Dim, double> const& normal) {
  std::array<Point<Dim, double>, static_cast<std::size_t>(Dim)> axes{};
  axes[0] = normal;
  if constexpr (Dim == 2) {
    axes[1] = {-axes[0][1], axes[0][0]};
  } else {
    Point<3, double> helper{};
    helper[std::abs(axes[0][0]) < 0.6 ? 0 : 1] = 1.0;
    axes[1] = cross(axes[0], helper);
    double const size = std::sqrt(dot(axes[1], axes[1]));
    for (double& component : axes[1]) component /= size;
    axes[2] = cross(axes[0], axes[1]);
  }
  return axes;
}

/// Dashpots parallel to the springs of a contact, \f$ c = 2 \xi \sqrt{m^* S} \f$ [N s/m]; a spring against rolling has
/// none.
constexpr ContactStiffness dashpots_of(ContactStiffness const& stiffness, double damping_ratio, double reduced_mass) {
  auto const beside = [&](double spring) { return 2.0 * damping_ratio * std::sqrt(reduced_mass * spring); };
  return {.normal = beside(stiffness.normal), .tangential = beside(stiffness.tangential)};
}

/// The stiffest springs that a law has up to an overlap [m], since those of a law that yields or saturates soften.
template <class Law>
constexpr ContactStiffness stiffest_springs(Law const& law, double deepest, double radius) {
  ContactStiffness most = law.stiffness(deepest, radius);
  auto const raise = [](double& known, double other) { known = other > known ? other : known; };
  for (double depth = deepest / 4.0; depth > 1e-4 * deepest; depth /= 4.0) {
    ContactStiffness const springs = law.stiffness(depth, radius);
    raise(most.normal, springs.normal);
    raise(most.tangential, springs.tangential);
    raise(most.rolling, springs.rolling);
  }
  return most;
}

/// How deep the grains of a near pair can get before the list is made anew [m].
template <class PackingType>
double deepest_overlap(PackingType const& packing, Contact<PackingType::dim> const& contact) {
  return std::max(contact.touch.overlap, 0.0) + std::max(packing.pairs.skin, 0.0);
}

/// Largest eigenvalue of a contact's stiffness over mobility [1/s2]: its springs along the normal and the tangents act
/// on centres and spins through the arms; a spring against rolling at most adds its own.
/// mobilities: centre of both grains together [1/kg], spin of each [1/(kg m2)]
template <int Dim>
double stiffest_mode(Contact<Dim> const& contact, ContactStiffness const& stiffness, double centres, double spin_first,
                     double spin_second) {
  auto const axes = contact_axes<Dim>(contact.touch.normal);
  Tensor<Dim> modes;
  for (int k = 0; k < Dim; ++k) {
    for (int l = 0; l <= k; ++l) {
      auto const& e = axes[detail::index(k)];
      auto const& f = axes[detail::index(l)];
      double const springs = std::sqrt((k == 0 ? stiffness.normal : stiffness.tangential) *
                                       (l == 0 ? stiffness.normal : stiffness.tangential));
      modes(k, l) =
          springs * ((k == l ? centres : 0.0) +
                     spin_first * dot(cross(contact.touch.arm_first, e), cross(contact.touch.arm_first, f)) +
                     spin_second * dot(cross(contact.touch.arm_second, e), cross(contact.touch.arm_second, f)));
      modes(l, k) = modes(k, l);
    }
  }
  double const rolling = stiffness.rolling * (spin_first + spin_second);
  if constexpr (Dim == 2) {
    return largest_principal<2>(modes) + rolling;  // no eigenvalue is negative
  } else {
    // Both tangents are often alike, where the cosine formula of `largest_principal` loses half of its digits.
    Eigen::SelfAdjointEigenSolver<Tensor<Dim>> solver;
    solver.computeDirect(modes, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(Dim - 1) + rolling;
  }
}

}  // namespace detail

/// Share of `critical_step` that is used as the time step. The bound is sharp in rows of grains, so that this is the
/// share of the true limit there; in random packings it is 0.51 to 0.59 of it.
inline constexpr double default_time_step_share = 0.78;

/// Largest stable time step [s] of the explicit scheme, \f$ \Delta t = 2/\omega_{max} \f$, as a lower bound: every
/// grain's mass and inertia is shared out among its near pairs and the stiffest single pair, spin included, bounds the
/// whole packing (element eigenvalue bound of Irons and Treharne 1971). Pairs that may soon touch count as closed, all
/// as deep as they can get before the list is made anew. Without any pair, the step of the lightest grain between two
/// others. Dashpots shorten the step by \f$ \sqrt{1 + \zeta^2} - \zeta \f$ with the damping ratio \f$ \zeta \f$ of the
/// pair's mode, which shared masses and spin make larger than that of the law.
template <class PackingType>
double critical_step(PackingType const& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  auto const& population = *packing.population;
  auto const& pairs = packing.pairs;
  std::vector<double> shares(packing.grain_count(), 0.0);
  for (auto const* rows : {&pairs.first, &pairs.second}) {
    for (auto const row : *rows) shares[grain_of_row(packing, detail::index(row))] += 1.0;
  }
  double const ratio = damping_ratio_of(law);
  double shortest = std::numeric_limits<double>::infinity();
  for_each_near_pair(packing, law, [&](Contact<dim> const& contact) {
    auto const inverse_mass = [&](std::size_t grain) { return static_cast<double>(population.inverse_mass()[grain]); };
    auto const spin = [&](std::size_t grain) {
      return shares[grain] * static_cast<double>(population.inverse_inertia()[grain]);
    };
    double const centres =
        shares[contact.first] * inverse_mass(contact.first) + shares[contact.second] * inverse_mass(contact.second);
    auto const stiffest = [&](ContactStiffness const& springs) {
      return detail::stiffest_mode<dim>(contact, springs, centres, spin(contact.first), spin(contact.second));
    };
    auto const springs =
        detail::stiffest_springs(law, detail::deepest_overlap(packing, contact), contact.approach.reduced_radius);
    double step = 2.0 / std::sqrt(stiffest(springs));
    if (ratio > 0.0) {
      double const reduced_mass = 1.0 / (inverse_mass(contact.first) + inverse_mass(contact.second));
      double const damping = 0.25 * step * stiffest(detail::dashpots_of(springs, ratio, reduced_mass));
      step *= std::sqrt(1.0 + damping * damping) - damping;
    }
    if (!std::isnan(shortest) && !(step >= shortest)) shortest = step;  // one that is no number stays
  });
  if (pairs.count() > 0) return shortest;
  double lightest = 0.0;
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    lightest = std::max(lightest, static_cast<double>(population.inverse_mass()[i]));
  }
  double const stiffest =
      4.0 * detail::stiffest_springs(law, std::max(packing.pairs.skin, 0.0), population.largest_radius()).normal *
      lightest;
  return 2.0 / std::sqrt(stiffest) * (std::sqrt(1.0 + ratio * ratio) - ratio);
}

}  // namespace scarp
