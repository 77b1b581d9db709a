// SPDX-License-Identifier: BSL-1.0
#include <deal.II/numerics/data_out.h>

#include <filesystem>

#include "ground.hpp"
#include "scarp/fault/rupture_measures.hpp"

namespace dealii_fault {

/// Where the fault comes out, what it takes, and what it cost.
void Ground::report(bool complete) {
  total_.stop();
  Vector const now(ghosted(moved_)), rest(ghosted(rest_));
  std::map<double, scarp::SurfacePoint> mine, surface;  // by place at the start
  for (auto const& cell : dofs_.active_cell_iterators()) {
    if (!cell->is_locally_owned() || !cell->face(3)->at_boundary()) continue;
    for (unsigned const vertex : {2U, 3U}) {
      auto const x = cell->vertex_dof_index(vertex, 0), y = cell->vertex_dof_index(vertex, 1);
      double const at = cell->vertex(vertex)[0];
      mine[at] = {at + rest(x), at + now(x), rest(y) - now(y)};
    }
  }
  std::vector<std::array<double, 4>> rows;
  for (auto const& [at, point] : mine) rows.push_back({at, point.x_initial, point.x, point.settlement});
  for (auto const& part : mpi::all_gather(comm_, rows)) {
    for (auto const& [at, initial, x, settlement] : part) surface[at] = {initial, x, settlement};
  }
  std::vector<scarp::SurfacePoint> profile;
  double missing = 0.0;
  for (auto const& [at, point] : surface) {
    if (!profile.empty())
      missing += (point.x - profile.back().x) * (point.settlement + profile.back().settlement) / 2.0;
    profile.push_back(point);
  }
  scarp::FaultOffset const offset{.tip = options_.tip, .hanging = throw_};
  double const x50 = scarp::rupture_measures(profile, offset, ground_depth).surface_x50;
  double const mean = profile.back().x - missing / throw_;
  static_cast<void>(evaluate(zero(), false));
  out_ << "deal.II " << DEAL_II_PACKAGE_VERSION << ", " << mpi::n_mpi_processes(comm_) << " processes of "
       << executor_.threads() << " threads, " << mesh_.n_global_active_cells() << " cells, "
       << cell_points * mesh_.n_global_active_cells() << " points\n"
       << (complete ? "throw " : "INCOMPLETE: throw ") << throw_ << " m, x50 " << x50 << " m, profile mean " << mean
       << " m, reaction " << reaction() << " N, internal work " << work_ << " J\n";
  if (options_.own_x50) out_ << "x50 less that of scarp's own elements: " << x50 - *options_.own_x50 << " m\n";
  if (options_.own_mean)
    out_ << "profile mean less that of scarp's own elements: " << mean - *options_.own_mean << " m\n";
  print_costs();
  if (options_.output.empty()) return;
  std::filesystem::create_directories(options_.output);
  dealii::DataOut<2> fields;
  fields.add_data_vector(dofs_, now, "displacement");
  fields.build_patches();
  fields.write_vtu_with_pvtu_record(options_.output + "/", "ground", 0, comm_);
}

/// Times, and what this program's own messages hold; those of PETSc's vectors and matrices are in its log.
void Ground::print_costs() {
  auto const of_all = [&](double value) { return mpi::min_max_avg(value, comm_); };
  auto const steps = of_all(static_cast<double>(dem_steps_)), total = of_all(total_.cpu_time());
  auto const points = of_all(in_points_.cpu_time()), solver = of_all(in_solver_.cpu_time());
  auto const points_wall = of_all(in_points_.wall_time()), solver_wall = of_all(in_solver_.wall_time());
  auto const& neighbours = *halo_.get_partitioner();
  auto const messages = of_all(static_cast<double>(neighbours.import_targets().size()));
  auto const bytes = of_all(8.0 * neighbours.n_import_indices());
  auto const ghosts = of_all(8.0 * static_cast<double>(relevant_.n_elements() - owned_.n_elements()));
  out_ << steps_ << " steps, " << cuts_ << " cuts, " << iterations_ << " iterations, " << evaluations_
       << " evaluations, " << steps.sum << " DEM steps\n"
       << "DEM steps of a process: least " << steps.min << ", most " << steps.max << "\n"
       << "wall time: all " << total_.wall_time() << " s, points " << points_wall.max << " s, solver "
       << solver_wall.max << " s\n"
       << "CPU time: all " << total.sum << " s, points " << points.sum << " s, solver " << solver.sum << " s\n"
       << "gradients for means, a process and evaluation: messages " << messages.avg << ", bytes " << bytes.avg
       << ", most " << bytes.max << "; displacements of neighbours: bytes " << ghosts.avg << "\n"
       << "states sent: " << mpi::sum(moved_states_, comm_) << " in messages " << mpi::sum(state_messages_, comm_)
       << " of bytes " << mpi::sum(moved_bytes_, comm_) << " in " << adaptations_
       << " changes of the mesh or its shares\n"
       << "scalar products of the acceleration: " << dots_ << "\n";
}

}  // namespace dealii_fault
