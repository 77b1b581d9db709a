// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/budget/budget_part.hpp"
#include "scarp/budget/detail/point_checks.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Step doubling at sampled points: an accepted increment is answered again with twice the work from the same state. Every other
/// sample is the most strained point of its step, unless that was taken; the others are spread over all points.
struct DoubledSamples {
  std::vector<double> differences{};  ///< of the stress, relative, in the order of the samples
  long work = 0;                      ///< that they took

  /// After an accepted step. afforded: work that samples may have taken up to now
  template <class Problem>
  void sample(Problem const& problem, std::vector<int> const& points, ErrorSampling const& sampling, long afforded) {
    auto const chosen = choose(problem, points, sampling, afforded);
    std::vector<double> found(chosen.size());
    std::vector<long> works(chosen.size());
    problem.executor().for_each(static_cast<int>(chosen.size()), [&](int task) {
      auto const k = detail::index(task);
      problem.materials().visit(chosen[k], [&](auto const& field, int local) {
        auto const answer = doubled_answer(field, local, problem.gradients()[detail::index(chosen[k])]);
        found[k] = stress_difference(field.committed_stress(local), answer.response, sampling.loose_pressure);
        works[k] = answer.work;
      });
    });
    differences.insert(differences.end(), found.begin(), found.end());
    for (long const one : works) work += one;
  }

  /// Smallest difference that is not exceeded by a share of the samples; 0 without any.
  double quantile(double share) const {
    if (differences.empty()) return 0.0;
    std::vector<double> sorted = differences;
    std::sort(sorted.begin(), sorted.end());
    double const rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  }

  SCARP_MEMBERS(differences, work)

 private:
  template <class Problem>
  std::vector<int> choose(Problem const& problem, std::vector<int> const& points, ErrorSampling const& sampling,
                          long afforded) const {
    std::vector<int> chosen;
    auto const room = std::min(detail::index(sampling.most_samples), points.size());
    for (long planned = work; chosen.size() < room;) {
      std::size_t turn = differences.size() + chosen.size();
      int point = turn % 2 == 0 ? most_strained(problem, points) : spread(points, turn);
      while (std::find(chosen.begin(), chosen.end(), point) != chosen.end()) point = spread(points, ++turn);
      planned += 2 * std::max(1L, problem.materials().work(point));
      if (planned > afforded) break;
      chosen.push_back(point);
    }
    return chosen;
  }

  template <class Problem>
  static int most_strained(Problem const& problem, std::vector<int> const& points) {
    auto const size = [&](int point) { return problem.gradients()[detail::index(point)].squaredNorm(); };
    return *std::max_element(points.begin(), points.end(), [&](int a, int b) { return size(a) < size(b); });
  }

  /// Multiples of the golden section fill an interval evenly however many there are.
  static int spread(std::vector<int> const& points, std::size_t number) {
    constexpr double golden_section = 0.6180339887498949;
    double const turns = golden_section * static_cast<double>(number);
    return points[static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(points.size()))];
  }
};

}  // namespace scarp
