// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scarp/constitutive/rve_quantities.hpp"
#include "scarp/core/described.hpp"
#include "scarp/io/pvd.hpp"
#include "scarp/io/vtu.hpp"
#include "scarp/observe/detail/element_fields.hpp"
#include "scarp/observe/observers.hpp"

namespace scarp {

/// Writes the fields of a scene as a VTU series: displacement at the nodes; at the elements (the mean of
/// their points, weighted by volume; the worst status)
/// Cauchy stress [Pa] tension positive, logarithmic volumetric (contraction positive) and deviatoric strain, status
/// and the given quantities. Every file is complete when it appears; the PVD's time is load / load_unit.
template <class PointQuantities = NoQuantities>
class FieldSeries : public NeverStops {
 public:
  /// frames: files are written at load 0 and then whenever the load has grown by to / frames
  FieldSeries(std::filesystem::path folder, double to, int frames, double load_unit)
      : folder_(std::move(folder)),
        between_(require_positive("distance between frames", to / frames)),
        end_(to),
        load_unit_(load_unit),
        series_(folder_, "fields") {}

  template <class Problem>
  void attempted(Problem const& problem, StepReport const& report) {
    if (!report.verdict.acceptable()) return;
    bool const due = report.load >= next_ || report.load >= end_;
    if (!due || report.load <= last_) return;
    while (next_ <= report.load) next_ += between_;
    last_ = report.load;
    write(problem, report.load);
  }

  /// Writes the last state of a run whose fault has moved and that stopped between two frames; its statuses are those
  /// of the points' last answers, also where these were refused.
  template <class Problem>
  void ended(Problem const& problem, double load) {
    if (!(load > 0.0 && load > last_)) return;
    last_ = load;
    write(problem, load);
  }

  SCARP_MEMBERS_EXCEPT((folder_, between_, end_, load_unit_, quantities_), series_, next_, last_, frame_)

 private:
  template <class Problem>
  void write(Problem const& problem, double load) {
    auto const& grid = problem.discretisation();
    auto const& mesh = grid.mesh();
    using Grid = std::remove_cvref_t<decltype(grid)>;
    std::vector<double> displacement;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      auto const moved = (grid.positions()[n] - mesh.nodes[n]).eval();
      displacement.insert(displacement.end(), moved.begin(), moved.end());
    }
    auto const at_elements = detail::element_fields(problem, quantities_);
    VtuFields fields;
    fields.at_nodes.push_back({"displacement", Grid::dim, std::span<double const>(displacement), {}});
    std::vector<std::string> components{"xx", "yy", "xy"};
    if constexpr (Grid::dim == 3) components = {"xx", "yy", "zz", "yz", "zx", "xy"};
    fields.at_elements.push_back(
        {"stress", voigt_size<Grid::dim>, std::span<double const>(at_elements.stress), components});
    fields.at_elements.push_back({"volumetric_strain", 1, std::span<double const>(at_elements.volumetric), {}});
    fields.at_elements.push_back({"deviatoric_strain", 1, std::span<double const>(at_elements.deviatoric), {}});
    fields.at_elements.push_back({"status", 1, std::span<int const>(at_elements.status), {}});
    for (auto const& [name, column] : at_elements.quantities)
      fields.at_elements.push_back({name, 1, std::span<double const>(column), {}});
    auto const file = std::filesystem::path("fields") / fmt::format("step_{:04}.vtu", frame_++);
    write_vtu(folder_ / file, mesh, grid.positions(), fields);
    series_.add(load / load_unit_, file);
  }

  std::filesystem::path folder_;
  double between_;
  double end_;
  double load_unit_;
  PvdSeries series_;
  PointQuantities quantities_;
  double next_ = 0.0;
  double last_ = -1.0;
  int frame_ = 0;
};

}  // namespace scarp
