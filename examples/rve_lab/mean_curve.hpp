// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "choices.hpp"
#include "paths.hpp"
#include "scarp/homogenise/balance.hpp"
#include "specimen.hpp"

namespace rve_lab {

/// A test on one packing, or the mean of several: rows of means over a stretch of the path.
struct Curve {
  std::vector<double> strain;      ///< axial, logarithmic, at the end of the row
  std::vector<double> p;           ///< mean of the principal stresses [Pa], compression positive
  std::vector<double> q;           ///< axial less lateral stress [Pa]
  std::vector<double> volumetric;  ///< strain, compression positive
  double void_ratio = 0.0;         ///< at the start

  std::size_t rows() const { return strain.size(); }
  /// Sine of the mobilised friction angle.
  double sine(std::size_t row) const { return p[row] == 0.0 ? 0.0 : q[row] / (2.0 * p[row]); }
};

/// Mean of curves whose rows end at the same strains.
inline Curve mean_of(std::vector<Curve const*> const& curves) {
  Curve mean = *curves.front();
  auto const share = 1.0 / static_cast<double>(curves.size());
  for (auto const member : {&Curve::strain, &Curve::p, &Curve::q, &Curve::volumetric}) {
    for (std::size_t row = 0; row < mean.rows(); ++row) {
      (mean.*member)[row] = 0.0;
      for (auto const* curve : curves) (mean.*member)[row] += share * (curve->*member)[row];
    }
  }
  mean.void_ratio = 0.0;
  for (auto const* curve : curves) mean.void_ratio += share * curve->void_ratio;
  return mean;
}

/// \throws InputError for a packing that cannot follow the path
template <class PackingType>
Curve tested(PackingType packing, typename PackingType::Law const& law, CurveTest const& test) {
  PathKind const& path = path_named(test.path);
  Specimen<PackingType, scarp::Observe::energy> lab(std::move(packing), law, path, test.strain_step, test.held);
  Curve curve;
  curve.void_ratio = lab.packing().void_ratio();
  long const steps_per_row = steps_of(test.row_strain, test.strain_step);
  Tensor sum = Tensor::Zero();
  for (long step = 1; step <= steps_of(test.strain, test.strain_step); ++step) {
    if (auto const verdict = lab.step(); !verdict.acceptable())
      scarp::reject("a packing ended with {} at strain {:.4g}: take a smaller --strain-step, or another stress",
                    scarp::name(verdict.reason), path.strain(lab.deformation()));
    sum += lab.seen().stress / static_cast<double>(steps_per_row);
    if (step % steps_per_row != 0) continue;
    curve.strain.push_back(axial_strain(lab.deformation()));
    curve.volumetric.push_back(0.0 - std::log(lab.deformation().determinant()));
    curve.p.push_back(mean_pressure(sum));
    curve.q.push_back(sum(0, 0) - sum(1, 1));
    sum.setZero();
  }
  return curve;
}

/// Rows of a window of axial strain.
inline std::size_t rows_of(Curve const& curve, double window) {
  auto const found = std::ranges::upper_bound(curve.strain, window * (1.0 + 1e-6)) - curve.strain.begin();
  return std::clamp<std::size_t>(static_cast<std::size_t>(found), 1, curve.rows() - 1);
}

/// Mobilised friction angle [degrees] of the mean stresses of rows begin..end.
inline double friction_angle(Curve const& curve, std::size_t begin, std::size_t end) {
  double p = 0.0, q = 0.0;
  for (auto row = begin; row < end; ++row) p += curve.p[row], q += curve.q[row];
  return std::asin(std::clamp(q / (2.0 * p), -1.0, 1.0)) / degree;
}

/// Dilation angle [degrees] between two rows: \f$ \sin\psi = -d\varepsilon_v / (2 d\varepsilon_1 - d\varepsilon_v) \f$.
inline double dilation_angle(Curve const& curve, std::size_t begin, std::size_t end) {
  double const axial = curve.strain[end] - curve.strain[begin];
  double const volume = curve.volumetric[end] - curve.volumetric[begin];
  return std::asin(std::clamp(-volume / (2.0 * axial - volume), -1.0, 1.0)) / degree;
}

/// What a practitioner reads from a curve. window: axial strain over which peaks are means
struct Measure {
  std::string_view name;
  std::string_view unit;
  double (*of)(Curve const& curve, double window);
  double least_scatter;  ///< differences below this are none
  double reached;        ///< how near a target is to be
};

inline double largest_over_windows(Curve const& curve, double window,
                                   double (*of)(Curve const&, std::size_t, std::size_t)) {
  double largest = -90.0;
  auto const rows = rows_of(curve, window);
  for (std::size_t row = 0; row + rows < curve.rows(); ++row) largest = std::max(largest, of(curve, row, row + rows));
  return largest;
}

/// Secant modulus [Pa] at half of the largest deviator.
inline double e50(Curve const& curve, double) {
  double const half = 0.5 * *std::ranges::max_element(curve.q);
  double strain_before = 0.0, q_before = 0.0;
  for (std::size_t row = 0; row < curve.rows(); ++row) {
    if (curve.q[row] >= half) {
      double const share = (half - q_before) / (curve.q[row] - q_before);
      return half / (strain_before + share * (curve.strain[row] - strain_before));
    }
    strain_before = curve.strain[row], q_before = curve.q[row];
  }
  return 0.0;
}

inline std::vector<Measure> const& measures() {
  static std::vector<Measure> const all{
      {"peak-friction", "degrees",
       [](Curve const& curve, double window) { return largest_over_windows(curve, window, friction_angle); }, 0.2, 1.0},
      {"residual-friction", "degrees",
       [](Curve const& curve, double) { return friction_angle(curve, curve.rows() * 3 / 4, curve.rows()); }, 0.2, 1.0},
      {"peak-dilation", "degrees",
       [](Curve const& curve, double window) { return largest_over_windows(curve, window, dilation_angle); }, 0.3, 2.0},
      {"secant-dilation", "degrees",
       [](Curve const& curve, double) {
         auto const lowest = std::ranges::max_element(curve.volumetric) - curve.volumetric.begin();
         auto const last = curve.rows() - 1;
         return dilation_angle(curve, std::min(static_cast<std::size_t>(lowest), last - 1), last);
       },
       0.3, 2.0},
      {"void-ratio", "", [](Curve const& curve, double) { return curve.void_ratio; }, 5e-4, 3e-3},
      {"e50", "Pa", e50, 1e5, 5e6}};
  return all;
}

/// \throws InputError
inline Measure const& measure_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (auto const& measure : measures()) {
    if (measure.name == name) return measure;
    names.push_back(measure.name);
  }
  scarp::reject("there is no target '{}' ({} are known): choose one of these", name, scarp::listed(names, ", "));
}

}  // namespace rve_lab
