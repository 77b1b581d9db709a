// SPDX-License-Identifier: BSL-1.0
#include <iostream>

#include "ground.hpp"

namespace dealii_fault {

using scarp::BBar;
using scarp::Reason;
using scarp::Status;
using scarp::Verdict;
using Motion = scarp::UpdatedLagrangian;
using Corners = scarp::Corners<scarp::Quad4, 2>;
using Stresses = std::array<scarp::VoigtStress<2>, cell_points>;
using Tangents = std::array<scarp::VoigtTangent<2>, cell_points>;

namespace {

/// After displacements [m] of the nodes; volumes that are not positive belong to a cell turned inside out.
auto moved(scarp::ElementShapes<scarp::Quad4, cell_points> shapes, Nodal const& displacements) {
  for (auto& [gradients, volume] : shapes) {
    scarp::Tensor<2> const stretch = scarp::Tensor<2>::Identity() + displacements.transpose() * gradients;
    gradients = (gradients * stretch.inverse()).eval();
    volume *= stretch.determinant();
  }
  return shapes;
}

dealii::Vector<double> entries(Nodal const& rows) {
  return dealii::Vector<double>(rows.data(), rows.data() + rows.size());
}

}  // namespace

/// Of all processes.
Verdict Ground::worst(Verdict verdict) const {
  int const code = mpi::max(100 * static_cast<int>(verdict.status) + static_cast<int>(verdict.reason), comm_);
  return {static_cast<Status>(code / 100), static_cast<Reason>(code % 100)};
}

void Ground::start_from_moved() {
  Vector const& all = ghosted(moved_);
  for (auto& cell : cells_) cell.at_start = cell.now = moved(cell.at_rest, nodal(cell, all));
}

/// Points respond to an increment [m] from the start of the step, or show their committed stresses; then forces are
/// added up.
Verdict Ground::evaluate(Vector const& increment, bool responds) {
  Vector const& moves = ghosted(increment);
  Verdict verdict;
  unsigned entry = 0;
  for (auto& cell : cells_) {
    Nodal const move = nodal(cell, moves);
    cell.now = moved(cell.at_start, move);
    cell.gradients = BBar::gradients<Motion>(cell.at_start, Corners(move));
    for (auto const& shape : cell.now) {
      if (!(shape.volume > 0.0)) verdict = {Status::failed, Reason::element_inverted};
    }
    for (auto const& gradient : cell.gradients) {
      for (auto const value : gradient.reshaped()) halo_.local_element(entry++) = value;
    }
  }
  if (verdict = worst(verdict); !verdict.acceptable()) return verdict;
  halo_.update_ghost_values();
  ++evaluations_;
  in_points_.start();
  for (int k = 0; k < points_.size(); ++k) {
    auto const first = 4 * static_cast<dealii::types::global_dof_index>(sites_[static_cast<std::size_t>(k)].index);
    for (unsigned c = 0; c < 4; ++c) points_.gradient(k).reshaped()(c) = halo_(first + c);
  }
  if (responds) {
    auto const report = points_.respond(executor_);
    verdict = report.verdict;
    dem_steps_ += report.inner_steps;
  } else {
    points_.evaluate_committed(executor_);
  }
  in_points_.stop();
  add_up();
  return worst(verdict);
}

void Ground::add_up() {
  internal_ = 0.0, unbalanced_ = 0.0;
  Vector loads = zero();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    auto const& cell = cells_[c];
    Stresses stresses;
    for (unsigned p = 0; p < cell_points; ++p) stresses[p] = points_.stress(static_cast<int>(cell_points * c + p));
    Nodal const force = BBar::forces(cell.now, std::span(std::as_const(stresses)));
    internal_.add(cell.dofs, entries(force));
    loads.add(cell.dofs, entries(cell.loads));
    held_.distribute_local_to_global(entries(force - cell.loads), cell.dofs, unbalanced_);
  }
  for (auto* vector : {&internal_, &unbalanced_, &loads}) vector->compress(dealii::VectorOperation::add);
  support_ = internal_;
  support_ -= loads;
  residual_ = unbalanced_.l2_norm() / std::max(loads.l2_norm(), support_.l2_norm());
}

/// Stiffness at the last evaluation. consistent: with the points' tangents instead of those that they began with
void Ground::assemble(bool consistent) {
  constexpr double floor = 1e-4;  // of the first tangent, as scarp's own scene has it
  matrix_ = 0.0, lift_ = 0.0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Stresses stresses;
    Tangents tangents;
    for (unsigned p = 0; p < cell_points; ++p) {
      int const k = static_cast<int>(cell_points * c + p);
      stresses[p] = points_.stress(k);
      tangents[p] = points_.initial_tangent(k);
      if (consistent) tangents[p] = (1.0 - floor) * points_.tangent(k) + floor * tangents[p];
    }
    Eigen::Matrix<double, 8, 8, Eigen::RowMajor> const local =
        BBar::stiffness<Motion>(cells_[c].now, std::span(std::as_const(stresses)), std::span(std::as_const(tangents)));
    held_.distribute_local_to_global(dealii::FullMatrix<double>(8, 8, local.data()), dealii::Vector<double>(8),
                                     cells_[c].dofs, matrix_, lift_, true);
  }
  matrix_.compress(dealii::VectorOperation::add);
  lift_.compress(dealii::VectorOperation::add);
  factors_ = std::make_unique<dealii::PETScWrappers::SparseDirectMUMPS>(control_, comm_);
}

/// The first one after new entries of the matrix factorises it.
Vector Ground::solved(Vector const& force) {
  in_solver_.start();
  Vector solution = zero();
  factors_->solve(matrix_, solution, force);
  in_solver_.stop();
  return solution;
}

/// Motion [m] for so much more throw: that of the last step, or after a rejected one linear.
/// more [m]: is cut where a point would be strained too much
Vector Ground::predicted(double& more) {
  if (more == 0.0) return zero();
  if (last_throw_ == 0.0) {
    last_ = solved(lift_);
    held_.distribute(last_);
    last_throw_ = 1.0;
  }
  Vector const& moves = ghosted(last_);
  double largest = 0.0;
  for (auto const& cell : cells_) {
    for (auto const& gradient : BBar::gradients<Motion>(cell.at_start, Corners(nodal(cell, moves))))
      largest = std::max(largest, gradient.cwiseAbs().maxCoeff());
  }
  more = std::min(more, last_throw_ * *options_.max_displacement_gradient / mpi::max(largest, comm_));
  Vector increment = last_;
  increment *= more / last_throw_;
  return increment;
}

/// One load step of so much throw [m], perhaps less; balanced and committed, or rolled back.
Verdict Ground::step(double more) {
  bool const newton = options_.newton && more > 0.0;
  points_.discard();
  static_cast<void>(evaluate(zero(), false));
  Vector const before = internal_;
  if (!newton || last_throw_ == 0.0) assemble(false);
  Vector increment = predicted(more);
  if (more > 0.0) increment_ = more;
  mixing_.forget();
  for (int iteration = 1;; ++iteration) {
    Verdict const verdict = evaluate(increment, true);
    ++iterations_;
    if (verdict.status == Status::failed) return verdict;
    if (residual_ <= options_.residual && verdict.acceptable()) break;
    if (iteration == options_.max_iterations || !(residual_ < 10.0))
      return verdict.acceptable() ? Verdict{Status::not_converged, Reason::iterations_spent} : verdict;
    if (newton) assemble(true);
    Vector correction = solved(unbalanced_);
    correction *= -1.0;
    hanging_.distribute(correction);
    if (newton) increment += correction;
    if (!newton) increment = mixing_.next(increment, correction);
  }
  commit(increment, before, more);
  return {};
}

void Ground::commit(Vector const& increment, Vector const& before, double more) {
  for (std::size_t k = 0; k < history_.size(); ++k) {
    auto const& g = points_.own_gradients()[k];
    history_[k].shear += std::hypot(g(0, 0) - g(1, 1), g(0, 1) + g(1, 0));
    history_[k].effort = (history_[k].effort + static_cast<double>(points_.work(static_cast<int>(k)))) / 2.0;
  }
  points_.commit();
  work_ += (before * increment + internal_ * increment) / 2.0;
  moved_ += increment;
  for (auto& cell : cells_) cell.at_start = cell.now;
  throw_ += more;
  ++steps_;
  if (more > 0.0) last_ = increment, last_throw_ = more;
}

/// The ground as prepared is brought into equilibrium.
Verdict Ground::settle() {
  divide_tip();
  build();
  start_from_moved();
  Verdict const verdict = step(0.0);
  rest_ = moved_;
  reaction_at_rest_ = support_ * rates_;
  work_ = 0.0;
  out_ << "ground at rest: " << name(verdict.reason) << ", residual " << residual_ << ", " << iterations_
       << " iterations\n";
  return verdict;
}

/// Elastic ground of depth H settles by \f$ \gamma H^2 / 2M \f$ under its weight, M = E (1 - nu) / ((1 + nu) (1 - 2
/// nu)).
bool Ground::check_block() const {
  constexpr double agreed = 1e-5;  // strains are of the order 1e-6
  double const modulus = options_.young_modulus * 0.75 / (1.25 * 0.5);
  double const exact = 1e-4 * fault_rupture::unit_weight * ground_depth * ground_depth / (2.0 * modulus);
  double const settled = moved_.linfty_norm();
  out_ << "settlement " << settled << " m, closed form " << exact << " m, differ by " << settled / exact - 1.0 << "\n";
  return std::abs(settled / exact - 1.0) < agreed;
}

bool Ground::run(scarp::StopSignal const& stop) {
  constexpr double smallest = 1e-6;  // [m]
  constexpr int adapted_every = 5;   // load steps
  if (options_.resume) {
    resume();
  } else if (!settle().acceptable()) {
    return false;
  }
  if (options_.block) return check_block();
  double const end = options_.stop_at > 0.0 ? options_.stop_at : options_.throw_over_depth * ground_depth;
  auto const wants_stop = [&] { return mpi::max(stop.wants_stop() ? 1 : 0, comm_) > 0; };  // any process
  while (end - throw_ > smallest && increment_ > smallest && !wants_stop()) {
    int const before = iterations_;
    Verdict const verdict = step(std::min(increment_, end - throw_));
    int const took = iterations_ - before;
    if (!verdict.acceptable()) {
      ++cuts_;
      last_throw_ = 0.0;
      out_ << "cut at " << throw_ << " m: " << name(verdict.reason) << " in " << took << " iterations, step "
           << increment_ << " m, residual " << residual_ << "\n";
      increment_ /= 2.0;
      continue;
    }
    if (took <= (options_.newton ? 6 : 12)) increment_ *= 1.4;
    if (took > (options_.newton ? 10 : 20)) increment_ *= 0.75;
    if (steps_ % adapted_every != 0) continue;
    adapt();
    if (!options_.checkpoint.empty() && mpi::max(total_.wall_time(), comm_) >= saved_at_ + options_.checkpoint_every)
      save();
  }
  bool const complete = end - throw_ <= smallest;
  if (!options_.checkpoint.empty()) save();
  report(complete);
  return complete;
}

}  // namespace dealii_fault
