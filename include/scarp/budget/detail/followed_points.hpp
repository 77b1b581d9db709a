// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scarp/budget/budget_part.hpp"
#include "scarp/budget/detail/point_checks.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/worse_of.hpp"
#include "scarp/solver/executor.hpp"

namespace scarp {

/// A point whose increments are answered a second time along the whole run, with twice the work and from the second answer's own
/// states: how far the two have come apart is what the steps of the point's inner work have added up to on its path.
struct FollowedPoint {
  int point = -1;
  std::string bits{};       ///< second state; empty before the first step, and for a state that names no members
  double apart = 0.0;       ///< relative difference of the stresses now
  double farthest = 0.0;    ///< largest so far
  double square_sum = 0.0;  ///< of the differences after all steps

  SCARP_MEMBERS(point, bits, apart, farthest, square_sum)
};

struct FollowedPoints {
  std::vector<FollowedPoint> points{};
  int steps = 0;
  long work = 0;  ///< that they took

  /// Spread over the points that this process sees, and those that are named.
  /// \throws InputError for points that the problem does not have
  template <class Problem>
  static FollowedPoints choose(Problem const& problem, std::vector<int> const& seen, ErrorSampling const& sampling) {
    int const count = problem.materials().point_count();
    auto const spread = detail::index(std::min(count / sampling.points_per_followed, sampling.most_followed));
    std::vector<int> chosen;
    for (std::size_t k = 0; k < spread && !seen.empty(); ++k)
      chosen.push_back(seen[(2 * k + 1) * seen.size() / (2 * spread)]);
    for (int const point : sampling.followed) {
      if (point < 0 || point >= count)
        refuse("point {} is to be followed (there are points 0 to {}): choose one of these", point, count - 1);
      if (owns_point(problem.executor(), point)) chosen.push_back(point);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    FollowedPoints followed;
    for (int const point : chosen) followed.points.push_back({.point = point});
    return followed;
  }

  /// After an accepted step, the first of which they begin with.
  template <class Problem>
  void follow(Problem const& problem, double loose_pressure) {
    std::vector<long> works(points.size());
    problem.executor().for_each(detail::count(points), [&](int task) {
      FollowedPoint& one = points[detail::index(task)];
      problem.materials().visit(one.point, [&](auto const& field, int local) {
        auto const answer = followed_answer(field, local, problem.gradients()[detail::index(one.point)], one.bits);
        one.apart = stress_difference(field.committed_stress(local), answer.response, loose_pressure);
        one.farthest = worse_of(one.farthest, one.apart);
        one.square_sum += one.apart * one.apart;
        works[detail::index(task)] = answer.work;
      });
    });
    for (long const one : works) work += one;
    ++steps;
  }

  bool any() const {
    return std::any_of(points.begin(), points.end(), [](auto const& one) { return !one.bits.empty(); });
  }

  /// Root mean square of the differences over points and steps.
  double apart() const {
    double squares = 0.0;
    int count = 0;
    for (auto const& one : points) {
      if (one.bits.empty()) continue;
      squares += one.square_sum / steps;
      ++count;
    }
    return count > 0 ? std::sqrt(squares / count) : 0.0;
  }

  double farthest() const {
    double farthest = 0.0;
    for (auto const& one : points) farthest = worse_of(farthest, one.farthest);
    return farthest;
  }

  SCARP_MEMBERS(points, steps, work)
};

}  // namespace scarp
