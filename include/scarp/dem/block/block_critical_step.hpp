// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>

#include "scarp/dem/block/block_work.hpp"
#include "scarp/dem/critical_step.hpp"

namespace scarp::detail {

/// `stiffest_mode` without Eigen. mobilities: centre of both grains together [1/kg], spin of each [1/(kg m2)]
template <int Dim>
SCARP_HOST_DEVICE constexpr double stiffest_mode_of(ContactGeometry<Dim, double> const& touch,
                                                    ContactStiffness const& stiffness, double centres,
                                                    double spin_first, double spin_second) {
  constexpr auto axes = static_cast<std::size_t>(Dim);
  auto const frame = contact_axes<Dim>(touch.normal);
  SmallTensor<Dim> modes{};
  for (std::size_t k = 0; k < axes; ++k) {
    for (std::size_t l = 0; l <= k; ++l) {
      double const springs = std::sqrt((k == 0 ? stiffness.normal : stiffness.tangential) *
                                       (l == 0 ? stiffness.normal : stiffness.tangential));
      double const mode =
          springs * ((k == l ? centres : 0.0) +
                     spin_first * dot(cross(touch.arm_first, frame[k]), cross(touch.arm_first, frame[l])) +
                     spin_second * dot(cross(touch.arm_second, frame[k]), cross(touch.arm_second, frame[l])));
      modes[k * axes + l] = mode;
      modes[l * axes + k] = mode;
    }
  }
  return largest_principal_of<Dim>(modes) + stiffness.rolling * (spin_first + spin_second);
}

/// `critical_step` of a block whose pairs and their order by grains stand. [s]
template <class Types, class Team>
SCARP_HOST_DEVICE constexpr double block_critical_step(BlockWork<Types, Team> const& work) {
  using Shape = typename Types::Shape;
  constexpr int dim = Types::dim;
  auto const& b = work.bench;
  double const ratio = damping_ratio_of(work.law);
  double shortest = std::numeric_limits<double>::infinity();
  each(work.team, work.pair_count, [&](int p) {
    int const first = b.first[p];
    int const second = b.second[p];
    int const i = first / Types::parts;
    int const j = second / Types::parts;
    auto const pose_first = work.template pose<double>(first);
    auto const pose_second = work.template pose<double>(second);
    auto const touch = converged_touch<Shape>(pose_first, pose_second, work.template branch<double>(i, j, b.shift[p]),
                                              work.template normal<double>(p))
                           .touch;
    double const radius_first = Shape::contact_radius(pose_first);
    double const radius_second = Shape::contact_radius(pose_second);
    double const radius = radius_first * radius_second / (radius_first + radius_second);
    double const share_i = b.begin[i + 1] - b.begin[i];
    double const share_j = b.begin[j + 1] - b.begin[j];
    double const light_i = static_cast<double>(work.grains.inverse_mass[i]);
    double const light_j = static_cast<double>(work.grains.inverse_mass[j]);
    double const centres = share_i * light_i + share_j * light_j;
    double const spin_i = share_i * static_cast<double>(work.grains.inverse_inertia[i]);
    double const spin_j = share_j * static_cast<double>(work.grains.inverse_inertia[j]);
    double const depth = (touch.overlap > 0.0 ? touch.overlap : 0.0) + (work.skin > 0.0 ? work.skin : 0.0);
    auto const springs = stiffest_springs(work.law, depth, radius);
    double step = 2.0 / std::sqrt(stiffest_mode_of<dim>(touch, springs, centres, spin_i, spin_j));
    if (ratio > 0.0) {
      auto const dashpots = dashpots_of(springs, ratio, 1.0 / (light_i + light_j));
      double const damping = 0.25 * step * stiffest_mode_of<dim>(touch, dashpots, centres, spin_i, spin_j);
      step *= std::sqrt(1.0 + damping * damping) - damping;
    }
    if (shortest == shortest && !(step >= shortest)) shortest = step;  // one that is no number stays
  });
  double lightest = 0.0;
  if (work.pair_count == 0) {
    each(work.team, work.grain_count, [&](int i) {
      double const light = static_cast<double>(work.grains.inverse_mass[i]);
      lightest = light > lightest ? light : lightest;
    });
  }
  // The least by the largest of inverted bits, of which not-a-number has the least: it counts as a step of zero.
  double const counted = shortest == shortest ? shortest : 0.0;
  auto const found = work.team.largest(std::array{~ordered_bits(counted), ordered_bits(lightest)});
  if (work.pair_count > 0) return std::bit_cast<double>(~found[0] & ~(1ULL << 63));
  double const springs =
      4.0 * stiffest_springs(work.law, work.skin > 0.0 ? work.skin : 0.0, work.grains.largest_radius).normal *
      std::bit_cast<double>(found[1]);
  return 2.0 / std::sqrt(springs) * (std::sqrt(1.0 + ratio * ratio) - ratio);
}

}  // namespace scarp::detail
