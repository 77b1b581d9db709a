// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <vector>

#include "scarp/io/csv.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/observe/outcrop.hpp"

namespace scarp {

/// Settlement of the ground surface at every accepted step at which the load has grown by to / profiles.
class SurfaceLog : public NeverStops {
 public:
  SurfaceLog(std::filesystem::path const& file, std::vector<int> nodes, double to, int profiles, double load_unit,
             CsvStart start = CsvStart::anew)
      : log_(file, {"throw_over_depth", "x_initial", "x", "settlement"}, start),
        nodes_(std::move(nodes)),
        between_(require_positive("distance between profiles", to / profiles)),
        end_(to),
        load_unit_(load_unit) {}

  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable() || (report.load < next_ && report.load < end_)) return;
    while (next_ <= report.load) next_ += between_;
    auto const& grid = problem.discretisation();
    for (auto const& point : surface_profile(grid.mesh(), grid.positions(), nodes_)) {
      log_.add(report.load / load_unit_, point.x_initial, point.x, point.settlement);
    }
  }

  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("log", self.log_);
    visit("next", self.next_);
  }

 private:
  CsvLog log_;
  std::vector<int> nodes_;
  double between_;
  double end_;
  double load_unit_;
  double next_ = 0.0;
};

}  // namespace scarp
