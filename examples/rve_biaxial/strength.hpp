// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "biaxial_test.hpp"

namespace rve_biaxial {

/// Peak angles [degrees] read through a window of axial strain; NaN where the test is shorter than the window.
struct Peak {
  double window = 0.0;
  double friction_angle = std::nan("");
  double friction_strain = std::nan("");  ///< axial strain at the middle of the window
  double dilation_angle = std::nan("");
  double dilation_strain = std::nan("");
};

/// Eq. 8 of the reference study with sigma_1/sigma_3 = mean axial over mean lateral stress within the window, and eq. 9
/// with the strain increments from end to end of the window; only windows that lie wholly inside the test count.
inline Peak peak_angles(std::vector<Row> const& rows, double window) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  Peak peak;
  peak.window = window;
  if (rows.size() < 2) return peak;
  double const spacing = rows[1].axial_strain - rows[0].axial_strain;
  auto const span = static_cast<std::size_t>(std::max(1L, std::lround(window / spacing)));
  for (std::size_t begin = 0; begin + span < rows.size(); ++begin) {
    double axial = 0.0;
    double lateral = 0.0;
    for (std::size_t k = begin + 1; k <= begin + span; ++k) {  // a row holds the mean stress of the strain before it
      axial += rows[k].axial_stress;
      lateral += rows[k].lateral_stress;
    }
    Row const& start = rows[begin];
    Row const& end = rows[begin + span];
    double const middle = (start.axial_strain + end.axial_strain) / 2.0;
    double const friction = degrees * std::asin((axial - lateral) / (axial + lateral));
    double const major = end.axial_strain - start.axial_strain;
    double const minor = end.lateral_strain - start.lateral_strain;
    double const dilation = degrees * std::asin(std::clamp((major + minor) / (minor - major), -1.0, 1.0));
    if (!(friction <= peak.friction_angle)) {
      peak.friction_angle = friction;
      peak.friction_strain = middle;
    }
    // While both strains are compressive, the first moments of the test, the ratio does not measure dilation.
    if (minor < 0.0 && !(dilation <= peak.dilation_angle)) {
      peak.dilation_angle = dilation;
      peak.dilation_strain = middle;
    }
  }
  return peak;
}

/// Eq. 9 with the strain increments from the largest contraction to the end of the test [degrees].
inline double secant_dilation_angle(std::vector<Row> const& rows) {
  auto const onset = std::max_element(
      rows.begin(), rows.end(), [](Row const& a, Row const& b) { return a.volumetric_strain < b.volumetric_strain; });
  double const major = rows.back().axial_strain - onset->axial_strain;
  double const minor = rows.back().lateral_strain - onset->lateral_strain;
  return 180.0 / std::numbers::pi * std::asin(std::clamp((major + minor) / (minor - major), -1.0, 1.0));
}

/// Mean and sample standard deviation.
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

inline Spread spread_of(std::vector<double> const& values) {
  Spread spread;
  double const count = static_cast<double>(values.size());
  for (double const value : values) spread.mean += value / count;
  if (values.size() < 2) return spread;
  for (double const value : values) spread.deviation += (value - spread.mean) * (value - spread.mean) / (count - 1.0);
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

template <class Measure>
Spread spread_over(std::span<Result const> results, Measure const& measure) {
  std::vector<double> values;
  for (auto const& result : results) values.push_back(measure(result));
  return spread_of(values);
}

struct PeakSpreads {
  Spread friction;
  Spread dilation;
};

inline PeakSpreads peak_spreads(std::span<Result const> results, double window) {
  return {spread_over(results, [&](Result const& result) { return peak_angles(result.rows, window).friction_angle; }),
          spread_over(results, [&](Result const& result) { return peak_angles(result.rows, window).dilation_angle; })};
}

}  // namespace rve_biaxial
