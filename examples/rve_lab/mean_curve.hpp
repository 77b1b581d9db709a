// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "choices.hpp"
#include "laboratory_results.hpp"
#include "paths.hpp"

namespace rve_lab {

/// A test on one packing, or the mean of several: the start, then a row for each stretch of the path with its mean
/// stress and the strain in its middle. Stresses are those across the axes, as a laboratory measures them.
struct Curve {
  std::vector<LaboratoryRow<2>> rows;
  double void_ratio = 0.0;            ///< at the start
  double isotropic_void_ratio = 0.0;  ///< of the preparation, at its isotropic pressure

  /// In space with the mean of the lateral stresses and the sum of the lateral strains, from which friction and
  /// dilation are as in the plane.
  template <int Dim>
  void add(Eigen::Matrix<double, Dim, Dim> const& stress, Eigen::Matrix<double, Dim, Dim> const& deformation) {
    double const axial = axial_strain(deformation);
    rows.push_back({axial,
                    {-lateral_pressure(stress), stress(Dim - 1, Dim - 1), 0.0},
                    {std::log(deformation.determinant()) + axial, -axial, 0.0}});
  }
};

/// Mean of curves whose rows end at the same strains, as far as the shortest goes.
inline Curve mean_of(std::vector<Curve const*> const& curves) {
  Curve mean;
  std::vector<std::vector<LaboratoryRow<2>>> rows;
  auto const* const shortest = *std::ranges::min_element(curves, {}, [](Curve const* one) { return one->rows.size(); });
  auto const count = static_cast<std::ptrdiff_t>(shortest->rows.size());
  for (auto const* curve : curves) {
    rows.emplace_back(curve->rows.begin(), curve->rows.begin() + count);
    mean.void_ratio += curve->void_ratio / static_cast<double>(curves.size());
    mean.isotropic_void_ratio += curve->isotropic_void_ratio / static_cast<double>(curves.size());
  }
  mean.rows = mean_rows<2>(rows);
  return mean;
}

/// Prepares a packing of a sand, as near to its void ratio as its grains can come, and tests it.
/// \throws PreparationError, InputError for grains that are not built, and for a packing that cannot follow the path
Curve curve_of(Sand const& sand, CurveTest const& test);

/// What a practitioner reads from a curve.
struct Measure {
  using Results = LaboratoryResults<2>;

  std::string_view name;
  std::string_view unit;
  double (*of)(Results const& results, Curve const& curve);
  double least_scatter;   ///< differences below this are none
  double reached;         ///< how near a target is to be
  bool windowed = false;  ///< a mean over a window of axial strain
  bool relative = false;  ///< whether `least_scatter` and `reached` are shares of the target
};

inline std::vector<Measure> const& measures() {
  using Results = Measure::Results;
  static std::vector<Measure> const all{
      {"peak-friction", "degrees",
       [](Results const& results, Curve const&) { return results.peak.friction() / degree; }, 0.2, 1.0, true},
      {"residual-friction", "degrees",
       [](Results const& results, Curve const&) { return results.residual.friction() / degree; }, 0.2, 1.0, true},
      {"peak-dilation", "degrees", [](Results const& results, Curve const&) { return results.peak_dilation / degree; },
       0.3, 2.0, true},
      {"secant-dilation", "degrees",
       [](Results const& results, Curve const&) { return results.secant_dilation / degree; }, 0.3, 2.0},
      {"void-ratio", "", [](Results const&, Curve const& curve) { return curve.void_ratio; }, 5e-4, 3e-3},
      {.name = "e50",
       .unit = "Pa",
       .of = [](Results const& results, Curve const&) { return results.secant_modulus; },
       .least_scatter = 0.005,
       .reached = 0.1,
       .relative = true}};
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
