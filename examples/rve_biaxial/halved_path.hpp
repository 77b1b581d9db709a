// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "scarp/dem/time_stepping.hpp"

namespace rve_biaxial {

/// A stretch of a packing's path, to be gone once more in steps of half the strain, hence at half the rate: what the
/// mean stress over it then changes by estimates the error of the steps.
/// \tparam PackingType a `Packing`
/// \tparam Damping a `DampsMotion`
template <class PackingType, class Damping = scarp::LocalDamping>
class HalvedPath {
 public:
  static constexpr int dim = PackingType::dim;  ///< of the packing's space

  /// From a copy of the packing as it is.
  explicit HalvedPath(PackingType packing) : packing_(std::move(packing)) {}

  /// A step that was made, with the stress [Pa] before it.
  void add(scarp::Tensor<dim> const& strain_step, scarp::Tensor<dim> const& stress) {
    steps_.push_back(strain_step);
    sum_ += stress;
  }

  /// Relative difference of the mean stresses, Frobenius norms; infinite where the second path fails or has no number.
  /// Consumes the packing.
  double difference(typename PackingType::Law const& law, scarp::TimeStepper<PackingType, Damping> stepper = {}) {
    scarp::Tensor<dim> other = scarp::Tensor<dim>::Zero();
    scarp::StepObservation<dim> seen;
    for (auto const& whole : steps_) {
      scarp::Tensor<dim> const half = whole / 2.0;
      scarp::Verdict verdict = stepper.template step<scarp::Observe::balance>(packing_, law, half, &seen);
      if (verdict.acceptable()) verdict = stepper.step(packing_, law, half);
      if (!verdict.acceptable()) return std::numeric_limits<double>::infinity();
      other += seen.stress;
    }
    double const apart = (other - sum_).norm();
    if (!std::isfinite(apart)) return std::numeric_limits<double>::infinity();
    return apart == 0.0 ? 0.0 : apart / sum_.norm();
  }

 private:
  PackingType packing_;
  std::vector<scarp::Tensor<dim>> steps_;
  scarp::Tensor<dim> sum_ = scarp::Tensor<dim>::Zero();
};

}  // namespace rve_biaxial
