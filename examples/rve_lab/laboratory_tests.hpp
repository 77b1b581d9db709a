// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "../shared/print.hpp"
#include "choices.hpp"
#include "laboratory_results.hpp"
#include "laboratory_table.hpp"
#include "paths.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/points/any_provider.hpp"
#include "scarp/points/point_path.hpp"
#include "scarp/solver/thread_executor.hpp"

namespace rve_lab {

template <int Dim>
scarp::PathConditions<Dim> conditions_of(Laboratory const& choice) {
  if (choice.path == "isotropic") return scarp::isotropic_path<Dim>();
  if (choice.path == "oedometer") return scarp::oedometer_path<Dim>();
  if (choice.path == "undrained") return scarp::undrained_path<Dim>();
  if (choice.path == "constant_mean_stress") return scarp::constant_mean_stress_path<Dim>();
  if (choice.path == "simple_shear") return scarp::simple_shear_path<Dim>();
  if (choice.path == "simple_shear_at_stress") return scarp::simple_shear_at_stress_path<Dim>();
  if (choice.path == "proportional_stress") return scarp::proportional_stress_path<Dim>(choice.ratio);
  if (choice.path == "proportional_strain") return scarp::proportional_strain_path<Dim>(choice.ratio);
  return scarp::drained_path<Dim>();
}

/// Axial stress and k0 times as much on the lateral axes as targets, no shear strain.
template <int Dim>
scarp::PathConditions<Dim> consolidation_of(double axial, double k0) {
  auto conditions = scarp::oedometer_path<Dim>();
  for (int k = 0; k < Dim; ++k) {
    conditions[static_cast<std::size_t>(k)] = {.of_stress = scarp::VoigtStress<Dim>::Unit(k),
                                               .target = -(k == Dim - 1 ? 1.0 : k0) * axial};
  }
  return conditions;
}

/// A point on its way along the path, with its rows.
template <int Dim>
struct PointTest {
  scarp::MaterialPoints<Dim> points;
  std::optional<scarp::PointPath<Dim>> path{};
  std::vector<LaboratoryRow<Dim>> rows{};
  double void_ratio = std::nan("");  ///< where the path begins
  scarp::PathReport total{};
  scarp::Verdict verdict{};  ///< why it ended early, else ok
  bool has_moved = false;    ///< since the last row

  PointTest(scarp::AnyProvider<Dim> const& material, int number)
      : points(material, std::vector<scarp::Site<Dim>>{{.index = number}}) {}

  void advance(double length, scarp::Executor const& executor) {
    if (!verdict.acceptable()) return;
    auto const report = path->advance(length, executor);
    verdict = report.verdict;
    has_moved = report.increments > 0;
    total.increments += report.increments;
    total.cut_backs += report.cut_backs;
    total.iterations += report.iterations;
    total.missing = std::max(total.missing, report.missing);
  }
  double length() const { return rows.empty() ? 0.0 : rows.back().length; }
};

/// Points that are tested alike, each to its own end; compression positive in the table.
template <int Dim>
class LaboratoryRun {
 public:
  using Test = PointTest<Dim>;

  LaboratoryRun(Laboratory const& choice, scarp::AnyProvider<Dim> const& material, int count,
                std::filesystem::path const& table)
      : choice_(choice),
        executor_(choice.threads_for(count)),
        log_(table, {"point", "length", "axial_strain", "volumetric_strain", "shear_strain", "axial_stress",
                     "lateral_stress", "shear_stress", "p", "q", "friction_angle", "void_ratio"}) {
    for (int k = 0; k < count; ++k) tests_.emplace_back(material, k);
  }

  /// targets: of --path table, or null
  void run(TargetTable<Dim> const* targets) {
    if (choice_.consolidation) consolidate();
    for (auto& test : tests_) {
      test.path.emplace(test.points, conditions_of<Dim>(choice_), settings());
      test.void_ratio = choice_.void_ratio.value_or(std::nan(""));
      for (auto const& [name, value] : test.points.quantities(0)) {
        if (name == "void_ratio") test.void_ratio = value;
      }
      test.has_moved = test.verdict.acceptable();
    }
    record();
    if (targets != nullptr) {
      for (std::size_t row = 0; row < targets->table.rows(); ++row) {
        for (auto& test : tests_) test.path->load(targets->row(row));
        if (!go(1.0, 0.1)) break;
      }
      return;
    }
    double const sign = choice_.extension ? -1.0 : 1.0;
    if (choice_.cycles == 0) {
      double const first = std::min(1e-5, choice_.strain);  // a row for the stiffness at small strain
      static_cast<void>(go(sign * first, first) && go(sign * (choice_.strain - first), choice_.increment));
      return;
    }
    for (int leg = 0; leg <= 2 * choice_.cycles; ++leg) {
      bool const outer = leg == 0 || leg == 2 * choice_.cycles;
      if (!go((leg % 2 == 0 ? sign : -sign) * (outer ? 1.0 : 2.0) * choice_.amplitude,
              std::min(choice_.increment, choice_.amplitude / 10.0)))
        break;
    }
  }

  std::deque<Test> const& tests() const { return tests_; }
  /// Those that came to the end of the path or, where none did, those that came farthest; all have as many rows.
  std::vector<Test const*> farthest() const {
    auto const finished = [](Test const& test) { return test.verdict.acceptable(); };
    bool const any = std::ranges::any_of(tests_, finished);
    auto const& longest = *std::ranges::max_element(tests_, {}, [](Test const& test) { return test.rows.size(); });
    std::vector<Test const*> found;
    for (auto const& test : tests_) {
      if (any ? finished(test) : test.rows.size() == longest.rows.size()) found.push_back(&test);
    }
    return found;
  }

  /// Rows of these tests, for their mean. Where none finished, each ended within its last increment at a length of its
  /// own: that row is left out. Tests that have no other than it and the start give the rows of the first.
  std::vector<std::vector<LaboratoryRow<Dim>>> farthest_rows() const {
    std::vector<std::vector<LaboratoryRow<Dim>>> found;
    for (auto const* test : farthest()) found.push_back(test->rows);
    constexpr double slight = 1e-9;
    auto const differs = [&](auto const& rows) {
      return !rows.empty() &&
             std::abs(rows.back().length - found.front().back().length) > slight * std::abs(rows.back().length);
    };
    if (std::ranges::none_of(found, differs)) return found;
    if (found.front().size() < 3) return {found.front()};
    for (auto& rows : found) rows.pop_back();
    return found;
  }

 private:
  scarp::PathSettings settings() const { return {.tolerance = choice_.tolerance}; }

  void consolidate() {
    for (auto& test : tests_)
      test.path.emplace(test.points, consolidation_of<Dim>(*choice_.consolidation, choice_.k0), settings());
    for (int k = 0; k < 20; ++k) advance(0.05);
    for (auto& test : tests_) {
      if (!test.verdict.acceptable())
        examples::print(stderr,
                        "rve_lab: the consolidation to {:.6g} Pa with K0 {} ended after {:.0f} % of the way: choose "
                        "stresses that the material bears\n",
                        *choice_.consolidation, choice_.k0, 100.0 * test.path->length());
      test.total = {};
    }
  }

  void advance(double length) {
    executor_.for_each(static_cast<int>(tests_.size()),
                       [&](int k) { tests_[static_cast<std::size_t>(k)].advance(length, executor_); });
  }

  /// \return whether a test goes on
  bool go(double length, double increment) {
    auto const count = static_cast<int>(std::ceil(std::abs(length) / increment - 1e-9));
    bool goes_on = true;
    for (int k = 0; k < count && goes_on; ++k) {
      advance(length / count);
      record();
      goes_on = std::ranges::any_of(tests_, [](Test const& test) { return test.verdict.acceptable(); });
    }
    return goes_on;
  }

  void record() {
    constexpr int sheared = Dim == 2 ? 2 : 4;
    for (std::size_t k = 0; k < tests_.size(); ++k) {
      auto& test = tests_[k];
      if (!std::exchange(test.has_moved, false)) continue;
      LaboratoryRow<Dim> const row{test.path->length(), test.path->stress(0), test.path->strain(0)};
      test.rows.push_back(row);
      log_.add(static_cast<double>(k), row.length, row.axial_strain(), row.volumetric_strain(), row.strain(sheared),
               -row.stress(Dim - 1), -row.stress(0), row.stress(sheared), row.p(), row.q(), row.friction() / degree,
               row.void_ratio(test.void_ratio));
    }
  }

  Laboratory const& choice_;
  std::deque<Test> tests_{};  // whose paths refer to their points
  scarp::ThreadExecutor executor_;
  scarp::CsvLog log_;
};

}  // namespace rve_lab
