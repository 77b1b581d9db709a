// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "scarp/core/described.hpp"
#include "scarp/fault/ground_at_rest.hpp"
#include "scarp/fault/surface_profile.hpp"
#include "scarp/io/csv.hpp"

namespace scarp {

/// Settlement of the ground surface, also below a footing, at every accepted step at which the load has grown by to /
/// profiles. It counts from the last accepted state that was seen with a load that is not positive, in a run without
/// one from the mesh. `joined` is 0 where a gap separates a point from the row before it.
template <int Dim = 2>
class SurfaceLog : public NeverStops {
 public:
  /// \throws InputError for an end, a number of profiles or a unit that is not positive
  SurfaceLog(std::filesystem::path const& file, double to, int profiles, double load_unit,
             CsvStart start = CsvStart::anew)
      : log_(file, {"throw_over_depth", "x_initial", "x", "settlement", "joined"}, start),
        schedule_(detail::validated(LoadSchedule{to, profiles, load_unit})) {}

  /// Writes a profile of an accepted state where one is due.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    rest_.attempted(problem, report);
    if (report.verdict.acceptable() && schedule_.takes(report.load)) write(problem, report.load);
  }

  /// Writes the last state of a run that stopped between two profiles.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    if (schedule_.takes_end(load)) write(problem, load);
  }

  SCARP_MEMBERS(log_, rest_, schedule_)

 private:
  template <class Problem>
  void write(Problem const& problem, double load) {
    auto const& grid = problem.grid();
    std::vector<Cells> facets;
    for (auto const& name : ground_boundaries([&](auto const& one) { return grid.has_boundary(one); }))
      facets.push_back(grid.facets(name));
    for (auto const& point : surface_profile(grid.nodes(), facets, rest_.of(grid.nodes()), grid.positions())) {
      log_.add(load / schedule_.unit, point.x_initial, point.x, point.settlement, point.joined ? 1 : 0);
    }
  }

  CsvLog log_;
  GroundAtRest<Dim> rest_;
  LoadSchedule schedule_;
};

}  // namespace scarp
