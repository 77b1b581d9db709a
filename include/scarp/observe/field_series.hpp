// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "scarp/bvp/attached_field.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/status.hpp"
#include "scarp/io/vtu.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/run/root_rank.hpp"
#include "scarp/tensor/geo.hpp"

namespace scarp {

namespace detail {

/// A mean in the making.
struct Mean {
  double sum = 0.0;
  double weight = 0.0;
  void add(double share, double value) {
    sum += share * value;
    weight += share;
  }
};

/// One number for each element; stress as many as Voigt's order has.
struct ElementFields {
  std::vector<double> stress;  ///< [Pa], tension positive
  std::vector<double> volumetric;
  std::vector<double> deviatoric;
  std::vector<int> status;                                ///< the worst
  std::map<std::string, std::vector<double>> quantities;  ///< NaN where no point has the quantity
};

/// Means over the elements' points of what is committed, weighted by the points' present volumes.
template <class Problem>
ElementFields element_fields(Problem const& problem) {
  constexpr int dim = Problem::dim;
  auto const& grid = problem.grid();
  std::size_t const elements = index(grid.cells().count());
  ElementFields fields;
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  auto const quantities = own_quantities(problem);
  for (std::size_t e = 0; e < elements; ++e) {
    VoigtStress<dim> stress = VoigtStress<dim>::Zero();
    geo::Strain strain{};
    std::map<std::string, Mean> means;  // of the points that have the quantity
    Status worst = Status::ok;
    double whole = 0.0;
    int const element = static_cast<int>(e);
    for (int point = grid.first_point(element); point < grid.first_point(element + 1); ++point) {
      double const volume = volumes[static_cast<std::size_t>(point)];
      whole += volume;
      auto const here = geo::strain<dim>(grid.deformation(point));
      strain.volumetric += volume * here.volumetric;
      strain.deviatoric += volume * here.deviatoric;
      worst = std::max(worst, problem.responses()[static_cast<std::size_t>(point)].verdict.status);
      visit_point(problem, point, [&](auto const& points, int number) {
        stress += volume * points.committed_stress(number);
        auto const& own = quantities[static_cast<std::size_t>(point)];
        for (auto const& [name, value] : own ? *own : points.quantities(number))
          means[std::string(name)].add(volume, value);
      });
    }
    stress /= whole;
    fields.stress.insert(fields.stress.end(), stress.begin(), stress.end());
    fields.volumetric.push_back(strain.volumetric / whole);
    fields.deviatoric.push_back(strain.deviatoric / whole);
    fields.status.push_back(static_cast<int>(worst));
    for (auto const& [name, mean] : means) {
      auto& column = fields.quantities[name];
      column.resize(elements, std::numeric_limits<double>::quiet_NaN());
      column[e] = mean.sum / mean.weight;
    }
  }
  return fields;
}

}  // namespace detail

/// Writes the fields of a scene as a VTU series: displacement and fields of what is attached at the nodes; at the
/// elements (the mean of their points, weighted by volume; the worst status)
/// Cauchy stress [Pa] tension positive, logarithmic volumetric (contraction positive) and deviatoric strain, status
/// and the quantities that the points' providers return. Every file is complete when it appears; the PVD's time is the
/// load in its unit.
class FieldSeries : public NeverStops {
 public:
  /// Files are written at load 0, where a run settles there, and then whenever the load has grown by
  /// schedule.to / schedule.count.
  /// \throws InputError for an end, a number of files or a unit that is not positive
  FieldSeries(std::filesystem::path folder, LoadSchedule const& schedule)
      : folder_(std::move(folder)), schedule_(detail::validated(schedule)), series_(folder_, "fields") {}

  double last() const { return schedule_.last; }  ///< Load that was written last; -1 before the first.

  /// \throws InputError for a quantity that has the name of a field, and for a second run
  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (report.verdict.acceptable() && schedule_.takes(report.load)) write(problem, report.load);
  }

  /// Writes the last state of a run whose fault has moved and that stopped between two frames; its statuses are those
  /// of the points' last responses, also where the attempt was rejected.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    if (schedule_.takes_end(load)) write(problem, load);
  }

  SCARP_MEMBERS_EXCEPT((folder_), schedule_, series_, frame_)

 private:
  template <class Problem>
  void write(Problem const& problem, double load) {
    constexpr int dim = Problem::dim;
    auto const& grid = problem.grid();
    std::vector<double> displacement;
    for (std::size_t n = 0; n < grid.nodes().size(); ++n) {
      auto const moved = (grid.positions()[n] - grid.nodes()[n]).eval();
      displacement.insert(displacement.end(), moved.begin(), moved.end());
    }
    auto const at_elements = detail::element_fields(problem);
    auto const attached = problem.field() ? problem.field()->nodal_fields() : std::vector<NodalField>{};
    VtuFields fields;
    fields.at_nodes.push_back({"displacement", dim, std::span<double const>(displacement), {}});
    for (auto const& [name, values] : attached)
      fields.at_nodes.push_back({name, 1, std::span<double const>(values), {}});
    std::vector<std::string> components{"xx", "yy", "xy"};
    if constexpr (dim == 3) components = {"xx", "yy", "zz", "yz", "zx", "xy"};
    fields.at_elements.push_back({"stress", voigt_size<dim>, std::span<double const>(at_elements.stress), components});
    fields.at_elements.push_back({"volumetric_strain", 1, std::span<double const>(at_elements.volumetric), {}});
    fields.at_elements.push_back({"deviatoric_strain", 1, std::span<double const>(at_elements.deviatoric), {}});
    fields.at_elements.push_back({"status", 1, std::span<int const>(at_elements.status), {}});
    for (auto const& [name, column] : at_elements.quantities) {
      if (std::any_of(fields.at_elements.begin(), fields.at_elements.end(),
                      [&, &own = name](auto const& field) { return field.name == own; }))
        reject("an own quantity is named '{}' (fields of that name are written already): give it another name", name);
      fields.at_elements.push_back({name, 1, std::span<double const>(column), {}});
    }
    auto const file = std::filesystem::path("fields") / fmt::format("step_{:04}.vtu", frame_++);
    std::error_code unmade;  // writing the file rejects it
    std::filesystem::create_directories(folder_ / "fields", unmade);
    write_vtu<dim>(folder_ / file, grid.cells(), grid.positions(), fields);
    series_.add(load / schedule_.unit, file);
  }

  std::filesystem::path folder_;
  LoadSchedule schedule_;
  PvdSeries series_;
  int frame_ = 0;
};

}  // namespace scarp
