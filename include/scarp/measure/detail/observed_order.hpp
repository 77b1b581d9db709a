// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "scarp/core/listed.hpp"

namespace scarp {

/// The power of a setting with which an error shrinks, as neighbouring values of the setting tell it. Estimates that
/// differ by more than `agreement` are not an order but an accident of the values chosen.
struct ObservedOrder {
  static constexpr double agreement = 0.5;  ///< keeps first and second order apart
  static constexpr double beyond = 8.0;     ///< an estimate of this size is none

  std::vector<double> estimates;

  bool holds() const {
    return !estimates.empty() && largest() - least() <= agreement && largest() < beyond && least() > -beyond;
  }
  double least() const { return estimates.empty() ? nan : *std::min_element(estimates.begin(), estimates.end()); }
  double largest() const { return estimates.empty() ? nan : *std::max_element(estimates.begin(), estimates.end()); }
  double mean() const {
    double sum = 0.0;
    for (double const estimate : estimates) sum += estimate;
    return estimates.empty() ? nan : sum / static_cast<double>(estimates.size());
  }

  std::string text() const {
    if (estimates.empty()) return "-";
    if (!holds()) return fmt::format("no order ({})", listed(estimates, ", ", "{:.1f}"));
    return fmt::format("{:.2f}{}", mean(), estimates.size() == 1 ? " (one estimate)" : "");
  }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
};

/// From the errors to a reference that is much better than all of them: \f$ p = \ln(e_1/e_2) / \ln(h_1/h_2) \f$ of
/// neighbours. Nothing where a value or an error is not above zero.
inline ObservedOrder order_of_errors(std::vector<double> const& sizes, std::vector<double> const& errors) {
  ObservedOrder order;
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) {
    bool const usable =
        sizes[k] > 0.0 && sizes[k + 1] > 0.0 && sizes[k] != sizes[k + 1] && errors[k] > 0.0 && errors[k + 1] > 0.0;
    if (!usable) return {};
    order.estimates.push_back(std::log(errors[k] / errors[k + 1]) / std::log(sizes[k] / sizes[k + 1]));
  }
  return order;
}

/// From three answers without any reference (Richardson): the p with
/// \f$ |a_1 - a_2| / |a_2 - a_3| = |h_1^p - h_2^p| / |h_2^p - h_3^p| \f$, which the right-hand side, growing with p,
/// meets once when \f$ h_1 > h_2 > h_3 \f$.
/// \return within ObservedOrder::beyond in size
inline double richardson_order(double h1, double h2, double h3, double first_difference, double second_difference) {
  double const wanted = first_difference / second_difference;
  auto const excess = [&](double p) {
    double const upper = std::log(h1 / h2);
    double const lower = std::log(h2 / h3);
    // Over h2^p; the ratio of the logarithms is the limit for p -> 0.
    double const ratio = std::abs(p) < 1e-9 ? upper / lower : std::expm1(p * upper) / -std::expm1(-p * lower);
    return ratio - wanted;
  };
  double low = -ObservedOrder::beyond;
  double high = ObservedOrder::beyond;
  if (!(excess(low) < 0.0)) return low;
  if (!(excess(high) > 0.0)) return high;
  for (int halving = 0; halving < 60; ++halving) {
    double const middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Richardson's estimate for each three neighbours. differences[k]: norm of answer k minus answer k + 1; sizes
/// descending.
inline ObservedOrder order_of_differences(std::vector<double> const& sizes, std::vector<double> const& differences) {
  ObservedOrder order;
  for (std::size_t k = 0; k + 2 < sizes.size(); ++k) {
    bool const usable = sizes[k] > sizes[k + 1] && sizes[k + 1] > sizes[k + 2] && sizes[k + 2] > 0.0 &&
                        std::isfinite(differences[k]) && differences[k + 1] > 0.0;
    if (!usable) return {};
    order.estimates.push_back(
        richardson_order(sizes[k], sizes[k + 1], sizes[k + 2], differences[k], differences[k + 1]));
  }
  return order;
}

}  // namespace scarp
