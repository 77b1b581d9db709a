// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "scarp/constitutive/rve_quantities.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/geo.hpp"
#include "scarp/io/pvd.hpp"
#include "scarp/io/vtu.hpp"
#include "scarp/observe/observers.hpp"
#include "scarp/run/visit_point.hpp"

namespace scarp {

/// Gradient of the committed with respect to the initial position at a point; what its material sees may differ, see
/// MeanDilatation.
template <class DiscretisationType>
Tensor<DiscretisationType::dim> total_deformation(DiscretisationType const& discretisation, int point) {
  using Element = typename std::remove_cvref_t<decltype(discretisation.mesh())>::ElementType;
  constexpr int dim = DiscretisationType::dim;
  constexpr int per_element = DiscretisationType::points_per_element;
  auto const& nodes = discretisation.mesh().elements[static_cast<std::size_t>(point / per_element)];
  auto const shape = spatial_shape<Element>(corners<Element, dim>(nodes, discretisation.mesh().nodes),
                                            DiscretisationType::local_point(point));
  return corners<Element, dim>(nodes, discretisation.positions()).transpose().lazyProduct(shape.gradients);
}

/// Writes the fields of a plane scene as a VTU series: displacement at the nodes; at the elements (their first point)
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
    std::size_t const elements = mesh.elements.size();
    std::vector<double> displacement;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      auto const moved = (grid.positions()[n] - mesh.nodes[n]).eval();
      displacement.insert(displacement.end(), moved.begin(), moved.end());
    }
    std::vector<double> stresses;
    std::vector<double> volumetric;
    std::vector<double> deviatoric;
    std::vector<int> status;
    std::map<std::string, std::vector<double>> named;
    for (std::size_t e = 0; e < elements; ++e) {
      int const point = Grid::points_per_element * static_cast<int>(e);
      auto const stress = committed_stress(problem, point);
      stresses.insert(stresses.end(), stress.begin(), stress.end());
      auto const strain = geo::plane_strain(total_deformation(grid, point));
      volumetric.push_back(strain.volumetric);
      deviatoric.push_back(strain.deviatoric);
      status.push_back(static_cast<int>(problem.responses()[static_cast<std::size_t>(point)].verdict.status));
      visit_point(problem, point, [&](auto const& provider, auto const& state) {
        for (auto const& [name, value] : quantities_(provider, state)) {
          auto& column = named[std::string(name)];
          column.resize(elements, std::numeric_limits<double>::quiet_NaN());
          column[e] = value;
        }
      });
    }
    VtuFields fields;
    fields.at_nodes.push_back({"displacement", Grid::dim, std::span<double const>(displacement), {}});
    fields.at_elements.push_back({"stress", 3, std::span<double const>(stresses), {"xx", "yy", "xy"}});
    fields.at_elements.push_back({"volumetric_strain", 1, std::span<double const>(volumetric), {}});
    fields.at_elements.push_back({"deviatoric_strain", 1, std::span<double const>(deviatoric), {}});
    fields.at_elements.push_back({"status", 1, std::span<int const>(status), {}});
    for (auto const& [name, column] : named)
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
