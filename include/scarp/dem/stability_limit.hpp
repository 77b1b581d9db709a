// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scarp/core/largest_eigenvalue.hpp"
#include "scarp/dem/critical_step.hpp"

namespace scarp {

namespace detail {

inline std::array<double, 1> turning_numbers(double turn) { return {turn}; }
inline std::array<double, 3> turning_numbers(std::array<double, 3> const& turn) { return turn; }

/// One spring of a contact, with its dashpot, in coordinates whose masses and inertias are one: how its stretch follows from
/// the motions of both grains.
template <int Dim>
struct GrainSpring {
  static constexpr std::size_t freedoms = static_cast<std::size_t>(Dim + spin_size<Dim>);
  using Row = std::array<double, freedoms>;

  std::size_t first;
  std::size_t second;
  Row on_first{};
  Row on_second{};
  double stiffness = 0.0;  ///< [N/m], [N m/rad]
  double dashpot = 0.0;    ///< [N s/m]

  /// Adds weight x stretch of this spring under the motion x to the forces y.
  void apply(double weight, std::vector<double> const& x, std::vector<double>& y) const {
    double stretch = 0.0;
    for (std::size_t k = 0; k < freedoms; ++k) {
      stretch += on_first[k] * x[first * freedoms + k] + on_second[k] * x[second * freedoms + k];
    }
    for (std::size_t k = 0; k < freedoms; ++k) {
      y[first * freedoms + k] += weight * stretch * on_first[k];
      y[second * freedoms + k] += weight * stretch * on_second[k];
    }
  }
};

/// Appends the springs of a contact along its normal and tangents, and against rolling, which has no dashpot.
template <class PackingType>
void append_springs(std::vector<GrainSpring<PackingType::dim>>& springs, PackingType const& packing,
                    Contact<PackingType::dim> const& contact, ContactStiffness const& stiffness, double damping_ratio) {
  constexpr int dim = PackingType::dim;
  constexpr auto axis_count = static_cast<std::size_t>(dim);
  constexpr auto spins = static_cast<std::size_t>(spin_size<dim>);
  auto const& population = *packing.population;
  double const mobility_first = static_cast<double>(population.inverse_mass()[contact.first]);
  double const mobility_second = static_cast<double>(population.inverse_mass()[contact.second]);
  double const centre_first = -std::sqrt(mobility_first);
  double const centre_second = std::sqrt(mobility_second);
  double const spin_first = -std::sqrt(static_cast<double>(population.inverse_inertia()[contact.first]));
  double const spin_second = std::sqrt(static_cast<double>(population.inverse_inertia()[contact.second]));
  ContactStiffness const dashpots = dashpots_of(stiffness, damping_ratio, 1.0 / (mobility_first + mobility_second));
  auto const axes = contact_axes<dim>(contact.touch.normal);
  for (std::size_t k = 0; k < axis_count; ++k) {
    GrainSpring<dim> spring{.first = contact.first,
                            .second = contact.second,
                            .stiffness = k == 0 ? stiffness.normal : stiffness.tangential,
                            .dashpot = k == 0 ? dashpots.normal : dashpots.tangential};
    for (std::size_t a = 0; a < axis_count; ++a) {
      spring.on_first[a] = axes[k][a] * centre_first;
      spring.on_second[a] = axes[k][a] * centre_second;
    }
    auto const lever_first = turning_numbers(cross(contact.touch.arm_first, axes[k]));
    auto const lever_second = turning_numbers(cross(contact.touch.arm_second, axes[k]));
    for (std::size_t a = 0; a < spins; ++a) {
      spring.on_first[axis_count + a] = lever_first[a] * spin_first;
      spring.on_second[axis_count + a] = lever_second[a] * spin_second;
    }
    if (spring.stiffness > 0.0) springs.push_back(spring);
  }
  if (!(stiffness.rolling > 0.0)) return;
  for (std::size_t k = dim == 2 ? 0 : 1; k < spins; ++k) {  // not about the normal: that is twist
    GrainSpring<dim> spring{.first = contact.first, .second = contact.second, .stiffness = stiffness.rolling};
    for (std::size_t a = 0; a < spins; ++a) {
      double along = 1.0;
      if constexpr (dim == 3) along = axes[k][a];
      spring.on_first[axis_count + a] = along * spin_first;
      spring.on_second[axis_count + a] = along * spin_second;
    }
    springs.push_back(spring);
  }
}

}  // namespace detail

/// Largest time step [s] for which the explicit scheme is stable as long as a packing vibrates about its present state, from
/// the largest eigenvalue of all its springs together: from above, to about the tolerance.
/// With dashpots the step solves \f$ \lambda_{max}(M^{-1}(\Delta t^2 K + 2 \Delta t\, C)) = 4 \f$, what the scheme asks of dashpots
/// that see the velocity of the half step before. Sliding and the turning of forces are not regarded.
/// \return infinity without springs, NaN where it is not found (positions that are no numbers)
template <class PackingType>
double stability_limit(PackingType const& packing, typename PackingType::Law const& law, double tolerance = 1e-3) {
  constexpr int dim = PackingType::dim;
  double const ratio = damping_ratio_of(law);
  std::vector<detail::GrainSpring<dim>> springs;
  for_each_near_pair(packing, law, [&](Contact<dim> const& contact) {
    if (contact.closed()) detail::append_springs(springs, packing, contact, contact.stiffness, ratio);
  });
  if (springs.empty()) return std::numeric_limits<double>::infinity();
  std::size_t const size = packing.grain_count() * detail::GrainSpring<dim>::freedoms;
  auto const stiffest = [&](double step) {
    auto const apply = [&](std::vector<double> const& x, std::vector<double>& y) {
      for (auto const& spring : springs) {
        spring.apply(step > 0.0 ? spring.stiffness + 2.0 * spring.dashpot / step : spring.stiffness, x, y);
      }
    };
    return largest_eigenvalue(size, apply, tolerance);
  };
  double step = 2.0 / std::sqrt(stiffest(0.0));
  if (ratio == 0.0) return step;
  // The sought step makes dt^2 times the eigenvalue of K + 2 C / dt four; the product grows like a power of dt between 1 and 2.
  double power = 1.5;
  double former_step = 0.0;
  double former_excess = 0.0;  // logarithm
  for (int iteration = 0; iteration < 20; ++iteration) {
    double const excess = std::log(step * step * stiffest(step) / 4.0);
    if (std::abs(excess) < tolerance) return step;
    if (iteration > 0) power = std::clamp((excess - former_excess) / std::log(step / former_step), 1.0, 2.0);
    former_step = step;
    former_excess = excess;
    step *= std::exp(-excess / power);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace scarp
