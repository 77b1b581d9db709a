// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/bvp/attached_field.hpp"
#include "scarp/bvp/detail/corner_field.hpp"
#include "scarp/bvp/detail/pore_boundaries.hpp"
#include "scarp/bvp/detail/pore_flow.hpp"
#include "scarp/bvp/detail/time_error.hpp"
#include "scarp/bvp/detail/vapour.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/bvp/pore_water_settings.hpp"
#include "scarp/constitutive/hydraulic.hpp"
#include "scarp/core/described.hpp"

namespace scarp {

/// Water that fills the pores of a ground and flows through them (Biot 1941), as a field that is attached to its
/// elements. Stresses of the materials are effective ones; the excess u of the pore pressure over that of water at rest
/// [Pa], positive in compression, is unknown at the corners:
/// \f$ \int (\sigma' - u I):\nabla w\,dv = W_{ext}, \qquad
///     \int q \left(\frac{\dot J}{J} + S\,\dot u\right) dv + \int \frac{k}{\mu} \nabla q \cdot\nabla u\,dv = Q_{in} \f$
/// Force and volume are integrated as the ground is, S and k are those of the `HydraulicProvider`, time steps are
/// implicit (backward Euler), and volumes are balanced in totals since the start. Weight is a dead load of what water
/// does not carry: below the water table give the ground its buoyant unit weight.
///
/// Quadratic elements have Taylor and Hood's pressures. Those of linear ones are stabilised by their projection onto
/// the mean of the element (Dohrmann and Bochev 2004; White and Borja 2008),
/// \f$ \frac{1}{2G} \int (q - \bar q)(\Delta u - \overline{\Delta u})\,dv \f$. Steps that are shorter than elements of
/// size h can show (Vermeer and Verruijt 1981, with the modulus 2G) smooth changes of pressure as longer ones do, by
/// \f$ \max\left(\frac{h^2}{12 G} - \Delta t \frac{k}{\mu}, 0\right) \int \nabla q \cdot \nabla \Delta u\,dv \f$.
///
/// With `at_rest`, u is 0 above the water table, and water cavitates: where its pressure p is below p_c, vapour takes
/// the share (p_c - p)/K_v of the volume, lumped at the corners: p falls by 1 kPa for a tenth of the volume.
/// \code
/// DefaultGrid<Tri6> const grid(mesh);
/// PoreWater water(grid, ConstantPermeability{.conductivity = 1e-8}, {.shear_modulus = 4e6});
/// water.drain({"top"});
/// Model model(grid);
/// model.attach(water);
/// \endcode
/// \tparam GridType a `Discretisation`
template <class GridType, HydraulicProvider Flow>
class PoreWater {
  using Field = detail::CornerField<GridType>;
  using Values = Eigen::VectorXd;
  using Matrix = Eigen::SparseMatrix<double>;

 public:
  static constexpr int dim = GridType::dim;               ///< of the mesh
  static constexpr bool is_field = true;                  ///< see FieldAttachment
  static constexpr double vapour_modulus = 1e4;           ///< [Pa], volume over the pressure that vapour lacks
  using Sides = std::initializer_list<std::string_view>;  ///< names of boundaries

  /// grid: that of the problem, before its first step. Boundaries are impermeable unless they are given.
  /// \throws InputError for settings or a flow outside of their range
  PoreWater(GridType grid, Flow const& flow, PoreWaterSettings settings);

  /// Another flow and void ratio for one region.
  /// \throws InputError for an unknown region, a flow outside of its range and a void ratio that is not positive
  void region(std::string_view name, Flow const& flow, double void_ratio) {
    flow_.set(field_, name, flow, void_ratio);
    step_.is_known = false;
  }
  /// Takes the water out of a region, such as a footing.
  /// \throws InputError for an unknown region, and boundaries there with a pressure or an inflow
  void exclude(std::string_view region) { exclude(field_.elements_of(region)); }
  /// Lets water leave through boundaries against the pressure of water at rest.
  /// \throws InputError for an unknown boundary, and one with another pressure
  void drain(Sides sides) { prescribe(sides, 0.0); }
  /// Holds the excess pressure [Pa] of boundaries, such as below a pond, times an amplitude over the load factor.
  /// \throws InputError for an unknown boundary, a pressure that is not finite, and one with another pressure
  void prescribe(Sides sides, double pressure, TimeFunction const& amplitude = TimeFunction::constant(1.0)) {
    require_finite("excess pore pressure of a boundary", pressure);
    boundaries_.prescribe(field_.corners_on(sides), pressure, amplitude, describe_corner());
  }
  /// Lets water in through boundaries, or out: volume per initial area and time [m/s], times an amplitude.
  /// \throws InputError for an unknown boundary, one of ground without water, and a rate that is not finite
  void inflow(Sides sides, double rate, TimeFunction const& amplitude = TimeFunction::constant(1.0)) {
    require_finite("rate of inflow", rate);
    boundaries_.let_in(rate * field_.areas(sides), amplitude, describe_corner());
  }

  GridType const& grid() const { return field_.grid(); }  ///< Mesh and elements, committed.
  double time() const { return then_; }                   ///< of the committed state [s]
  /// Excess pressures [Pa] at all nodes, committed; in the middle of a side the mean of its corners.
  std::vector<double> pressures() const { return field_.at_nodes(pressure_); }
  std::vector<double> const& void_ratios() const { return flow_.void_ratios(); }  ///< of the points, committed
  double vapour() const { return vapour_ ? vapour_->volumes(view(pressure_)).sum() : 0.0; }  ///< committed volume [m3]
  double expelled() const { return -boundaries_.sum_of_given(left_); }  ///< [m3] through given pressures, committed
  // What an attachment needs.
  /// Pressures over scale() [m], without the given ones; their balance is that of volumes times scale() [N].
  int extra_dofs() const { return detail::count(boundaries_.unknowns()); }
  double scale() const { return scale_; }                         ///< [Pa/m]
  double thickness() const { return field_.grid().thickness(); }  ///< of the mesh [m]
  Verdict add_forces(std::vector<Vector<dim>> const&, Values const& increment, Values& forces) {
    evaluate(increment);
    forces.head(trial_.of_ground.size()) += trial_.of_ground;
    forces.tail(extra_dofs()) -= scale_ * trial_.left(boundaries_.unknowns());
    return {};
  }
  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const;
  void commit(std::vector<Vector<dim>> const&, Values const& increment);
  // What a field needs.
  /// \throws InputError for a clock that goes back, time in impermeable ground, and inflow without an outlet
  void at(double load);
  double next_knot(double load) const { return std::min(settings_.clock.next_knot(load), boundaries_.next_knot(load)); }
  FieldTimeError time_error() const {  ///< of the last evaluated step [Pa]
    return {trial_.time_error, settings_.largest_time_error, view(pressure_).cwiseAbs().maxCoeff()};
  }
  std::string name() const { return "water"; }
  /// Volumes that are not balanced, over those displaced in the step by strain, flow, inflow, vapour and the changes of
  /// pressure over the shear modulus, or a thousandth of the most of any step before, Euclidean norms.
  double residual(Values const& unbalanced) const {
    double const volume = unbalanced.norm() / scale_;
    return volume == 0.0 ? 0.0 : volume / std::max(trial_.displaced, 1e-3 * most_displaced_);
  }
  void limit(Values const& last, Values& next) const {  ///< Where vapour begins, see `FieldAttachment`.
    if (vapour_) vapour_->limit(boundaries_.unknowns(), view(pressure_), scale_, last.tail(extra_dofs()), next);
  }
  std::string describe(int number) const {
    return "pore pressure at " + field_.describe(boundaries_.unknowns()[detail::index(number)]);
  }
  std::vector<NodalField> nodal_fields() const { return {{"excess_pore_pressure", pressures()}}; }
  /// Committed force [N] of the pressures on the nodes of the mesh.
  Values ground_force() const {
    Values force;
    field_.grid().internal_force(Values::Zero(field_.grid().dof_count()),
                                 detail::stresses_of<dim>(field_.shapes() * view(pressure_)), force);
    return force;
  }

  void after_loading() { step_.is_known = false; }  ///< The next step computes its matrices anew.
  SCARP_MEMBERS_EXCEPT((settings_, boundaries_, vapour_, scale_, step_, trial_), field_, flow_, time_error_, pressure_,
                       left_, then_, most_displaced_)

 private:
  /// What one step has in common.
  struct Step : detail::FlowStep {
    bool is_known = false;
    double end = 0.0;  ///< [s]
    Values given{};    ///< pressures of corners where they are given [Pa]
    Values inflow{};   ///< volume [m3] into the corners' shares
  };
  /// What belongs to an increment.
  struct Trial {
    Values increment, of_ground, pressure, left;
    Values growth;  ///< of the points' volumes, over those at the start of the step
    std::vector<VoigtStress<dim>> stresses;
    double displaced = 0.0, time_error = 0.0;
  };

  static auto view(std::vector<double> const& values) { return detail::viewed(values); }
  Values change_of_unknowns() const { return (trial_.pressure - view(pressure_))(boundaries_.unknowns()); }
  void evaluate(Values const& increment);
  auto describe_corner() const {
    return [this](int corner) { return field_.describe(corner); };
  }
  void exclude(std::vector<int> const& elements) {
    auto field = field_;
    boundaries_.take_out(field.exclude(elements), describe_corner());
    field_ = std::move(field);
    step_.is_known = false;
    if (settings_.at_rest) vapour_.emplace(field_, *settings_.at_rest, vapour_modulus);
  }

  PoreWaterSettings settings_;
  Field field_;
  detail::PoreFlow<Field, Flow> flow_;
  detail::PoreBoundaries boundaries_;
  std::optional<detail::Vapour> vapour_;
  detail::TimeError time_error_;
  double scale_ = 0.0;
  std::vector<double> pressure_;  ///< of the corners, excess [Pa]
  std::vector<double> left_;      ///< by which the corners' shares have outgrown their water since the start [m3]
  double then_ = 0.0;             ///< time of the committed state [s]
  double most_displaced_ = 0.0;
  Step step_;
  Trial trial_;
};

template <class GridType, HydraulicProvider Flow>
PoreWater<GridType, Flow>::PoreWater(GridType grid, Flow const& flow, PoreWaterSettings settings)
    : settings_(detail::validated(settings)),
      field_(std::move(grid)),
      flow_(field_, flow, settings.void_ratio),
      boundaries_(field_.count()),
      scale_(field_.over_mean_size(settings.shear_modulus)),
      pressure_(detail::index(field_.count()), 0.0),
      left_(pressure_.size(), 0.0),
      then_(settings_.beginning()) {
  if (!settings.at_rest) return;
  auto const dry = detail::above(field_, settings.at_rest->level);
  boundaries_.prescribe(dry.corners, 0.0, TimeFunction::constant(1.0), describe_corner());
  exclude(dry.elements);
}

template <class GridType, HydraulicProvider Flow>
void PoreWater<GridType, Flow>::at(double load) {
  double const end = settings_.clock(load);
  if (!(end >= then_))
    reject(
        "the clock of the pore water goes from {} s to {} s at the load factor {} (time does not go back): order its "
        "times",
        then_, end, load);
  if (boundaries_.lacks_outlet())
    reject(
        "water flows through boundaries of ground that is impermeable everywhere else (nothing sets its pressure): "
        "drain a boundary, or prescribe its pressure");
  double const duration = end - then_;
  step_.given = boundaries_.pressures(load);
  step_.inflow = duration * boundaries_.inflow(load);
  if (step_.is_known && step_.end == end) return;
  static_cast<detail::FlowStep&>(step_) = flow_.step(field_, duration, settings_.shear_modulus);
  step_.end = end;
  step_.is_known = true;
}

template <class GridType, HydraulicProvider Flow>
void PoreWater<GridType, Flow>::evaluate(Values const& increment) {
  auto const& grid = field_.grid();
  Values const move = increment.head(grid.dof_count());
  trial_.increment = increment;
  trial_.pressure = step_.given;
  trial_.pressure(boundaries_.unknowns()) =
      view(pressure_)(boundaries_.unknowns()) + scale_ * increment.tail(extra_dofs());
  trial_.time_error = time_error_.of(change_of_unknowns(), step_.end - then_);
  Values const at_points = field_.shapes() * trial_.pressure;
  std::vector<Gradient<dim>> gradients(detail::index(grid.point_count()));
  grid.gradients(move, gradients);
  trial_.growth.resize(at_points.size());
  trial_.stresses = detail::stresses_of<dim>(at_points);
  Values displaced = (at_points - field_.shapes() * view(pressure_)).cwiseAbs() / settings_.shear_modulus;
  for (Eigen::Index point = 0; point < at_points.size(); ++point) {
    auto const& gradient = gradients[static_cast<std::size_t>(point)];
    trial_.growth(point) = GridType::follows_motion ? detail::volume_growth<dim>(gradient) : gradient.trace();
    displaced(point) += gradient.norm();
  }
  grid.internal_force(move, trial_.stresses, trial_.of_ground);
  Values const flown = step_.flow * trial_.pressure;
  Values const grown = step_.volumes.cwiseProduct(trial_.growth);
  trial_.left = view(left_) + field_.shapes().transpose() * grown + flown +
                step_.change * (trial_.pressure - view(pressure_)) - step_.inflow;
  trial_.displaced =
      (field_.shapes().transpose() * step_.volumes.cwiseProduct(displaced)).norm() + flown.norm() + step_.inflow.norm();
  if (!vapour_) return;
  Values const vapour = vapour_->volumes(trial_.pressure) - vapour_->volumes(view(pressure_));
  trial_.left -= vapour;
  trial_.displaced += vapour.norm();
}

template <class GridType, HydraulicProvider Flow>
void PoreWater<GridType, Flow>::add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
  auto const& grid = field_.grid();
  Values const move = trial_.increment.head(grid.dof_count());
  int const first = static_cast<int>(trial_.increment.size()) - extra_dofs();
  auto const add = [&](Matrix const& part, double factor, auto const& row_of, auto const& column_of) {
    detail::add_block(part, factor, row_of, column_of, entries);
  };
  auto const node = [](int dof) { return dof; };
  auto const water = [&](int corner) { return boundaries_.is_given(corner) ? -1 : first + boundaries_.number(corner); };
  if (GridType::follows_motion) {
    std::vector<VoigtTangent<dim>> const none(trial_.stresses.size(), VoigtTangent<dim>::Zero());
    add(grid.stiffness(move, trial_.stresses, none), 1.0, node, node);
  }
  Matrix const divergence = field_.divergence(move);
  Values const volumes = view(grid.volumes(move));
  Values grown = step_.volumes;
  if (GridType::follows_motion) grown += step_.volumes.cwiseProduct(trial_.growth);
  add(divergence.transpose() * volumes.asDiagonal() * field_.shapes(), -scale_, node, water);
  add(field_.shapes().transpose() * grown.asDiagonal() * divergence, -scale_, water, node);
  add(step_.flow + step_.change, -scale_ * scale_, water, water);
  for (int const corner : boundaries_.unknowns()) {
    double const slope = vapour_ ? vapour_->slope(corner, trial_.pressure(corner)) : 0.0;
    if (slope > 0.0) entries.emplace_back(water(corner), water(corner), -scale_ * scale_ * slope);
  }
}

template <class GridType, HydraulicProvider Flow>
void PoreWater<GridType, Flow>::commit(std::vector<Vector<dim>> const&, Values const& increment) {
  if (trial_.increment.size() != increment.size() || trial_.increment != increment) evaluate(increment);
  time_error_.commit(change_of_unknowns(), step_.end - then_);
  flow_.grow(trial_.growth);
  pressure_.assign(trial_.pressure.begin(), trial_.pressure.end());
  left_.assign(trial_.left.begin(), trial_.left.end());
  most_displaced_ = std::max(most_displaced_, trial_.displaced);
  field_.commit(increment.head(field_.grid().dof_count()));
  then_ = step_.end;
  step_.is_known = false;
}

}  // namespace scarp
