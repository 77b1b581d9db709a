// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/tensor/principal.hpp"
#include "scarp/tensor/voigt.hpp"

namespace rve_lab {

/// State of a point on a laboratory path: length of the path, stress [Pa] and logarithmic strain with engineering
/// shear, tension positive. What follows from them is positive in compression; p and q in the plane are those of the
/// stresses in it.
template <int Dim>
struct LaboratoryRow {
  double length = 0.0;                                               ///< as `PointPath` counts it
  scarp::VoigtStress<Dim> stress = scarp::VoigtStress<Dim>::Zero();  ///< Cauchy stress [Pa], tension positive
  /// logarithmic, with engineering shear, extension positive
  scarp::EngineeringStrain<Dim> strain = scarp::EngineeringStrain<Dim>::Zero();

  /// Principal stresses [Pa], largest first.
  scarp::Vector<Dim> principal_stresses() const {
    return scarp::principal_values<Dim>(-scarp::from_voigt_stress<Dim, double>(stress));
  }
  /// Mean stress [Pa].
  double p() const { return -stress.template head<Dim>().mean(); }
  /// Difference of the outer principal stresses [Pa].
  double q() const {
    auto const values = principal_stresses();
    return values(0) - values(Dim - 1);
  }
  /// Mobilised friction angle [rad], \f$ \sin\varphi = (\sigma_1 - \sigma_3)/(\sigma_1 + \sigma_3) \f$: a right angle
  /// where the minor principal stress is tension, which no friction angle carries, and 0 without any stress.
  double friction() const {
    auto const values = principal_stresses();
    if (values(Dim - 1) < 0.0) return std::numbers::pi / 2.0;
    double const sum = values(0) + values(Dim - 1);
    if (std::isnan(sum)) return sum;
    return sum > 0.0 ? std::asin((values(0) - values(Dim - 1)) / sum) : 0.0;
  }
  double axial_strain() const { return 0.0 - strain(Dim - 1); }  ///< Along the last axis, compression positive.
  /// Logarithmic, compression positive.
  double volumetric_strain() const { return 0.0 - strain.template head<Dim>().sum(); }
  /// Void ratio of grains that do not change their volume. initial: where the path began
  double void_ratio(double initial) const { return (1.0 + initial) * std::exp(-volumetric_strain()) - 1.0; }
};

/// Dilation angle [rad] of a change of strain, \f$ \sin\psi = -d\varepsilon_v / \sum_i |d\varepsilon_i| \f$ over the
/// principal strains: what Mohr-Coulomb flow with this angle has in the plane, in triaxial compression and in
/// extension. NaN where no shear strain changes, as in oedometers: all principal strains have one sign.
template <int Dim>
double dilation(LaboratoryRow<Dim> const& from, LaboratoryRow<Dim> const& to) {
  scarp::EngineeringStrain<Dim> change = to.strain - from.strain;
  change.template tail<scarp::voigt_size<Dim> - Dim>() /= 2.0;
  scarp::Vector<Dim> const parts = scarp::principal_values<Dim>(scarp::from_voigt_stress<Dim, double>(change));
  double const sine = parts.sum() / parts.cwiseAbs().sum();
  return std::abs(sine) < 1.0 - 1e-9 ? std::asin(sine) : std::numeric_limits<double>::quiet_NaN();
}

/// Results of a test by the names that practitioners use. NaN where the test does not have them.
template <int Dim>
struct LaboratoryResults {
  using Row = LaboratoryRow<Dim>;  ///< of the test
  /// value of a result that the test does not have
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  Row peak{};      ///< where the mobilised friction is largest; mean over the window, as all rows here
  Row residual{};  ///< over the last window
  /// Whether the ratio of the outer principal stresses is largest in the last tenth of the path, still rose there by a
  /// twentieth of its growth, and fell by less than that at the end: `peak` is then where the test ended, and no
  /// strength.
  bool rises = false;
  std::optional<Row>
      phase_transformation{};  ///< from contraction to dilation; at constant volume from falling to rising p
  double peak_dilation =
      none;  ///< largest where nine tenths of the peak friction are mobilised [rad]; not of extension
  double secant_dilation = none;  ///< from the largest contraction to the end [rad]; 0 where it contracts to the end
  double shear_modulus = none;    ///< G0 [Pa], over the first row; not of nearly isotropic paths
  double secant_modulus = none;  ///< E50 [Pa], to half of the largest change of q, where the length is the axial strain
  double secant_poisson = none;  ///< lateral extension over axial compression there, in the plane \f$ \nu/(1-\nu) \f$
  double k0 = none;              ///< lateral over axial stress at the end

  /// Poisson's ratio of the secant to E50.
  double poisson() const { return Dim == 2 ? secant_poisson / (1.0 + secant_poisson) : secant_poisson; }
};

namespace detail {

template <int Dim>
LaboratoryRow<Dim> mean(std::span<LaboratoryRow<Dim> const> rows) {
  LaboratoryRow<Dim> sum;
  double const share = 1.0 / static_cast<double>(rows.size());
  for (auto const& row : rows) {
    sum.length += share * row.length;
    sum.stress += share * row.stress;
    sum.strain += share * row.strain;
  }
  return sum;
}

/// Rows up to the first turn of a cyclic path.
template <int Dim>
std::span<LaboratoryRow<Dim> const> monotonic(std::span<LaboratoryRow<Dim> const> rows) {
  std::size_t count = std::min<std::size_t>(rows.size(), 2);
  double const sign = count < 2 ? 1.0 : rows[1].length - rows[0].length;
  while (count < rows.size() && sign * (rows[count].length - rows[count - 1].length) > 0.0) ++count;
  return rows.first(count);
}

/// The row where a measure is largest; nothing at the ends.
template <int Dim, class Measure>
std::optional<LaboratoryRow<Dim>> inner_maximum(std::vector<LaboratoryRow<Dim>> const& rows, Measure const& measure) {
  auto const most = std::ranges::max_element(rows, {}, measure);
  if (most == rows.begin() || most == rows.end() || most + 1 == rows.end()) return std::nullopt;
  return *most;
}

template <int Dim>
void read_moduli(std::span<LaboratoryRow<Dim> const> rows, LaboratoryResults<Dim>& results) {
  auto const deviator = [](scarp::VoigtStress<Dim> const& components) {
    scarp::Tensor<Dim> const tensor = scarp::from_voigt_stress<Dim, double>(components);
    return (tensor - tensor.trace() / Dim * scarp::Tensor<Dim>::Identity()).norm();
  };
  auto const& start = rows.front();
  scarp::EngineeringStrain<Dim> first = rows[1].strain - start.strain;
  first.template tail<scarp::voigt_size<Dim> - Dim>() /= 2.0;
  if (double const shear = deviator(first); shear > 0.05 * first.norm())
    results.shear_modulus = deviator(rows[1].stress - start.stress) / (2.0 * shear);
  auto const top = std::ranges::max_element(rows, {}, &LaboratoryRow<Dim>::q);
  double const half = (start.q() + top->q()) / 2.0;
  auto const above = std::ranges::find_if(rows, [&](auto const& row) { return row.q() >= half; });
  if (above == rows.begin() || above == rows.end()) return;
  auto const& below = *(above - 1);
  double const share = (half - below.q()) / (above->q() - below.q());
  scarp::EngineeringStrain<Dim> const strain = below.strain + share * (above->strain - below.strain) - start.strain;
  double const length = below.length + share * (above->length - below.length) - start.length;
  if (!(std::abs(strain(Dim - 1) + length) < 1e-6 * std::abs(length))) return;
  results.secant_modulus = (half - start.q()) / std::abs(strain(Dim - 1));
  results.secant_poisson = -strain.template head<Dim - 1>().mean() / strain(Dim - 1);
}

}  // namespace detail

/// Mean of the rows of several tests, whose rows end at equal lengths.
/// \throws InputError without a test, and for tests of different numbers of rows
template <int Dim>
std::vector<LaboratoryRow<Dim>> mean_rows(std::vector<std::vector<LaboratoryRow<Dim>>> const& tests) {
  if (tests.empty()) scarp::reject("there is no test to take the mean of: give one at least");
  for (auto const& own : tests)
    if (own.size() != tests.front().size())
      scarp::reject("a test has {} rows, the first {} (tests of a mean have equal rows): follow one path", own.size(),
                    tests.front().size());
  std::vector<LaboratoryRow<Dim>> rows(tests.front().size());
  double const share = 1.0 / static_cast<double>(tests.size());
  for (auto const& own : tests) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].length += share * own[k].length;
      rows[k].stress += share * own[k].stress;
      rows[k].strain += share * own[k].strain;
    }
  }
  return rows;
}

/// Reads the results of a test from its rows, up to the first turn of a cyclic one.
/// window: length of the path over which stresses are means and dilation angles differences, against the scatter of
/// packings; 0 for single rows. A row stands for the increment that it ends, so the one where a window begins does not
/// count in its mean stress.
/// \throws InputError for less than two rows, and a path that is shorter than the window
template <int Dim>
LaboratoryResults<Dim> laboratory_results(std::vector<LaboratoryRow<Dim>> const& all, double window = 0.0) {
  using Row = LaboratoryRow<Dim>;
  scarp::require_not_negative("window of a test's results", window);
  auto const rows = detail::monotonic<Dim>(all);
  if (rows.size() < 2) scarp::reject("a test has {} rows (results are differences): give two at least", rows.size());
  LaboratoryResults<Dim> results;
  std::vector<Row> means;
  std::vector<double> angles;
  std::size_t last = 0;
  for (std::size_t first = 0; first < rows.size(); ++first) {
    auto const length = [&](std::size_t row) { return std::abs(rows[row].length - rows[first].length); };
    constexpr double slight = 1e-9;  // of the window, for sums of lengths
    while (last + 1 < rows.size() && (last < first || length(last) < window * (1.0 - slight))) ++last;
    if (length(last) < window * (1.0 - slight)) break;
    std::size_t const begin = std::min(last, window > 0.0 ? first + 1 : first);
    means.push_back(detail::mean<Dim>(rows.subspan(begin, last + 1 - begin)));
    angles.push_back(dilation(rows[first], rows[std::min(std::max(last, first + 1), rows.size() - 1)]));
  }
  if (means.empty()) scarp::reject("the test is shorter than the window {} of its results: take a smaller one", window);
  auto const largest = std::ranges::max_element(means, {}, &Row::friction);
  constexpr double round_off = 1e-9;  // [rad]: on a plateau the peak is where it begins
  results.peak = *std::find_if(means.begin(), largest,
                               [&](Row const& row) { return row.friction() >= largest->friction() - round_off; });
  auto const growth = [](Row const& row) {  // sigma_1 / sigma_3 - 1
    double const sine = std::sin(row.friction());
    return 2.0 * sine / (1.0 - sine);
  };
  double const path = means.back().length - rows.front().length;
  auto const before = std::ranges::find_if(  // a tenth of the path before the end
      means, [&](Row const& row) { return std::abs(means.back().length - row.length) <= 0.1 * std::abs(path); });
  auto const earlier = before == means.begin() ? before : before - 1;
  double const most = growth(results.peak);
  results.rises = std::abs(means.back().length - results.peak.length) <= 0.1 * std::abs(path) &&
                  most > 1.05 * growth(*earlier) && growth(means.back()) > 0.95 * most;
  bool const extends = rows.back().axial_strain() < rows.front().axial_strain();  // elastic ground swells then
  for (std::size_t k = 0; k < means.size() && !extends; ++k) {
    constexpr double nearly = 0.9;  // of the peak: before, elastic changes of volume count
    if (means[k].friction() < nearly * results.peak.friction() || angles[k] <= results.peak_dilation) continue;
    if (!std::isnan(angles[k])) results.peak_dilation = angles[k];
  }
  results.residual = means.back();
  auto const contracted = std::ranges::max_element(rows, {}, &Row::volumetric_strain);
  results.secant_dilation = contracted + 1 == rows.end() ? 0.0 : dilation(*contracted, rows.back());
  bool const undrained =
      std::ranges::all_of(rows, [](Row const& row) { return std::abs(row.volumetric_strain()) < 1e-9; });
  results.phase_transformation =
      undrained ? detail::inner_maximum(means, [](Row const& row) { return -row.p(); })
                : detail::inner_maximum(means, [](Row const& row) { return row.volumetric_strain(); });
  results.k0 = rows.back().stress(0) / rows.back().stress(Dim - 1);
  detail::read_moduli<Dim>(rows, results);
  return results;
}

}  // namespace rve_lab
