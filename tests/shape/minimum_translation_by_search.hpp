// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scarp/core/random.hpp"
#include "scarp/shape/converged_contact.hpp"

namespace samples {

/// Overlap of a pair along the direction of an angle.
template <class Shape>
double overlap_along(scarp::PoseOf<Shape> const& first, scarp::PoseOf<Shape> const& second,
                     scarp::Point<2, double> const& branch, double angle) {
  scarp::Point<2, double> const n{std::cos(angle), std::sin(angle)};
  return Shape::support(first, n).value + Shape::support(second, n).value - branch[0] * n[0] - branch[1] * n[1];
}

/// Least overlap over all directions without derivatives: a fine grid, golden sections about its lowest valleys.
template <class Shape>
double searched_overlap(scarp::PoseOf<Shape> const& first, scarp::PoseOf<Shape> const& second,
                        scarp::Point<2, double> const& branch, int directions = 3000) {
  double const step = 2.0 * std::numbers::pi / directions;
  std::vector<double> values;
  for (int k = 0; k < directions; ++k) values.push_back(overlap_along<Shape>(first, second, branch, k * step));
  auto const at = [&](int k) { return values[static_cast<std::size_t>((k + directions) % directions)]; };
  std::vector<int> valleys;
  for (int k = 0; k < directions; ++k) {
    if (at(k) <= at(k - 1) && at(k) <= at(k + 1)) valleys.push_back(k);
  }
  std::sort(valleys.begin(), valleys.end(), [&](int a, int b) { return at(a) < at(b); });
  double least = at(valleys.front());
  for (std::size_t v = 0; v < std::min<std::size_t>(valleys.size(), 4); ++v) {
    double low = (valleys[v] - 1) * step;
    double high = (valleys[v] + 1) * step;
    constexpr double section = 1.0 / std::numbers::phi;
    for (int k = 0; k < 50; ++k) {
      double const left = high - section * (high - low);
      double const right = low + section * (high - low);
      double const of_left = overlap_along<Shape>(first, second, branch, left);
      double const of_right = overlap_along<Shape>(first, second, branch, right);
      least = std::min({least, of_left, of_right});
      (of_left > of_right ? low : high) = of_left > of_right ? left : right;
    }
  }
  return least;
}

/// A random pair of grains of one size, as far apart as `overlap` says: between a deep overlap and a gap.
template <class Shape>
struct PairAtOverlap {
  scarp::PoseOf<Shape> first;
  scarp::PoseOf<Shape> second;
  scarp::Point<2, double> branch;

  PairAtOverlap(scarp::Random& random, scarp::SizeOf<Shape> const& size, double overlap) {
    auto const pose = [&] {
      double const angle = random.uniform(0.0, 2.0 * std::numbers::pi);
      return Shape::pose(size, std::array<double, 2>{std::cos(angle), std::sin(angle)});
    };
    first = pose();
    second = pose();
    double const direction = random.uniform(0.0, 2.0 * std::numbers::pi);
    double low = 0.0;
    double high = 3.0 * Shape::bounding_radius(size);
    for (int k = 0; k < 40; ++k) {
      double const distance = (low + high) / 2.0;
      branch = {distance * std::cos(direction), distance * std::sin(direction)};
      (searched_overlap<Shape>(first, second, branch, 300) > overlap ? low : high) = distance;
    }
  }
};

/// How wrong the touch of random pairs is at most, over the larger of their half axes; from starts in any direction.
template <class Shape>
double worst_touch(scarp::SizeOf<Shape> const& size, int pairs, std::uint64_t seed) {
  scarp::Random random(seed);
  double const largest = Shape::bounding_radius(size);
  double worst = 0.0;
  for (int k = 0; k < pairs; ++k) {
    PairAtOverlap<Shape> const pair(random, size,
                                    random.uniform(-0.3, 0.1) * (largest - Shape::eccentricity(size) / 2.0));
    double const angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    auto const touch =
        scarp::converged_contact<Shape>(pair.first, pair.second, pair.branch, {std::cos(angle), std::sin(angle)});
    double const exact = searched_overlap<Shape>(pair.first, pair.second, pair.branch);
    worst = std::max(worst, std::abs(touch.overlap - exact) / largest);
    if (touch.normal_error > 0.0) worst = 1.0;
  }
  return worst;
}

}  // namespace samples
