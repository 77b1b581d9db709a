// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/random.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp {

/// Independent standard normal numbers. Box and Muller, Ann. Math. Statist. 29 (1958) 610.
template <int Dim>
Vector<Dim> normal_vector(Random& random) {
  Vector<Dim> normal;
  for (int k = 0; k < Dim; ++k) {
    double const radius = std::sqrt(-2.0 * std::log1p(-random.uniform()));
    normal(k) = radius * std::cos(2.0 * std::numbers::pi * random.uniform());
  }
  return normal;
}

/// A homogeneous smooth random field of mean zero and variance one, a function of the place alone:
/// \f$ Z(x) = \sqrt{2/N} \sum_k \cos(w_k \cdot x + \phi_k) \f$, phases uniform, waves normal with the standard
/// deviation \f$ \sqrt2 \f$
/// over the correlation length along each axis. Two places have the correlation \f$ e^{-r^2} \f$, r their distance,
/// each component over its correlation length.
/// Mean, variance and correlation over all seeds are exact for any number of waves N; the distribution of a value tends
/// to the normal one, its kurtosis is 3 - 3/(2N). Shinozuka and Jan, J. Sound Vib. 25 (1972) 111; waves drawn as by
/// Kraichnan, Phys. Fluids 13 (1970) 22.
template <int Dim>
class CorrelatedField {
 public:
  /// Parameters of a field.
  struct Choice {
    Vector<Dim> lengths = Vector<Dim>::Ones();  ///< of correlation along the axes [m]
    std::uint64_t seed = 1;                     ///< of the waves and phases
    int waves = 500;                            ///< N, at least one
  };

  /// Draws the waves and phases of a choice.
  /// \throws InputError for lengths that are not finite and positive or fewer than one wave
  explicit CorrelatedField(Choice const& choice) {
    for (double const length : choice.lengths) require_positive("correlation length", length);
    if (choice.waves < 1)
      reject("a field of {} waves was requested (it would be zero): give some hundred", choice.waves);
    Random random(choice.seed);
    for (int k = 0; k < choice.waves; ++k) {
      Vector<Dim> const wave = (std::numbers::sqrt2 * normal_vector<Dim>(random)).cwiseQuotient(choice.lengths);
      waves_.push_back({wave, random.uniform(0.0, 2.0 * std::numbers::pi)});
    }
  }

  /// position [m]
  double operator()(Vector<Dim> const& position) const {
    double sum = 0.0;
    for (auto const& [wave, phase] : waves_) sum += std::cos(wave.dot(position) + phase);
    return std::sqrt(2.0 / static_cast<double>(waves_.size())) * sum;
  }

 private:
  struct Wave {
    Vector<Dim> wave;  ///< [1/m]
    double phase;
  };
  std::vector<Wave> waves_;
};

/// A positive quantity whose logarithm is normal.
struct Lognormal {
  double mean = 1.0;       ///< m, positive, in the unit of the quantity
  double variation = 0.0;  ///< standard deviation over mean

  /// \throws InputError for a mean that is not positive and a variation that is negative
  void validate() const {
    require_positive("mean of a lognormal quantity", mean);
    require_not_negative("variation of a lognormal quantity", variation);
  }

  /// Value that belongs to a standard normal number.
  /// \f$ m\,e^{s z - s^2/2},\; s^2 = \ln(1 + v^2) \f$
  /// \throws InputError as validate() does
  double of(double normal) const {
    validate();
    double const variance = std::log1p(variation * variation);
    return mean * std::exp(std::sqrt(variance) * normal - variance / 2.0);
  }
};

}  // namespace scarp
