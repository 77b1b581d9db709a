// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <string_view>
#include <vector>

#include "scarp/bvp/detail/corner_field.hpp"
#include "scarp/bvp/grid.hpp"
#include "scarp/constitutive/hydraulic.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp::detail {

/// What the flow of water through a ground has in common within one step.
struct FlowStep {
  Eigen::SparseMatrix<double> flow;    ///< volume that leaves a corner's share by the pressures at the end [m3/Pa]
  Eigen::SparseMatrix<double> change;  ///< by their change: storage and stabilisation [m3/Pa]
  Eigen::VectorXd volumes;             ///< of the points, committed [m3]
};

/// Hydraulic properties of the elements, with the void ratios of their points as these evolve.
/// \tparam Field a `CornerField`
template <class Field, HydraulicProvider Flow>
class PoreFlow {
 public:
  /// \throws InputError for a flow or a void ratio outside of its range
  PoreFlow(Field const& field, Flow const& flow, double void_ratio)
      : flows_(field.grid().regions().size(), validated(flow)),
        void_ratio_(index(field.grid().point_count()), require_positive(name_of_ratio, void_ratio)) {}

  /// Gives one region its own flow. \throws InputError as the constructor, and for an unknown region
  void set(Field const& field, std::string_view region, Flow const& flow, double void_ratio) {
    int const number = region_number(field.grid(), region);
    require_positive(name_of_ratio, void_ratio);
    flows_[index(number)] = validated(flow);
    for (int point = 0; point < field.grid().point_count(); ++point)
      if (field.region_of(Field::element_of(point)) == number) void_ratio_[index(point)] = void_ratio;
  }
  std::vector<double> const& void_ratios() const { return void_ratio_; }  ///< of the points

  /// Makes pores grow with their points. growth: of the volume, over that at the start; grains keep theirs
  void grow(Eigen::VectorXd const& growth) {
    for (std::size_t point = 0; point < void_ratio_.size(); ++point)
      void_ratio_[point] += (1.0 + void_ratio_[point]) * growth(static_cast<Eigen::Index>(point));
  }

  /// A step from the committed state that takes so long [s]; shear_modulus [Pa]: of the ground
  /// \throws InputError where time passes in ground that is impermeable everywhere, and for a flow whose mobility or
  /// storage is negative or no number
  FlowStep step(Field const& field, double duration, double shear_modulus) const {
    auto const& grid = field.grid();
    typename Field::Triplets flow;
    typename Field::Triplets change;
    bool is_permeable = false;
    field.for_each_cell([&](auto const& cell) {
      double const mobility = flow_in(field, cell.number).mobility(mean_void_ratio(field, cell.number));
      double const passes = duration * require_not_negative("mobility of pore water", mobility);
      double const shown = cell.squared_size / (12.0 * shear_modulus);
      is_permeable = is_permeable || passes > 0.0;
      typename Field::CornerMatrix steadying = std::max(shown - passes, 0.0) * cell.gradients;
      if (Field::is_equal_order) steadying += cell.deviations / (2.0 * shear_modulus);
      for (int a = 0; a < count(cell.corners); ++a) {
        for (int b = 0; b < count(cell.corners); ++b) {
          flow.emplace_back(cell.corners[index(a)], cell.corners[index(b)], passes * cell.gradients(a, b));
          change.emplace_back(cell.corners[index(a)], cell.corners[index(b)], steadying(a, b));
        }
      }
    });
    if (duration > 0.0 && !is_permeable)
      reject(
          "{} s pass in ground that is impermeable (its hydraulic conductivity is 0): give it one, or stop the clock "
          "for undrained steps",
          duration);
    auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
    FlowStep step{assembled(field, flow), assembled(field, change), viewed(volumes)};
    Eigen::VectorXd storage = step.volumes;
    for (int point = 0; point < grid.point_count(); ++point)
      storage(point) *=
          require_not_negative("storage of pore water", flow_in(field, Field::element_of(point)).storage(pores(point)));
    step.change += typename Field::Matrix(field.shapes().transpose() * storage.asDiagonal() * field.shapes());
    return step;
  }

  SCARP_MEMBERS_EXCEPT((flows_), void_ratio_)

 private:
  static constexpr std::string_view name_of_ratio = "void ratio of the ground with pore water";

  Flow const& flow_in(Field const& field, int element) const { return flows_[index(field.region_of(element))]; }
  /// Void ratio that counts: where a material shrinks to its grains and beyond, pores stay open a little.
  double pores(int point) const { return std::max(void_ratio_[index(point)], 0.01); }
  double mean_void_ratio(Field const& field, int element) const {
    int const first = field.grid().first_point(element);
    int const end = field.grid().first_point(element + 1);
    double sum = 0.0;
    for (int point = first; point < end; ++point) sum += pores(point);
    return sum / (end - first);
  }
  static typename Field::Matrix assembled(Field const& field, typename Field::Triplets const& entries) {
    typename Field::Matrix matrix(field.count(), field.count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  std::vector<Flow> flows_;         ///< of the regions
  std::vector<double> void_ratio_;  ///< of the points
};

}  // namespace scarp::detail
