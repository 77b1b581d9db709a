// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "calibration_data.hpp"
#include "packings.hpp"
#include "scarp/dem/preparation.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace rve_lab {

/// What a calibration is to find and how it tests a sand.
struct Calibration {
  Sand start{};
  std::vector<Free> free{};
  std::vector<Observation> observations{};
  CurveTest test{};
  double window = 0.02;  ///< axial strain over which peaks are means
  int seeds = 4;
  int evaluations = 30;
  int threads = 0;
  /// Curve of one packing. \throws PreparationError, InputError
  std::function<Curve(Sand const&, CurveTest const&)> run{};

  std::size_t groups() const { return observations.back().group + 1; }
  /// The tangential stiffness keeps its ratio to the normal one, where it is not free itself.
  Sand sand_at(Eigen::VectorXd const& shares) const {
    Sand sand = start;
    for (std::size_t k = 0; k < free.size(); ++k) free[k].of(sand) = free[k].at(shares(static_cast<Eigen::Index>(k)));
    if (std::ranges::find(free, "tangential-stiffness", &Free::name) == free.end() &&
        sand.normal_stiffness != start.normal_stiffness)
      sand.tangential_stiffness = start.tangential_stiffness * (sand.normal_stiffness / start.normal_stiffness);
    return sand;
  }
};

/// What the mean curve of several seeds has at one place of the parameters.
struct Evaluation {
  Eigen::VectorXd shares{};   ///< of the way between the bounds
  Eigen::VectorXd values{};   ///< of the observations
  Eigen::VectorXd scatter{};  ///< standard error of the values, jackknife over the seeds
  double void_ratio = 0.0;    ///< at the isotropic pressure of the preparation
  Curve mean{};               ///< empty where it was read from a file
  std::string reason{};       ///< why there is no such packing or curve; values are then no numbers

  bool feasible() const { return reason.empty(); }
};

/// A place whose packings cannot be prepared or tested.
inline Evaluation infeasible(Calibration const& calibration, Eigen::VectorXd const& shares, std::string reason) {
  double const none = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd const values =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(calibration.observations.size()), none);
  return {.shares = shares, .values = values, .scatter = values, .void_ratio = none, .reason = std::move(reason)};
}

/// first: number of the first seed
inline Evaluation evaluated(Calibration const& calibration, Eigen::VectorXd const& shares, scarp::ThreadExecutor& team,
                            int first = 0) {
  auto const seeds = static_cast<std::size_t>(calibration.seeds);
  std::vector<Curve> curves(seeds);
  std::vector<std::string> reasons(seeds);
  auto const fail = [&](int k, std::exception const& problem) {
    reasons[static_cast<std::size_t>(k)] =
        fmt::format("seed {}: {}", seed_of(calibration.start, first + k), problem.what());
  };
  team.for_each(calibration.seeds, [&](int k) {
    Sand sand = calibration.sand_at(shares);
    sand.seed = seed_of(calibration.start, first + k);
    try {
      curves[static_cast<std::size_t>(k)] = calibration.run(sand, calibration.test);
    } catch (scarp::PreparationError const& problem) {
      fail(k, problem);
    } catch (scarp::InputError const& problem) {
      fail(k, problem);
    }
  });
  for (auto const& reason : reasons) {
    if (!reason.empty()) return infeasible(calibration, shares, reason);
  }
  auto const mean_without = [&](std::size_t left_out) {
    std::vector<Curve const*> some;
    for (std::size_t k = 0; k < seeds; ++k) {
      if (k != left_out) some.push_back(&curves[k]);
    }
    return mean_of(some);
  };
  auto const values_of = [&](Curve const& curve) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(calibration.observations.size()));
    for (Eigen::Index k = 0; k < values.size(); ++k)
      values(k) = calibration.observations[static_cast<std::size_t>(k)].of(curve);
    return values;
  };
  Evaluation evaluation{.shares = shares, .mean = mean_without(seeds)};
  evaluation.values = values_of(evaluation.mean);
  for (Eigen::Index k = 0; k < evaluation.values.size(); ++k) {
    if (!std::isfinite(evaluation.values(k)))
      return infeasible(calibration, shares,
                        fmt::format("the curve has no {}", calibration.observations[static_cast<std::size_t>(k)].name));
  }
  evaluation.void_ratio = evaluation.mean.isotropic_void_ratio;
  Eigen::MatrixXd each(evaluation.values.size(), calibration.seeds);
  for (std::size_t k = 0; k < seeds; ++k) each.col(static_cast<Eigen::Index>(k)) = values_of(mean_without(k));
  Eigen::VectorXd const middle = each.rowwise().mean();
  double const n = calibration.seeds;
  evaluation.scatter = ((n - 1.0) / n * (each.colwise() - middle).rowwise().squaredNorm()).cwiseSqrt();
  return evaluation;
}

/// Units of the misfit: standard error of each observation at the start, of a table's column the mean.
inline Eigen::VectorXd units(Calibration const& calibration, Evaluation const& start) {
  std::vector<double> squares(calibration.groups()), counts(calibration.groups());
  auto const each = [&](auto const& visit) {
    for (std::size_t k = 0; k < calibration.observations.size(); ++k)
      visit(static_cast<Eigen::Index>(k), calibration.observations[k]);
  };
  each([&](Eigen::Index k, Observation const& one) {
    squares[one.group] += start.scatter(k) * start.scatter(k), counts[one.group] += 1.0;
  });
  Eigen::VectorXd units(start.values.size());
  each([&](Eigen::Index k, Observation const& one) {
    units(k) = std::max(one.least_scatter, std::sqrt(squares[one.group] / counts[one.group]));
  });
  return units;
}

/// Differences in units of the scatter, weighted so that each group counts as one number: their squares sum to the
/// squared misfit.
inline Eigen::VectorXd residuals(Calibration const& calibration, Eigen::VectorXd const& values,
                                 Eigen::VectorXd const& units) {
  std::vector<double> counts(calibration.groups());
  for (auto const& one : calibration.observations) counts[one.group] += 1.0;
  Eigen::VectorXd residuals(values.size());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    auto const& one = calibration.observations[static_cast<std::size_t>(k)];
    double const weight = 1.0 / (counts[one.group] * static_cast<double>(calibration.groups()));
    residuals(k) = std::sqrt(weight) * (values(k) - one.wanted) / units(k);
  }
  return residuals;
}

/// Root mean square over the groups. The square of a void ratio that the grains do not have is added in units of its
/// own bound.
inline double misfit(Calibration const& calibration, Evaluation const& one, Eigen::VectorXd const& units) {
  double const wanted = calibration.sand_at(one.shares).void_ratio;
  double const allowed = measure_named("void-ratio").reached;
  double const missed = wanted > 0.0 ? (one.void_ratio - wanted) / allowed : 0.0;
  return std::sqrt(residuals(calibration, one.values, units).squaredNorm() +
                   (std::abs(missed) > 1.0 ? missed * missed : 0.0));
}

/// Slopes of the residuals. slopes: of the values
inline Eigen::MatrixXd weighted(Calibration const& calibration, Eigen::MatrixXd const& slopes,
                                Eigen::VectorXd const& units) {
  Eigen::VectorXd const none = residuals(calibration, Eigen::VectorXd::Zero(units.size()), units);
  Eigen::MatrixXd found(slopes.rows(), slopes.cols());
  for (Eigen::Index k = 0; k < slopes.cols(); ++k) found.col(k) = residuals(calibration, slopes.col(k), units) - none;
  return found;
}

/// Change of all values from one bound of each parameter to the other, by finite differences about a place.
struct Sensitivities {
  Eigen::MatrixXd slopes{};      ///< values over shares
  Eigen::MatrixXd covariance{};  ///< of the shares, from the scatter of the values
};

/// Differences to both sides of the best place, to one side where the other is infeasible, none where both are.
/// evaluate(shares) -> Evaluation
template <class Evaluate>
Sensitivities sensitivities(Calibration const& calibration, Evaluation const& best, Eigen::VectorXd const& units,
                            Evaluate const& evaluate) {
  constexpr double step = 0.1;
  auto const count = static_cast<Eigen::Index>(calibration.free.size());
  Sensitivities found{.slopes = Eigen::MatrixXd::Zero(units.size(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    auto const at = [&](double share) {
      Eigen::VectorXd shares = best.shares;
      shares(k) = std::clamp(share, 0.0, 1.0);
      auto const there = evaluate(shares);
      return there.feasible() ? there : best;
    };
    Evaluation const above = at(best.shares(k) + step), below = at(best.shares(k) - step);
    if (double const between = above.shares(k) - below.shares(k); between > 0.0)
      found.slopes.col(k) = (above.values - below.values) / between;
  }
  // In groups as in the misfit, whose groups share one unit of weight.
  Eigen::MatrixXd const own = weighted(calibration, found.slopes, units);
  Eigen::MatrixXd const information = static_cast<double>(calibration.groups()) * own.transpose() * own;
  found.covariance = (information + 1e-6 * Eigen::MatrixXd::Identity(count, count)).inverse();
  return found;
}

/// The place that the slopes lead to, no further than the steps reach over which they were taken.
inline Eigen::VectorXd improved(Calibration const& calibration, Evaluation const& best, Sensitivities const& found,
                                Eigen::VectorXd const& units) {
  constexpr double farthest = 0.15;
  Eigen::VectorXd const move = weighted(calibration, found.slopes, units)
                                   .colPivHouseholderQr()
                                   .solve(-residuals(calibration, best.values, units));
  return (best.shares + move.cwiseMin(farthest).cwiseMax(-farthest)).cwiseMin(1.0).cwiseMax(0.0);
}

}  // namespace rve_lab
