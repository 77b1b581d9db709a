// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/nan_max.hpp"
#include "scarp/points/material_points.hpp"
#include "scarp/tensor/finite_strain.hpp"

namespace scarp {

/// A linear condition on a point's strain or stress along a path: \f$ a\cdot\varepsilon \f$ or \f$ b\cdot\sigma \f$
/// changes by `rate` [-, Pa] per unit of the path, or reaches `target` after one unit. Tension positive.
template <int Dim>
struct PathCondition {
  EngineeringStrain<Dim> of_strain = EngineeringStrain<Dim>::Zero();  ///< a; zero where the stress is controlled
  VoigtStress<Dim> of_stress = VoigtStress<Dim>::Zero();              ///< b; zero where the strain is controlled
  double rate = 0.0;                                                  ///< change per unit of the path [-, Pa]
  std::optional<double> target{};  ///< value after one unit of the path [-, Pa]; replaces the rate

  /// Whether the strain is controlled, not the stress.
  bool controls_strain() const { return !of_strain.isZero(0.0); }
};

/// As many conditions as strain components.
template <int Dim>
using PathConditions = std::vector<PathCondition<Dim>>;

/// How a path's increments are iterated.
struct PathSettings {
  double tolerance = 1e-6;  ///< of controlled stresses, over the point's largest stress component
  int max_iterations = 25;  ///< of an increment, then it is halved
  int max_halvings = 12;    ///< of an increment
  int max_refinements = 8;  ///< of a response, see MaterialPoints::respond

  /// \throws InputError
  void validate() const {
    require_positive("tolerance of a path's controlled stresses", tolerance);
    require_at_least("most iterations of a path's increment", max_iterations, 1);
    require_not_negative("most halvings of a path's increment", max_halvings);
    require_not_negative("most refinements of a response", max_refinements);
  }
};

/// What an `advance` along a path came to.
struct [[nodiscard]] PathReport {
  Verdict verdict{};     ///< why the path ended early
  double done = 0.0;     ///< share of the requested length that is committed
  int increments = 0;    ///< committed
  int cut_backs = 0;     ///< increments that were rejected and halved
  int iterations = 0;    ///< responses of all points
  double missing = 0.0;  ///< largest relative error of a controlled stress that was committed
};

/// Drives material points along a path of mixed strain and stress control, as tests in the laboratory are:
/// \code
/// MaterialPoints<2> points(sand, sites);
/// PointPath<2> test(points, drained_path<2>());
/// while (test.length() < 0.1 && test.advance(1e-3, executor).verdict.acceptable()) print(points.committed_stress(0));
/// \endcode
/// The strain is the sum of the increments' logarithms, which are upper triangular: the plane across the last axis
/// never tilts. Every point begins with the stress that it has. Newton's method on the points' tangents; where these
/// are no derivatives, as of packings, they are corrected by Broyden's update from response to response, and kept.
template <int Dim>
class PointPath {
 public:
  using Strain = EngineeringStrain<Dim>;  ///< logarithmic, with engineering shear

  /// \throws InputError as `load`
  PointPath(MaterialPoints<Dim>& points, PathConditions<Dim> conditions, PathSettings const& settings = {})
      : points_(points), settings_(detail::validated(settings)) {
    for (int k = 0; k < points.size(); ++k) {
      VoigtStress<Dim> stress = points.committed_stress(k);
      if (auto const* means = points.means()) stress += means->committed(k).tau;
      courses_.push_back({.stress = stress, .tangent = points.committed_tangent(k)});
    }
    load(std::move(conditions));
  }

  /// Other conditions from here on.
  /// \throws InputError unless there is one for each strain component, on a strain or a stress, none by the others
  void load(PathConditions<Dim> conditions) {
    if (std::ssize(conditions) != size)
      reject("a path has {} conditions (the strain has {} components): give one for each", conditions.size(), size);
    for (auto const& condition : conditions) {
      if (condition.controls_strain() != condition.of_stress.isZero(0.0))
        reject("a condition of a path controls strain and stress, or neither: give it weights of one of the two");
    }
    Matrix strains = Matrix::Zero(), stresses = Matrix::Zero();
    for (int k = 0; k < size; ++k) {
      strains.row(k) = conditions[detail::index(k)].of_strain;
      stresses.row(k) = conditions[detail::index(k)].of_stress;
    }
    if (strains.colPivHouseholderQr().rank() + stresses.colPivHouseholderQr().rank() < size)
      reject("a condition of a path follows from the others (one strain or stress would be free): replace it");
    conditions_ = std::move(conditions);
    for (auto& course : courses_) {
      for (int k = 0; k < size; ++k) {
        auto const& one = conditions_[detail::index(k)];
        course.value(k) = one.controls_strain() ? one.of_strain.dot(course.strain) : one.of_stress.dot(course.stress);
        course.rate(k) = one.target ? *one.target - course.value(k) : one.rate;
      }
    }
  }

  /// Continues by a length, negative for the way back, in one increment, or more to converge; each is committed.
  /// \return iterations_spent, unreachable (strain beyond a tenth) or a response's reason; earlier parts stay committed
  PathReport advance(double length, Executor const& executor) {
    require_finite("length of a path", length);
    PathReport report;
    double const least = std::ldexp(1.0, -settings_.max_halvings);
    double share = 1.0;
    while (report.done < 1.0) {
      share = std::min(share, 1.0 - report.done);
      report.verdict = increment(share * length, report, executor);
      if (report.verdict.acceptable()) {
        ++report.increments;
        report.done += share;  // sums of powers of two: exact
        length_ += share * length;
        share *= 2.0;
      } else {
        points_.discard();
        ++report.cut_backs;
        if (share <= least) return report;
        share /= 2.0;
      }
    }
    return report;
  }

  /// Sum of the lengths.
  double length() const { return length_; }
  /// Logarithmic strain of a point since the path began.
  Strain const& strain(int point) const { return course(point).strain; }
  VoigtStress<Dim> const& stress(int point) const { return course(point).stress; }  ///< Committed [Pa].
  /// Deformation gradient of a point since the path began.
  Tensor<Dim> const& deformation(int point) const { return course(point).deformation; }

 private:
  static constexpr int size = voigt_size<Dim>;
  static constexpr double max_strain = 0.1;  ///< of an increment
  using Values = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;

  struct Course {
    VoigtStress<Dim> stress;    ///< committed
    VoigtTangent<Dim> tangent;  ///< of the present iteration
    bool learns = false;        ///< the tangents were no derivatives: corrected by responses
    Strain strain = Strain::Zero();
    Tensor<Dim> deformation = Tensor<Dim>::Identity();
    Values value = Values::Zero(), rate = Values::Zero();      ///< of the conditions
    Strain step = Strain::Zero(), last_step = Strain::Zero();  ///< of this increment: now and an iteration before
    VoigtStress<Dim> last_stress = VoigtStress<Dim>::Zero();
    double missing = 0.0, last_missing = 0.0;
  };

  Course const& course(int point) const {
    static_cast<void>(points_.work(point));  // rejects points that are none
    return courses_[detail::index(point)];
  }

  static Tensor<Dim> upper(Strain const& strain) {
    Tensor<Dim> tensor = Tensor<Dim>::Zero();
    for (int k = 0; k < size; ++k) {
      auto const [i, j] = voigt_indices<Dim>()[detail::index(k)];
      tensor(std::min(i, j), std::max(i, j)) = strain(k);
    }
    return tensor;
  }

  /// Solves the conditions, linear about a strain step with a stress, for the step.
  /// \return false for a step beyond `max_strain`, or that is no number
  bool solve(Course& course, Strain const& about, VoigtStress<Dim> const& stress, double length) const {
    double const scale = std::max(course.tangent.cwiseAbs().maxCoeff(), 1e-300);
    Matrix matrix;
    Values right;
    for (int k = 0; k < size; ++k) {
      auto const& one = conditions_[detail::index(k)];
      double const value = course.value(k) + course.rate(k) * length;
      if (one.controls_strain()) {
        matrix.row(k) = one.of_strain.transpose();
        right(k) = value - one.of_strain.dot(course.strain + about);
      } else {
        matrix.row(k) = one.of_stress.transpose() * course.tangent / scale;
        right(k) = (value - one.of_stress.dot(stress)) / scale;
      }
    }
    // Where a stress cannot change, as on an edge of a strength surface, the least correction is as good as any.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;  // one type for all sizes compiles once
    factors.setThreshold(1e-9);                                       // least pivot over the largest
    factors.compute(matrix);
    course.step = about + factors.solve(Eigen::VectorXd(right));
    return course.step.norm() <= max_strain;
  }

  /// Largest error of a controlled stress over the largest stress.
  double missing(Course const& course, VoigtStress<Dim> const& stress, double length) const {
    double worst = 0.0;
    double most = stress.cwiseAbs().maxCoeff();
    for (int k = 0; k < size; ++k) {
      auto const& one = conditions_[detail::index(k)];
      if (one.controls_strain()) continue;
      double const value = course.value(k) + course.rate(k) * length;
      most = std::max(most, std::abs(value));
      worst = nan_max(worst, std::abs(value - one.of_stress.dot(stress)));
    }
    return worst == 0.0 ? 0.0 : worst / most;
  }

  void learn(Course& course, VoigtStress<Dim> const& stress, VoigtTangent<Dim> const& trial) const {
    constexpr double slow = 0.3;  // of an error that is left after an iteration
    Strain const change = course.step - course.last_step;
    if (course.missing > std::max(slow * course.last_missing, settings_.tolerance)) course.learns = true;
    if (!course.learns) {
      course.tangent = trial;
    } else if (double const squared = change.squaredNorm(); squared > 0.0) {
      course.tangent += (stress - course.last_stress - course.tangent * change) * change.transpose() / squared;
    }
  }

  Verdict increment(double length, PathReport& report, Executor const& executor) {
    auto const fail = [&](Verdict const& verdict) {  // whatever was learned was of no use
      for (int k = 0; k < points_.size(); ++k) courses_[detail::index(k)].tangent = points_.committed_tangent(k);
      return verdict;
    };
    for (auto& course : courses_) {
      course.last_step.setZero();
      course.last_stress = course.stress;
      course.last_missing = std::numeric_limits<double>::infinity();
      if (!solve(course, Strain::Zero(), course.stress, length))
        return fail({Status::not_converged, Reason::unreachable});
    }
    for (int iteration = 0; iteration < settings_.max_iterations; ++iteration) {
      for (int k = 0; k < points_.size(); ++k) points_.gradient(k) = gradient(courses_[detail::index(k)]);
      ResponseReport const response = points_.respond(executor, settings_.max_refinements);
      ++report.iterations;
      if (!response.verdict.acceptable()) return fail(response.verdict);
      auto const trials = points_.tangents(executor);
      double worst = 0.0;
      for (int k = 0; k < points_.size(); ++k) {
        auto& course = courses_[detail::index(k)];
        course.missing = missing(course, points_.stress(k), length);
        worst = nan_max(worst, course.missing);
        learn(course, points_.stress(k), trials[detail::index(k)]);
      }
      if (worst <= settings_.tolerance) {
        report.missing = std::max(report.missing, worst);
        commit(length);
        return {};
      }
      for (int k = 0; k < points_.size(); ++k) {
        auto& course = courses_[detail::index(k)];
        Strain const about = course.step;
        if (course.missing > settings_.tolerance && !solve(course, about, points_.stress(k), length))
          return fail({Status::not_converged, Reason::unreachable});
        course.last_step = about;
        course.last_stress = points_.stress(k);
        course.last_missing = course.missing;
      }
    }
    return fail({Status::not_converged, Reason::iterations_spent});
  }

  /// \f$ e^{E} - I \f$: the series for a part of the step, which is then squared; to round-off for steps below 0.1.
  static Gradient<Dim> gradient(Course const& course) {
    constexpr int squarings = 6;
    Tensor<Dim> const identity = Tensor<Dim>::Identity();
    Tensor<Dim> const part = upper(course.step) / (1 << squarings);
    Gradient<Dim> grown = part * (identity + part / 2.0 * (identity + part / 3.0 * (identity + part / 4.0)));
    for (int k = 0; k < squarings; ++k) grown = (2.0 * grown + grown * grown).eval();
    return grown;
  }

  void commit(double length) {
    for (int k = 0; k < points_.size(); ++k) {
      auto& course = courses_[detail::index(k)];
      course.strain += course.step;
      course.deformation += points_.gradient(k) * course.deformation;
      course.stress = points_.stress(k);
      course.value += course.rate * length;
    }
    points_.commit();
  }

  MaterialPoints<Dim>& points_;
  PathSettings settings_;
  PathConditions<Dim> conditions_;
  std::vector<Course> courses_;
  double length_ = 0.0;
};

}  // namespace scarp
