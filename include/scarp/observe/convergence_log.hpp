// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <limits>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/io/appended_file.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/io/json.hpp"
#include "scarp/observe/observers.hpp"

namespace scarp {

/// How every attempt at a load step converged, rejected ones included: a row of a table for every iteration, and a
/// second file of JSON lines (`.jsonl`) with all of the solver's data. Each of these has a `kind`: "iteration", or
/// "step", which closes an attempt and has the last residual of every part, where the problem has parts. A rate is the
/// residual over that of the iteration before; times are wall time [s].
class ConvergenceLog : public NeverStops {
 public:
  /// \throws FileError when a file cannot be written, InputError for a table that does not end in .csv
  ConvergenceLog(std::filesystem::path const& file, LoadMeasure measure, CsvStart start = CsvStart::anew)
      : measure_(detail::validated(std::move(measure))),
        table_(table_file(file),
               {"step", measure_.name, "iteration", "residual", "accepted", "reason", "max_displacement_gradient",
                "dem_steps", "seconds", "seconds_in_points",
                "largest_gradient"},  // as before version 0.2, until version 0.3
               start),
        lines_(std::filesystem::path(file).replace_extension(".jsonl"), "", start == CsvStart::resumed) {}

  /// Writes all iterations of an attempt.
  template <class Problem>
  void attempted(Problem const&, StepReport const& report) {
    ++attempt_;
    int iteration = 0;
    double before = std::numeric_limits<double>::quiet_NaN();
    for (auto const& record : report.history) {
      ++iteration;
      bool const accepted = report.verdict.acceptable() && iteration == report.iterations();
      table_.add(report.step, measure_.of(report.load), iteration, record.residual, accepted ? 1 : 0,
                 name(report.verdict.reason), report.max_displacement_gradient, record.inner_steps, record.seconds,
                 record.material_seconds, report.max_displacement_gradient);
      add(line_of(report, record, iteration, before));
      before = record.residual;
    }
    add(line_of(report));
  }

  SCARP_MEMBERS_EXCEPT((measure_), table_, lines_, attempt_)

 private:
  static std::filesystem::path const& table_file(std::filesystem::path const& file) {
    if (file.extension() != ".csv")
      reject(
          "the table '{}' does not end in .csv (its name with .jsonl is the second file's, which no other log may "
          "have): name it .csv",
          file.string());
    return file;
  }

  void add(JsonObject const& line) { lines_.add(line.text() + '\n'); }

  JsonObject begun(std::string_view kind, StepReport const& report) const {
    JsonObject line;
    line.add("kind", kind).add("attempt", attempt_).add("step", report.step);
    line.add(measure_.name, measure_.of(report.load));
    return line;
  }

  JsonObject line_of(StepReport const& report, IterationRecord const& record, int iteration, double before) const {
    JsonObject points;
    for (auto const status : {Status::ok, Status::fluid, Status::not_converged, Status::failed})
      points.add(name(status), record.points.count(status));
    std::vector<JsonObject> slowest;
    for (auto const& work : record.points.slowest)
      slowest.push_back(JsonObject().add("point", work.point).add("dem_steps", work.inner_steps));
    JsonObject line = begun("iteration", report);
    line.add("iteration", iteration).add("residual", record.residual).add("rate", record.residual / before);
    line.add("linear_residual", record.linear_residual).add("points", points);
    line.add("reason", name(record.verdict.reason)).add("worst_point", record.worst_point).add("slowest", slowest);
    line.add("dem_steps", record.inner_steps).add("seconds", record.seconds);
    return line.add("seconds_in_points", record.material_seconds);
  }

  JsonObject line_of(StepReport const& report) const {
    long inner_steps = 0;
    double in_points = 0.0;
    for (auto const& record : report.history) {
      inner_steps += record.inner_steps;
      in_points += record.material_seconds;
    }
    JsonObject line = begun("step", report);
    line.add("load_increment", report.load_increment).add("accepted", report.verdict.acceptable());
    line.add("status", name(report.verdict.status)).add("reason", name(report.verdict.reason));
    line.add("worst_point", report.worst_point).add("weak_dof", report.weak_dof);
    line.add("iterations", report.iterations()).add("residual", report.residual());
    if (!report.parts.empty()) {
      JsonObject parts;
      for (auto const& part : report.parts) parts.add(part.name, part.value);
      line.add("residuals", parts);
    }
    if (report.time_error > 0.0) line.add("time_error", report.time_error);
    line.add("max_displacement_gradient", report.max_displacement_gradient).add("condition", report.condition);
    line.add("largest_gradient", report.max_displacement_gradient);  // as before version 0.2
    line.add("dem_steps", inner_steps).add("seconds", report.seconds).add("seconds_in_points", in_points);
    return line.add("share_outside_points", 1.0 - in_points / report.seconds);
  }

  LoadMeasure measure_;  ///< checked before a file is made
  CsvLog table_;
  AppendedFile lines_;
  int attempt_ = 0;
};

}  // namespace scarp
