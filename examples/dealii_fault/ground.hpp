// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/petsc_solver.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include <optional>

#include "scarp/bvp/mean_dilatation.hpp"
#include "scarp/element/quad4.hpp"
#include "scarp/run/stop_signal.hpp"
#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "soil.hpp"

namespace dealii_fault {

namespace mpi = dealii::Utilities::MPI;
using Vector = dealii::PETScWrappers::MPI::Vector;
using Nodal = Eigen::Matrix<double, 4, 2, Eigen::RowMajor>;  ///< of a cell, in the order of its degrees of freedom
constexpr unsigned cell_points = 4;

/// The reference study's free field, and what is this program's own.
struct Options : fault_rupture::Choice {
  bool block = false;      ///< elastic ground settles under its weight instead of the fault
  bool newton = false;     ///< the points' tangents instead of initial stiffness with Anderson's acceleration
  double residual = 1e-4;  ///< of a balanced step
  int levels = 0;          ///< of refinement
  double refine_at =
      0.002;  ///< shear strain since the mesh last changed that divides a cell; below a tenth cells are joined
  double imbalance = 1.2;  ///< DEM steps of the busiest process over their mean, above which points are shared out anew
  double stop_at = 0.0;    ///< throw [m] at which the run is saved and ends; 0 for none
  std::string output{};    ///< folder of the fields; empty for none
  std::optional<double> own_x50{}, own_mean{};  ///< [m], of scarp's own elements
};

struct OfPetsc {
  double dot(Vector const& first, Vector const& second) const { return ++*dots, first * second; }
  void add(double factor, Vector const& vector, Vector& to) const { to.add(factor, vector); }
  long* dots;
};

/// The reference study's ground over a normal fault in cells of deal.II, which its forest shares out among processes,
/// with points of scarp.
class Ground {
 public:
  Ground(Options const& options, MPI_Comm comm);

  /// \return whether the run came to its end
  bool run(scarp::StopSignal const& stop);

 private:
  using Mesh = dealii::parallel::distributed::Triangulation<2>;
  using Shapes = scarp::ElementShapes<scarp::Quad4, cell_points>;
  struct Cell {
    std::vector<dealii::types::global_dof_index> dofs;
    Shapes at_rest, at_start, now;  ///< before all motion, at the start of the load step, at its end
    Nodal loads;                    ///< [N]
    std::array<scarp::Gradient<2>, cell_points> gradients;
  };
  struct History {
    double shear = 0.0;   ///< strain since the mesh last changed
    double effort = 1.0;  ///< DEM steps of a response, smoothed
  };
  struct Origin {
    unsigned process;
    int point;
    History history;
  };

  // setup.cpp
  bool is_at_tip(dealii::Point<2> const& place) const;
  void divide_tip();
  void build();
  void prescribe();
  void collect_cells();
  void make_points();
  // balance.cpp
  scarp::Verdict settle();
  scarp::Verdict step(double more);
  scarp::Verdict evaluate(Vector const& increment, bool responds);
  scarp::Verdict worst(scarp::Verdict verdict) const;
  void add_up();
  void assemble(bool consistent);
  Vector solved(Vector const& force);
  Vector predicted(double& more);
  void commit(Vector const& increment, Vector const& before, double more);
  void start_from_moved();
  bool check_block() const;
  // adaptation.cpp
  void adapt();
  bool mark();
  void carry(Points const& from, std::vector<Origin> const& origins);
  std::string identity() const;
  void save();
  void resume();
  // report.cpp
  void report(bool complete);
  void print_costs();

  /// Entries of a cell's nodes.
  Nodal nodal(Cell const& cell, Vector const& values) const {
    Nodal rows;
    values.extract_subvector_to(cell.dofs.begin(), cell.dofs.end(), rows.data());
    return rows;
  }
  /// With the entries of neighbours, until the next call.
  Vector const& ghosted(Vector const& values) { return seen_ = values; }
  Vector zero() const { return Vector(owned_, comm_); }
  int own() const { return static_cast<int>(cell_points * cells_.size()); }
  std::size_t first_point(Mesh::cell_iterator const& cell) const {
    return cell_points * (cell->global_active_cell_index() - first_cell_);
  }
  /// Of the moving bedrock, less that at rest [N]; without the loads on its nodes, which change with the mesh.
  double reaction() const { return support_ * rates_ - reaction_at_rest_; }

  Options options_;
  MPI_Comm comm_;
  dealii::ConditionalOStream out_;
  Mesh mesh_;
  dealii::FESystem<2> element_;
  dealii::DoFHandler<2> dofs_;
  dealii::IndexSet owned_, relevant_;
  dealii::AffineConstraints<double> hanging_, held_;  ///< held: hanging nodes, and prescribed ones at a throw of 1 m
  dealii::PETScWrappers::MPI::SparseMatrix matrix_;
  dealii::SolverControl control_;
  std::unique_ptr<dealii::PETScWrappers::SparseDirectMUMPS> factors_;
  Vector rates_, lift_;                     ///< motion of the bedrock and its force [N], for a throw of 1 m
  Vector moved_, rest_, last_, seen_;       ///< displacements [m]: now, before the fault moved, of the last step
  Vector internal_, unbalanced_, support_;  ///< forces [N]: of cells, of free nodes, of cells less all loads
  std::vector<Cell> cells_;                 ///< own ones
  dealii::types::global_cell_index first_cell_ = 0;
  Sites sites_;                                              ///< own points, cell by cell, then those that means reach
  std::vector<History> history_;                             ///< of own points
  dealii::LinearAlgebra::distributed::Vector<double> halo_;  ///< gradients by global number of the point
  PointMaker maker_;
  Points points_;
  scarp::ThreadExecutor executor_;
  long dots_ = 0, dem_steps_ = 0, moved_states_ = 0, moved_bytes_ = 0, state_messages_ = 0;
  scarp::AndersonMixing<Vector, OfPetsc> mixing_{8, OfPetsc{&dots_}};
  double residual_ = 0.0, throw_ = 0.0, increment_ = 1e-3, last_throw_ = 0.0, reaction_at_rest_ = 0.0, work_ = 0.0;
  double saved_at_ = 0.0;  ///< wall time [s]
  int steps_ = 0, cuts_ = 0, iterations_ = 0, evaluations_ = 0, adaptations_ = 0;
  dealii::Timer total_, in_points_, in_solver_;
};

}  // namespace dealii_fault
