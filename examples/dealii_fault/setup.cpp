// SPDX-License-Identifier: BSL-1.0
#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
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
      element_(dealii::FE_Q<2>(1), 2),
      dofs_(mesh_),
      executor_(options.threads) {
  in_points_.reset(), in_solver_.reset();
  auto const lines = cell_lines(options.size);
  std::vector<std::vector<double>> widths(2);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (std::size_t k = 1; k < lines[axis].size(); ++k) widths[axis].push_back(lines[axis][k] - lines[axis][k - 1]);
  }
  dealii::Point<2> const first(lines[0].front(), 0.0), last(lines[0].back(), ground_depth);
  dealii::GridGenerator::subdivided_hyper_rectangle(mesh_, widths, first, last);
  mesh_.signals.weight.connect([this](Mesh::cell_iterator const& cell, auto) {
    if (history_.empty()) return 1u;
    double sum = 1.0;
    auto const add = [&](auto const& part, double share) {
      for (unsigned p = 0; p < cell_points; ++p) sum += share * history_[first_point(part) + p].effort;
    };
    if (cell->is_active()) add(cell, 1.0);
    if (!cell->is_active()) {
      for (auto const& child : cell->child_iterators()) add(child, 0.25);
    }
    return static_cast<unsigned>(sum);
  });
}

bool Ground::is_at_tip(dealii::Point<2> const& place) const {
  constexpr double near = 1e-9;  // [m]
  return place[1] == 0.0 && std::abs(place[0] - options_.tip) < near;
}

/// Cells at the tip have the last level from the beginning: later the step of the bedrock would stay as wide as a
/// coarse cell.
void Ground::divide_tip() {
  for (int level = 0; level < options_.levels; ++level) {
    for (auto const& cell : mesh_.active_cell_iterators()) {
      if (cell->is_locally_owned() && (is_at_tip(cell->vertex(0)) || is_at_tip(cell->vertex(1))))
        cell->set_refine_flag();
    }
    mesh_.execute_coarsening_and_refinement();
  }
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
  for (auto* vector : {&rates_, &lift_, &moved_, &rest_, &last_, &internal_, &unbalanced_, &support_})
    vector->reinit(owned_, comm_);
  seen_.reinit(owned_, relevant_, comm_);
  held_.distribute(rates_);
  collect_cells();
  make_points();
}

/// The sides and the bottom move with the walls of the fault; the node at its tip has the share that keeps the mean of
/// the step.
void Ground::prescribe() {
  constexpr double near = 1e-9;  // [m]
  double left = 1e300, right = 1e300;
  for (auto const& cell : mesh_.active_cell_iterators()) {
    if (cell->is_artificial()) continue;
    if (is_at_tip(cell->vertex(1))) left = cell->extent_in_direction(0);
    if (is_at_tip(cell->vertex(0))) right = cell->extent_in_direction(0);
  }
  auto const lines = cell_lines(options_.size);
  double const slip[2] = {1.0 / std::tan(options_.dip * std::numbers::pi / 180.0), -1.0};
  for (auto const& cell : dofs_.active_cell_iterators()) {
    if (cell->is_artificial()) continue;
    for (unsigned const vertex : cell->vertex_indices()) {
      auto const at = cell->vertex(vertex);
      bool const on_side = at[0] < lines[0].front() + near || at[0] > lines[0].back() - near;
      double const share = is_at_tip(at) ? right / (left + right) : at[0] > options_.tip ? 1.0 : 0.0;
      for (unsigned axis = 0; axis < 2; ++axis) {
        auto const dof = cell->vertex_dof_index(vertex, axis);
        bool const is_held = at[1] == 0.0 || (on_side && (axis == 0 || !options_.block));
        if (!is_held || held_.is_constrained(dof)) continue;
        held_.add_line(dof);
        if (!options_.block) held_.set_inhomogeneity(dof, slip[axis] * share);
      }
    }
  }
}

void Ground::collect_cells() {
  constexpr double small_strains = 1e-4;  // of the loads of the block, for which the closed form holds
  dealii::FEValues<2> inside(element_, dealii::QGauss<2>(2),
                             dealii::update_gradients | dealii::update_JxW_values | dealii::update_quadrature_points);
  cells_.clear(), sites_.clear();
  for (auto const& place : dofs_.active_cell_iterators()) {
    if (!place->is_locally_owned()) continue;
    auto const number = place->global_active_cell_index();
    if (cells_.empty()) first_cell_ = number;
    auto& cell = cells_.emplace_back();
    cell.dofs.resize(element_.n_dofs_per_cell());
    place->get_dof_indices(cell.dofs);
    inside.reinit(place);
    for (unsigned p = 0; p < cell_points; ++p) {
      for (unsigned node = 0; node < 4; ++node)
        cell.at_rest[p].gradients.row(node) << inside.shape_grad(2 * node, p)[0], inside.shape_grad(2 * node, p)[1];
      cell.at_rest[p].volume = inside.JxW(p);
      auto const& at = inside.quadrature_point(p);
      int const index = static_cast<int>(cell_points * number + p);
      sites_.push_back({.index = index, .position = {at[0], at[1]}, .depth = ground_depth - at[1]});
    }
    cell.loads = Nodal::Zero();
    cell.loads.col(1).array() -= fault_rupture::unit_weight * place->measure() / 4.0;
    if (options_.block) cell.loads *= small_strains;
    if (!options_.block && place->face(3)->at_boundary())
      cell.loads.bottomRows<2>().col(1).array() -= fault_rupture::surcharge * place->face(3)->measure() / 2.0;
  }
}

void Ground::make_points() {
  using Row = std::array<double, 5>;
  auto const site = [](Row const& row) {
    return scarp::Site<2>{.index = static_cast<int>(row[0]), .position = {row[1], row[2]}, .depth = row[3]};
  };
  std::vector<Row> rows;
  std::vector<dealii::Point<2>> places;
  std::vector<double> volumes;
  for (auto const& one : sites_) {
    volumes.push_back(cells_[rows.size() / cell_points].at_rest[rows.size() % cell_points].volume);
    rows.push_back({1.0 * one.index, one.position.x(), one.position.y(), one.depth, volumes.back()});
    places.emplace_back(one.position.x(), one.position.y());
  }
  if (!maker_) {
    Sites all;
    for (auto const& part : mpi::all_gather(comm_, rows)) std::ranges::transform(part, std::back_inserter(all), site);
    maker_ = options_.block ? stress_free_soil() : soil_of(options_, all);
  }
  history_.assign(rows.size(), {});
  auto boxes = mpi::all_gather(comm_, places.empty() ? dealii::BoundingBox<2>() : dealii::BoundingBox<2>(places));
  std::map<unsigned, std::vector<Row>> reached;
  for (unsigned rank = 0; rank < boxes.size() && options_.length > 0.0; ++rank) {
    boxes[rank].extend(options_.length);
    for (std::size_t k = 0; k < rows.size() && rank != mpi::this_mpi_process(comm_); ++k) {
      if (boxes[rank].point_inside(places[k])) reached[rank].push_back(rows[k]);
    }
  }
  auto const entries = 4 * cell_points * mesh_.n_global_active_cells();
  dealii::IndexSet mine(entries), seen(entries);
  auto const first = 4 * cell_points * first_cell_;
  mine.add_range(first, first + static_cast<dealii::types::global_dof_index>(4 * rows.size()));
  for (auto const& [rank, part] : mpi::some_to_some(comm_, reached)) {
    for (auto const& row : part) {
      sites_.push_back(site(row));
      volumes.push_back(row[4]);
      auto const entry = 4 * static_cast<dealii::types::global_dof_index>(row[0]);
      seen.add_range(entry, entry + 4);
    }
  }
  halo_.reinit(mine, seen, comm_);
  points_ = maker_(sites_, volumes, own());
}

}  // namespace dealii_fault
