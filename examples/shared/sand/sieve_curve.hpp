// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/random.hpp"

namespace examples {

/// Sizes of grains from a sieve analysis: the share of the mass that passes each diameter, straight lines between the
/// sieves over the logarithm of the diameter, as it is plotted.
struct SieveCurve {
  std::vector<double> diameters;  ///< [m], increasing
  std::vector<double> passing;    ///< share of the mass, from 0 to 1, one for each diameter

  /// \throws InputError for a curve that does not rise from 0 to 1 over increasing diameters
  void validate() const {
    if (diameters.size() < 2 || diameters.size() != passing.size())
      scarp::reject(
          "a sieve curve has {} diameters and {} shares that pass (two or more of both are expected): complete it",
          diameters.size(), passing.size());
    for (std::size_t k = 0; k < diameters.size(); ++k) {
      scarp::require_positive("diameter of a sieve", diameters[k]);
      scarp::require_between("share that passes a sieve", passing[k], 0.0, 1.0);
      if (k > 0 && !(diameters[k] > diameters[k - 1] && passing[k] >= passing[k - 1]))
        scarp::reject(
            "after a sieve of {} m, which {:.6g} % pass, one of {} m is passed by {:.6g} % (both increase): sort the "
            "sieves",
            diameters[k - 1], 100.0 * passing[k - 1], diameters[k], 100.0 * passing[k]);
    }
    if (passing.front() != 0.0 || passing.back() != 1.0)
      scarp::reject(
          "a sieve curve runs from {:.6g} % to {:.6g} % (0 % to 100 % are expected): add the sieves that nothing and "
          "everything passes",
          100.0 * passing.front(), 100.0 * passing.back());
  }

  /// Diameters [m] of grains whose mass has the curve within a tenth of all: drawn by number or, where chance misses
  /// the curve, one for each class of equal number, with the mean mass of its class. Between two sieves the mass is
  /// uniform over ln d, hence the number goes with \f$ d^{-1-n} \f$ in n dimensions.
  /// dim: 2 where grains are prisms, whose mass goes with the square of their diameter, else 3
  /// \throws InputError for a curve so wide that the largest of these grains would carry more, with a number and a
  /// curve that do
  std::vector<double> sample(scarp::Random& random, int dim, int grains) const {
    auto const inverse = [&](std::size_t k) { return std::pow(diameters[k], -dim); };
    std::vector<double> numbers{0.0};  // of grains up to each sieve, in proportion
    for (std::size_t k = 1; k < diameters.size(); ++k)
      numbers.push_back(numbers.back() + slope(k - 1) * (inverse(k - 1) - inverse(k)));
    std::vector<double> drawn;
    for (int grain = 0; grain < grains; ++grain) {
      auto const k = interval(numbers, random.uniform(0.0, numbers.back()));
      drawn.push_back(std::pow(random.uniform(inverse(k + 1), inverse(k)), -1.0 / dim));
    }
    if (missed(drawn, dim) <= allowed) return drawn;
    double const each = numbers.back() / grains;
    double lower = 0.0, largest = 0.0;  // passing at the bounds of a class, share of its mass
    for (int grain = 0; grain < grains; ++grain) {
      auto const k = interval(numbers, each * (grain + 1));
      double const way = std::min(1.0, (each * (grain + 1) - numbers[k]) / (numbers[k + 1] - numbers[k]));
      double const upper = passing_at(std::pow(std::lerp(inverse(k), inverse(k + 1), way), -1.0 / dim));
      largest = upper - lower;
      drawn[scarp::detail::index(grain)] = std::pow(dim * largest / each, 1.0 / dim);
      lower = upper;
    }
    if (largest <= allowed) return drawn;
    auto const needed = [&](double cut) {  // grains of the curve that begins where the share `cut` passes
      return std::ceil(number_above(cut, dim) / number_above(1.0 - allowed * (1.0 - cut), dim));
    };
    double cut = 1.0, below = 0.0;
    for (int k = 0; k < 40; ++k) (needed((cut + below) / 2.0) > grains ? below : cut) = (cut + below) / 2.0;
    scarp::reject(
        "{} grains cannot have the sieve curve from {:.4g} to {:.4g} m (the largest would carry {:.0f} % of the mass, "
        "at most "
        "{:.0f} % are expected): take {:.6g} grains, or begin the curve at {:.3g} m, which {:.0f} % pass",
        grains, diameters.front(), diameters.back(), 100.0 * largest, 100.0 * allowed, needed(0.0), diameter_at(cut),
        100.0 * cut);
  }

 private:
  static constexpr double allowed = 0.1;  ///< share of the mass

  /// The interval of increasing numbers where one lies.
  static std::size_t interval(std::vector<double> const& bounds, double number) {
    auto const above = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, number);
    return scarp::detail::index(above - bounds.begin()) - 1;
  }
  /// Share of the mass over the logarithm of the diameter between two sieves.
  double slope(std::size_t k) const {
    return (passing[k + 1] - passing[k]) / std::log(diameters[k + 1] / diameters[k]);
  }
  double passing_at(double diameter) const {
    auto const k = interval(diameters, diameter);
    return std::clamp(passing[k] + slope(k) * std::log(diameter / diameters[k]), passing[k], passing[k + 1]);
  }
  double diameter_at(double share) const {
    auto const k = interval(passing, share);
    return share > passing[k] ? diameters[k] * std::exp((share - passing[k]) / slope(k)) : diameters[k];
  }
  /// Grains above the diameter that a share of the mass passes, in proportion.
  double number_above(double share, int dim) const {
    double sum = 0.0, from = diameter_at(share);
    for (std::size_t k = interval(passing, share); k + 1 < diameters.size(); from = diameters[++k])
      sum += slope(k) * (std::pow(from, -dim) - std::pow(diameters[k + 1], -dim));
    return sum;
  }
  /// How far the mass of grains is from the curve at most, over all of it.
  double missed(std::vector<double> grains, int dim) const {
    std::ranges::sort(grains);
    double all = 0.0, sum = 0.0, most = 0.0;
    for (double const diameter : grains) all += std::pow(diameter, dim);
    for (double const diameter : grains) {
      double const wanted = passing_at(diameter);
      most = std::max(most, wanted - sum / all);
      sum += std::pow(diameter, dim);
      most = std::max(most, sum / all - wanted);
    }
    return most;
  }
};

}  // namespace examples
