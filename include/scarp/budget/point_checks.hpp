// SPDX-License-Identifier: BSL-1.0
/// \file
/// Checks of a point whose response has just been committed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "scarp/budget/budget_part.hpp"
#include "scarp/constitutive/unwrap.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/nan_max.hpp"
#include "scarp/points/step_doubling.hpp"

namespace scarp {

/// How well all packings of a problem were balanced, and how fast they were strained, over its accepted steps.
struct PackingSurvey {
  double looked_at = 0.0;        ///< packings of all steps
  double unbalanced_sum = 0.0;   ///< of all unbalanced ratios
  double unbalanced = 0.0;       ///< largest, as the next two
  double kinetic_share = 0.0;    ///< share of moving grains in a packing's pressure
  double inertial_number = 0.0;  ///< of a response

  /// Mean unbalanced ratio over packings and steps; zero before the first.
  double mean_unbalanced() const { return looked_at > 0.0 ? unbalanced_sum / looked_at : 0.0; }

  /// After an accepted step.
  template <class Problem>
  void look(Problem const& problem, std::vector<int> const& points) {
    for (int const point : points) {
      PackingBalance const found = problem.points().packing_balance(point);
      if (!found.has_packing) continue;
      looked_at += 1.0;
      unbalanced_sum += found.unbalanced_ratio;
      unbalanced = nan_max(unbalanced, found.unbalanced_ratio);
      kinetic_share = nan_max(kinetic_share, found.kinetic_share);
      inertial_number = nan_max(inertial_number, found.inertial_number);
    }
  }

  SCARP_MEMBERS(looked_at, unbalanced_sum, unbalanced, kinetic_share, inertial_number)
};

/// Relative differences of stress at sampled points, in the order of the samples.
struct SampledDifferences {
  std::vector<double> differences{};  ///< relative sizes, not negative
  std::vector<double> carried{};      ///< [Pa], size of the stress that each is relative to

  /// Smallest difference that is not exceeded where a share of all samples' stress is carried; 0 without any.
  double quantile(double share) const {
    std::vector<std::size_t> order(differences.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return differences[a] < differences[b]; });
    double const wanted = share * std::accumulate(carried.begin(), carried.end(), 0.0);
    double found = 0.0;
    double sum = 0.0;
    for (std::size_t const k : order) {
      found = differences[k];
      if ((sum += carried[k]) >= wanted) break;
    }
    return found;
  }

  /// Largest difference of all samples, also those that carry nothing; 0 without any.
  double largest() const {
    return std::accumulate(differences.begin(), differences.end(), 0.0,
                           [](double a, double b) { return nan_max(a, b); });
  }

  SCARP_MEMBERS(differences, carried)
};

/// Step doubling at sampled points: an accepted increment is repeated with twice the DEM steps from the same state.
/// Every other sample is the most strained point of its step, unless that was taken; the others are spread over all
/// points.
struct DoubledSamples {
  SampledDifferences spread{};    ///< over all points
  SampledDifferences strained{};  ///< the most strained point of a step
  long work = 0;                  ///< that they cost

  /// Samples so far, spread and strained ones.
  std::size_t count() const { return spread.differences.size() + strained.differences.size(); }

  /// After an accepted step. least [Pa]: that each point's stress counts as large as; afforded: work that samples may
  /// have cost up to now
  template <class Problem>
  void sample(Problem const& problem, std::vector<int> const& points, std::vector<double> const& least,
              ErrorSampling const& sampling, long afforded) {
    constexpr int dim = Problem::dim;
    auto const chosen = choose(problem, points, sampling, afforded);
    std::vector<double> found(chosen.size());
    std::vector<long> works(chosen.size());
    problem.executor().for_each(detail::count(chosen), [&](int task) {
      auto const k = detail::index(task);
      int const point = chosen[k].point;
      auto const doubled = problem.points().doubled_response(point);
      found[k] =
          stress_difference(problem.points().committed_stress(point), doubled.response, least[detail::index(point)]);
      works[k] = doubled.work;
    });
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      auto& samples = chosen[k].is_most_strained ? strained : spread;
      auto const stress = problem.points().committed_stress(chosen[k].point);
      samples.differences.push_back(found[k]);
      samples.carried.push_back(std::max(stress_size<dim>(stress), least[detail::index(chosen[k].point)]));
      work += works[k];
    }
  }

  SCARP_MEMBERS(spread, strained, work)

 private:
  struct Chosen {
    int point = -1;
    bool is_most_strained = false;
  };

  template <class Problem>
  std::vector<Chosen> choose(Problem const& problem, std::vector<int> const& points, ErrorSampling const& sampling,
                             long afforded) const {
    std::vector<Chosen> chosen;
    auto const is_taken = [&](int point) {
      return std::any_of(chosen.begin(), chosen.end(), [&](Chosen const& one) { return one.point == point; });
    };
    auto const room = std::min(detail::index(sampling.max_samples), points.size());
    for (long planned = work; chosen.size() < room;) {
      std::size_t turn = count() + chosen.size();
      Chosen next{max_strained(problem, points), true};
      if (turn % 2 == 1 || is_taken(next.point)) next = {spread_point(points, turn), false};
      while (is_taken(next.point)) next.point = spread_point(points, ++turn);
      planned += 2 * std::max(1L, problem.points().work(next.point));
      if (planned > afforded) break;
      chosen.push_back(next);
    }
    return chosen;
  }

  template <class Problem>
  static int max_strained(Problem const& problem, std::vector<int> const& points) {
    auto const size = [&](int point) { return problem.gradients()[detail::index(point)].squaredNorm(); };
    return *std::max_element(points.begin(), points.end(), [&](int a, int b) { return size(a) < size(b); });
  }

  /// Multiples of the golden section fill an interval evenly however many there are.
  static int spread_point(std::vector<int> const& points, std::size_t number) {
    constexpr double golden_section = 0.6180339887498949;
    double const turns = golden_section * static_cast<double>(number);
    return points[static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(points.size()))];
  }
};

/// A point whose increments are repeated along the whole run, with twice the DEM steps and from the repetition's own
/// states: how far the two have come apart is what the steps of the point's inner work have added up to on its path.
struct TrackedPoint {
  int point = -1;           ///< number of the point, -1 for none
  std::string bits{};       ///< second state; empty before the first step, and for a state that names no members
  double apart = 0.0;       ///< relative difference of the stresses now
  double farthest = 0.0;    ///< largest so far
  double square_sum = 0.0;  ///< of the differences after all steps

  SCARP_MEMBERS(point, bits, apart, farthest, square_sum)
};

/// Points whose whole history is repeated with steps twice as fine, and the sums of their differences.
struct TrackedPoints {
  std::vector<TrackedPoint> points{};  ///< in increasing order of their numbers
  int steps = 0;                       ///< accepted ones that were followed
  long work = 0;                       ///< that they cost
  double square_sum = 0.0;             ///< over all steps, of what is in common; see together()

  /// Spread over the points that this process sees, and those that are named.
  /// \throws InputError for points that the problem does not have
  template <class Problem>
  static TrackedPoints choose(Problem const& problem, std::vector<int> const& seen, ErrorSampling const& sampling) {
    int const count = problem.points().size();
    auto const spread = detail::index(std::min(count / sampling.points_per_tracked, sampling.max_tracked));
    std::vector<int> chosen;
    for (std::size_t k = 0; k < spread && !seen.empty(); ++k)
      chosen.push_back(seen[(2 * k + 1) * seen.size() / (2 * spread)]);
    for (int const point : sampling.tracked) {
      if (point < 0 || point >= count)
        reject("point {} is to be tracked (there are points 0 to {}): choose one of these", point, count - 1);
      if (problem.executor().owns(point)) chosen.push_back(point);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    TrackedPoints tracked;
    for (int const point : chosen) tracked.points.push_back({.point = point});
    return tracked;
  }

  /// After an accepted step, the first of which they begin with. least [Pa]: that each point's stress counts as large
  /// as
  template <class Problem>
  void follow(Problem const& problem, std::vector<double> const& least) {
    constexpr int dim = Problem::dim;
    std::vector<long> works(points.size());
    std::vector<VoigtStress<dim>> differences(points.size());
    std::vector<double> carried(points.size());
    problem.executor().for_each(detail::count(points), [&](int task) {
      TrackedPoint& one = points[detail::index(task)];
      auto const doubled = problem.points().doubled_path(one.point, one.bits);
      auto const stress = problem.points().committed_stress(one.point);
      double const own_least = least[detail::index(one.point)];
      one.apart = stress_difference(stress, doubled.response, own_least);
      bool const has_answer = doubled.response.verdict.status != Status::failed && doubled.response.stress.allFinite();
      differences[detail::index(task)] = has_answer
                                             ? VoigtStress<dim>(doubled.response.stress - stress)
                                             : VoigtStress<dim>::Constant(std::numeric_limits<double>::infinity());
      carried[detail::index(task)] = std::max(stress_size<dim>(stress), own_least);
      one.farthest = nan_max(one.farthest, one.apart);
      one.square_sum += one.apart * one.apart;
      works[detail::index(task)] = doubled.work;
    });
    for (long const one : works) work += one;
    ++steps;
    VoigtStress<dim> sum = VoigtStress<dim>::Zero();
    double own = 0.0;
    double all_carried = 0.0;
    double own_carried = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k].bits.empty()) continue;
      sum += differences[k];
      own += std::pow(stress_size<dim>(differences[k]), 2);
      all_carried += carried[k];
      own_carried += carried[k] * carried[k];
    }
    if (own == 0.0) return;
    double const squared = std::pow(stress_size<dim>(sum), 2);
    double const carried_squared = all_carried * all_carried;
    bool const is_of_one = !(carried_squared - own_carried > 1e-9 * carried_squared);
    square_sum += is_of_one || std::isinf(squared) ? squared / carried_squared
                                                   : (squared - own) / (carried_squared - own_carried);
  }

  /// Whether the path of at least one point has been repeated.
  bool any() const {
    return std::any_of(points.begin(), points.end(), [](auto const& one) { return !one.bits.empty(); });
  }

  /// What the points' differences have in common, over what they carry, root mean square over the steps: the mean over
  /// all pairs of points of the products of their differences, over that of what they carry. What differs by chance
  /// from point to point, as between two packings of one sand, has no part in it; of one point alone its own
  /// difference.
  double together() const { return steps > 0 ? std::sqrt(nan_max(0.0, square_sum / steps)) : 0.0; }

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

  /// Largest relative difference of one point at any time.
  double farthest() const {
    double farthest = 0.0;
    for (auto const& one : points) farthest = nan_max(farthest, one.farthest);
    return farthest;
  }

  SCARP_MEMBERS(points, steps, work, square_sum)
};

}  // namespace scarp
