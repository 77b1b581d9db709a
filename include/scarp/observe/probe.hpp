// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>

#include "scarp/core/described.hpp"
#include "scarp/io/csv.hpp"
#include "scarp/observe/field_series.hpp"
#include "scarp/tensor/principal.hpp"

namespace scarp {

/// Follows the packing of one material point: stress and strain in geo view (compression positive), void ratio and
/// fabrics, one row for each accepted step. With an intrinsic length the strain is the mean that the packing sees.
class RveProbe : public NeverStops {
 public:
  /// point: number of a material point, see Grid::nearest_point
  /// \throws InputError for a unit that is not positive
  RveProbe(std::filesystem::path const& file, int point, LoadMeasure measure, CsvStart start = CsvStart::anew)
      : measure_(detail::validated(std::move(measure))),
        log_(file,
             {measure_.name, "eps_q", "eps_v", "p", "q", "contact_fabric", "particle_fabric", "void_ratio", "sxx",
              "syy", "sxy"},
             start),
        point_(point) {}

  /// Writes a row for an accepted state.
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    auto const stress = committed_stress(problem, detail::require_point(problem, point_));
    auto const principal = principal_values<2>(from_voigt_stress<2, double>(stress));
    auto const strain = geo::strain<2>(seen_deformation(problem, point_));
    double fabric_of_contacts = std::numeric_limits<double>::quiet_NaN();
    double fabric_of_particles = fabric_of_contacts;
    double void_ratio = fabric_of_contacts;
    visit_point(problem, point_, [&](auto const& points, int k) {
      for (auto const& [name, value] : points.quantities(k)) {
        if (name == "contact_fabric") fabric_of_contacts = value;
        if (name == "particle_fabric") fabric_of_particles = value;
        if (name == "void_ratio") void_ratio = value;
      }
    });
    log_.add(measure_.of(report.load), strain.deviatoric, strain.volumetric, -(stress(0) + stress(1)) / 2.0,
             principal(0) - principal(1), fabric_of_contacts, fabric_of_particles, void_ratio, -stress(0), -stress(1),
             -stress(2));
  }

  SCARP_MEMBERS_EXCEPT((point_, measure_), log_)

 private:
  /// Deformation that the material of a point receives: where increments are averaged, the mean around the point.
  template <class Problem>
  static Tensor<Problem::dim> seen_deformation(Problem const& problem, int point) {
    auto const& grid = problem.grid();
    auto const* means = problem.points().means();
    if (!means) return grid.deformation(point);
    auto const shares = means->mean().of(point);
    Tensor<Problem::dim> mean = Tensor<Problem::dim>::Zero();
    for (auto const& share : shares) mean += share.weight * grid.deformation(share.point);
    return mean;
  }

  LoadMeasure measure_;  ///< checked before a file is made
  CsvLog log_;
  int point_;
};

}  // namespace scarp
