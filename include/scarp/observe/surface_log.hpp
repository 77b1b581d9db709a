// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <vector>

#include "scarp/core/described.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/ground_at_rest.hpp"
#include "scarp/observe/surface_profile.hpp"

namespace scarp {

/// Settlement of the ground surface, also below a footing, at every accepted step at which the load has grown by to /
/// profiles. It counts from the last accepted state that was seen with a load that is not positive, in a run without
/// one from the mesh. `joined` is 0 where a gap separates a point from the row before it.
template <int Dim = 2>
class SurfaceLog : public NeverStops {
 public:
  SurfaceLog(std::filesystem::path const& file, double to, int profiles, double load_unit,
             CsvStart start = CsvStart::anew)
      : log_(file, {"throw_over_depth", "x_initial", "x", "settlement", "joined"}, start),
        between_(require_positive("distance between profiles", to / profiles)),
        end_(to),
        load_unit_(load_unit) {}

  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    rest_.attempted(problem, report);
    if (!report.verdict.acceptable() || (report.load < next_ && report.load < end_)) return;
    while (next_ <= report.load) next_ += between_;
    write(problem, report.load);
  }

  /// Writes the last state of a run that stopped between two profiles.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    if (load > last_) write(problem, load);
  }

  SCARP_MEMBERS_EXCEPT((between_, end_, load_unit_), log_, rest_, next_, last_)

 private:
  template <class Problem>
  void write(Problem const& problem, double load) {
    last_ = load;
    auto const& grid = problem.discretisation();
    for (auto const& point : surface_profile(grid.mesh(), rest_.of(grid.mesh()), grid.positions())) {
      log_.add(load / load_unit_, point.x_initial, point.x, point.settlement, point.joined ? 1 : 0);
    }
  }

  CsvLog log_;
  GroundAtRest<Dim> rest_;
  double between_;
  double end_;
  double load_unit_;
  double next_ = 0.0;
  double last_ = 0.0;
};

}  // namespace scarp
