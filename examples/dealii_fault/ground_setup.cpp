// SPDX-License-Identifier: BSL-1.0
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <iostream>
#include <numbers>

#include "ground.hpp"

namespace dealii_fault {

Ground::Ground(Options const& options, MPI_Comm comm)
    : options_(options),
      comm_(comm),
      out_(std::cout, mpi::this_mpi_process(comm) == 0),
      mesh_(comm),
      element_(dealii::FE_Q<2>(static_cast<unsigned>(options.degree)), 2),
      dofs_(mesh_),
      executor_(options.threads) {
  in_points_.reset(), in_solver_.reset();
  auto const lines = cell_lines(options.size);
  std::vector<std::vector<double>> widths(2);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (std::size_t k = 1; k < lines[axis].size(); ++k) widths[axis].push_back(lines[axis][k] - lines[axis][k - 1]);
  }
  dealii::GridGenerator::subdivided_hyper_rectangle(mesh_, widths, dealii::Point<2>(lines[0].front(), 0.0),
                                                    dealii::Point<2>(lines[0].back(), ground_depth));
  mesh_.signals.weight.connect([this](auto const& cell, auto const status) {
    if (status != decltype(mesh_)::CELL_COARSEN)
      return static_cast<unsigned>(1.0 + effort_of_cell_[cell->active_cell_index()]);
    double sum = 1.0;
    for (auto const& child : cell->child_iterators()) sum += effort_of_cell_[child->active_cell_index()] / 4.0;
    return static_cast<unsigned>(sum);
  });
}

/// Everything that belongs to the mesh as it is now; points begin as level ground.
void Ground::build() {
  dofs_.distribute_dofs(element_);
  owned_ = dofs_.locally_owned_dofs();
  dealii::DoFTools::extract_locally_relevant_dofs(dofs_, relevant_);
  for (auto* constraints : {&hanging_, &held_}) {
    constraints->reinit(relevant_);
    dealii::DoFTools::make_hanging_node_constraints(dofs_, *constraints);
  }
  prescribe();
  hanging_.close();
  held_.close();
  factors_.reset();
  dealii::DynamicSparsityPattern pattern(relevant_);
  dealii::DoFTools::make_sparsity_pattern(dofs_, pattern, held_, false);
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned_, comm_, relevant_);
  matrix_.reinit(owned_, owned_, pattern, comm_);
  for (auto* vector : {&rates_, &lift_, &moved_, &rest_, &last_, &internal_, &unbalanced_, &support_}) *vector = zero();
  held_.distribute(rates_);
  collect_cells();
  make_points();
}

Ground::Places Ground::places(unsigned axis) const {
  Places all;
  auto const mask = element_.component_mask(dealii::FEValuesExtractors::Scalar(axis));
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<2>(), dofs_, all, mask);
  return all;
}

/// The sides and the bottom move with the walls of the fault; at the tip the step has the moments of detail::StepAtTip.
void Ground::prescribe() {
  double const tip = options_.tip;
  double left = 1e300, right = 1e300;  // lengths of the bottom's facets beside the tip
  for (auto const& cell : mesh_.active_cell_iterators()) {
    if (cell->is_artificial() || cell->vertex(0)[1] != 0.0) continue;
    if (std::abs(cell->vertex(1)[0] - tip) < 1e-9) left = tip - cell->vertex(0)[0];
    if (std::abs(cell->vertex(0)[0] - tip) < 1e-9) right = cell->vertex(1)[0] - tip;
  }
  bool const quadratic = options_.degree == 2;
  double const before = quadratic ? right * right * (left - right) / (4.0 * std::pow(left + right, 3)) : 0.0;
  double const at = right / (left + right) - 4.0 * before * left / right;
  double const after = quadratic ? 1.0 + before * left * left / (right * right) : 1.0;
  auto const share = [&](double x) {
    if (std::abs(x - tip) < 1e-9) return at;
    if (x < tip) return x > tip - left + 1e-9 ? before : 0.0;
    return x < tip + right - 1e-9 ? after : 1.0;
  };
  auto const lines = cell_lines(options_.size);
  double const slip[2] = {1.0 / std::tan(options_.dip * std::numbers::pi / 180.0), -1.0};
  for (unsigned axis = 0; axis < 2; ++axis) {
    for (auto const& [dof, place] : places(axis)) {
      bool const on_left = std::abs(place[0] - lines[0].front()) < 1e-9;
      bool const on_right = std::abs(place[0] - lines[0].back()) < 1e-9;
      bool const on_bottom = std::abs(place[1]) < 1e-9;
      if (!(on_bottom || ((on_left || on_right) && (axis == 0 || !options_.block))) || held_.is_constrained(dof))
        continue;
      held_.add_line(dof);
      if (!options_.block)
        held_.set_inhomogeneity(dof, slip[axis] * (on_left ? 0.0 : on_right ? 1.0 : share(place[0])));
    }
  }
}

void Ground::collect_cells() {
  dealii::FEValues<2> inside(
      element_, dealii::QGauss<2>(2),
      dealii::update_values | dealii::update_gradients | dealii::update_JxW_values | dealii::update_quadrature_points);
  dealii::FEFaceValues<2> surface(element_, dealii::QGauss<1>(2), dealii::update_values | dealii::update_JxW_values);
  unsigned const nodes = element_.n_dofs_per_cell() / 2;
  cells_.clear(), sites_.clear();
  for (auto const& place : dofs_.active_cell_iterators()) {
    if (!place->is_locally_owned()) continue;
    Cell cell;
    cell.dofs.resize(2 * nodes);
    cell.loads = Rows::Zero(nodes, 2);
    place->get_dof_indices(cell.dofs);
    inside.reinit(place);
    for (unsigned p = 0; p < cell_points; ++p) {
      auto& shape = cell.at_rest[p];
      shape = {Rows(nodes, 2), inside.JxW(p)};
      for (unsigned i = 0; i < 2 * nodes; ++i) {
        auto const [axis, node] = element_.system_to_component_index(i);
        if (axis == 0) shape.gradients.row(node) << inside.shape_grad(i, p)[0], inside.shape_grad(i, p)[1];
        if (axis == 1) cell.loads(node, 1) -= fault_rupture::unit_weight * inside.shape_value(i, p) * inside.JxW(p);
      }
      auto const& at = inside.quadrature_point(p);
      int const number = static_cast<int>(place->global_active_cell_index()) * cell_points + static_cast<int>(p);
      sites_.push_back({.index = number, .position = {at[0], at[1]}, .depth = ground_depth - at[1]});
    }
    for (unsigned side = 0; side < 4 && !options_.block; ++side) {
      if (std::abs(place->face(side)->center()[1] - ground_depth) > 1e-9) continue;
      surface.reinit(place, side);
      for (unsigned p = 0; p < 2; ++p) {
        for (unsigned i = 0; i < 2 * nodes; ++i) {
          auto const [axis, node] = element_.system_to_component_index(i);
          if (axis == 1) cell.loads(node, 1) -= fault_rupture::surcharge * surface.shape_value(i, p) * surface.JxW(p);
        }
      }
    }
    if (options_.block) cell.loads *= 1e-4;  // small strains, for which the closed form holds
    cells_.push_back(std::move(cell));
  }
}

void Ground::make_points() {
  int const count = static_cast<int>(own());
  if (!maker_) {
    std::vector<std::array<double, 4>> mine;
    for (auto const& site : sites_)
      mine.push_back({site.position.x(), site.position.y(), site.depth, 1.0 * site.index});
    Sites all;
    for (auto const& part : mpi::all_gather(comm_, mine)) {
      for (auto const& [x, y, depth, number] : part)
        all.push_back({.index = static_cast<int>(number), .position = {x, y}, .depth = depth});
    }
    maker_ = options_.block ? stress_free_soil() : soil_of(options_, all);
  }
  history_.assign(own(), {});
  std::vector<double> volumes;
  for (auto const& cell : cells_) {
    for (auto const& shape : cell.at_rest) volumes.push_back(shape.volume);
  }
  halo_ = options_.length > 0.0 ? reached(sites_, options_.length) : Numbers{};
  halo_.erase(mpi::this_mpi_process(comm_));
  auto const seen = from_others<std::array<double, 5>>(halo_, [&](std::size_t k) {
    auto const& site = sites_[k];
    return std::array{site.position.x(), site.position.y(), site.depth, 1.0 * site.index, volumes[k]};
  });
  for (auto const& [x, y, depth, number, volume] : seen) {
    sites_.push_back({.index = static_cast<int>(number), .position = {x, y}, .depth = depth});
    volumes.push_back(volume);
  }
  points_ = maker_(sites_, volumes, count);
}

/// Which candidates lie within a distance [m] of the boxes around the own points of all processes.
Ground::Numbers Ground::reached(Sites const& candidates, double distance) const {
  std::array<double, 4> box{1e300, 1e300, 1e300, 1e300};  // the far sides with a minus
  for (std::size_t k = 0; k < own(); ++k) {
    auto const& at = sites_[k].position;
    box = {std::min(box[0], at.x()), std::min(box[1], at.y()), std::min(box[2], -at.x()), std::min(box[3], -at.y())};
  }
  Numbers numbers;
  auto const boxes = mpi::all_gather(comm_, box);
  for (unsigned rank = 0; rank < boxes.size(); ++rank) {
    auto const& of = boxes[rank];
    for (int k = 0; k < static_cast<int>(candidates.size()); ++k) {
      auto const& at = candidates[static_cast<std::size_t>(k)].position;
      if (std::min({at.x() - of[0], at.y() - of[1], -at.x() - of[2], -at.y() - of[3]}) > -distance)
        numbers[rank].push_back(k);
    }
  }
  return numbers;
}

}  // namespace dealii_fault
