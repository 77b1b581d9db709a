// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "scarp/bvp/grid.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/observe/observers.hpp"

namespace scarp {

/// The committed element with the least mean ratio at any of its points.
/// region: whose elements count; empty for all
/// \throws InputError for an unknown region
template <int Dim>
Distortion<Dim> largest_distortion(Grid<Dim> const& grid, std::string_view region = {}) {
  int const number = region.empty() ? -1 : region_number(grid, region);
  Distortion<Dim> worst;
  for (int point = 0; point < grid.point_count(); ++point) {
    if (!region.empty() && grid.site(point, 0.0).region != number) continue;
    auto const here = grid.distortion(point);
    if (worst.element < 0 || !(here.mean_ratio >= worst.mean_ratio)) worst = here;
  }
  return worst;
}

/// Reports when an accepted step has brought the least mean ratio below `limit`, and again each time it has halved.
template <int Dim>
class DistortionWarning : public NeverStops {
 public:
  using Report = std::function<void(Distortion<Dim> const&)>;  ///< receives the element with the least mean ratio

  /// limit: mean ratio below which the first report is made
  /// region: whose elements count; empty for all
  /// \throws InputError unless the limit is positive
  explicit DistortionWarning(Report report, double limit = 0.2, std::string region = {})
      : report_(std::move(report)),
        region_(std::move(region)),
        limit_(require_positive("mean ratio that is warned of", limit)) {}

  /// Reports an accepted state whose least mean ratio has fallen below the limit.
  /// \throws InputError for a region that the mesh does not have
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    auto const worst = largest_distortion(problem.grid(), region_);
    if (worst.mean_ratio >= limit_) return;
    limit_ = worst.mean_ratio / 2.0;
    report_(worst);
  }

  SCARP_MEMBERS_EXCEPT((report_, region_), limit_)

 private:
  Report report_;
  std::string region_;
  double limit_;
};

}  // namespace scarp
