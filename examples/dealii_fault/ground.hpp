// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/petsc_solver.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>

#include "cell_forces.hpp"
#include "options.hpp"
#include "scarp/solver/anderson_mixing.hpp"
#include "scarp/solver/thread_executor.hpp"
#include "soil.hpp"

namespace dealii_fault {

namespace mpi = dealii::Utilities::MPI;
using Vector = dealii::PETScWrappers::MPI::Vector;

struct OfPetsc {
  double dot(Vector const& first, Vector const& second) const { return first * second; }
  void add(double factor, Vector const& vector, Vector& to) const { to.add(factor, vector); }
};

/// The study's ground over a normal fault in cells of deal.II, which its forest shares out among processes, with points of scarp.
class Ground {
 public:
  Ground(Options const& options, MPI_Comm comm);

  /// \return whether the run came to its end
  bool run();

 private:
  using Dof = dealii::types::global_dof_index;
  using Places = std::map<Dof, dealii::Point<2>>;
  using Numbers = std::map<unsigned, std::vector<int>>;       ///< of points, by process
  using Saved = std::pair<std::vector<double>, std::string>;  ///< numbers and the bits of states
  struct Cell {
    std::vector<Dof> dofs;
    Shapes at_rest, at_start, now;  ///< before all motion, at the start of the load step, at its end
    Rows loads;                     ///< [N]
    std::array<Gradient<2>, cell_points> gradients;
  };
  struct History {
    double shear = 0.0;   ///< strain since the last refinement
    double effort = 1.0;  ///< DEM steps of a response, smoothed
  };

  // ground_setup.cpp
  void build();
  Places places(unsigned axis) const;
  void prescribe();
  void collect_cells();
  void make_points();
  Numbers reached(Sites const& candidates, double distance) const;
  // ground_balance.cpp
  scarp::Verdict settle();
  scarp::Verdict step(double more);
  scarp::Verdict evaluate(Vector const& increment, bool responds);
  scarp::Verdict worst(scarp::Verdict verdict) const;
  void add_up();
  void factorise(bool consistent);
  Vector solved(Vector const& force);
  Vector predicted(double& more);
  void commit(Vector const& increment, Vector const& before, double more);
  void start_from(Vector const& moved);
  bool check_block() const;
  // ground_adaptation.cpp
  void adapt();
  bool mark();
  void carry(Points const& from, Sites const& sites, std::vector<History> const& histories);
  std::vector<double> identity() const;
  void save();
  Saved saved(unsigned file) const;
  void resume();
  void report(bool complete);
  void draw() const;

  template <class Value, class Map>
  std::vector<Value> from_others(Numbers const& points, Map const& value) const {
    std::map<unsigned, std::vector<Value>> sent;
    for (auto const& [rank, numbers] : points) {
      for (int const point : numbers) sent[rank].push_back(value(static_cast<std::size_t>(point)));
    }
    std::vector<Value> all;
    for (auto const& [rank, values] : mpi::some_to_some(comm_, sent))
      all.insert(all.end(), values.begin(), values.end());
    return all;
  }
  Rows nodal(Cell const& cell, Vector const& values) const;
  Vector ghosted(Vector const& values) const {
    Vector copy(owned_, relevant_, comm_);
    copy = values;
    return copy;
  }
  Vector zero() const { return Vector(owned_, comm_); }
  std::size_t own() const { return cell_points * cells_.size(); }
  /// Of the moving bedrock, less that at rest [N]; without the loads on its nodes, which change with the mesh.
  double reaction() const { return support_ * rates_ - reaction_at_rest_; }

  Options options_;
  MPI_Comm comm_;
  dealii::ConditionalOStream out_;
  dealii::parallel::distributed::Triangulation<2> mesh_;
  dealii::FESystem<2> element_;
  dealii::DoFHandler<2> dofs_;
  dealii::IndexSet owned_, relevant_;
  dealii::AffineConstraints<double> hanging_, held_;  ///< held: hanging nodes, and prescribed ones at a throw of 1 m
  dealii::PETScWrappers::MPI::SparseMatrix matrix_;
  dealii::SolverControl control_;
  std::unique_ptr<dealii::PETScWrappers::SparseDirectMUMPS> factors_;
  Vector rates_, lift_;         ///< motion of the bedrock and its force [N], for a throw of 1 m
  Vector moved_, rest_, last_;  ///< displacements [m]: now, before the fault moved, of the last step
  Vector internal_, unbalanced_,
      support_;                         ///< forces [N] of the last evaluation: of cells, of free nodes, less all loads
  std::vector<Cell> cells_;             ///< own ones
  Sites sites_;                         ///< own points, cell by cell, then those that means reach
  std::vector<History> history_;        ///< of own points
  std::vector<double> effort_of_cell_;  ///< by number among all that this process knows
  Numbers halo_;
  PointMaker maker_;
  Points points_;
  scarp::ThreadExecutor executor_;
  scarp::AndersonMixing<Vector, OfPetsc> mixing_{8};
  double residual_ = 0.0, throw_ = 0.0, increment_ = 1e-3, last_throw_ = 0.0, reaction_at_rest_ = 0.0, work_ = 0.0;
  int steps_ = 0, cuts_ = 0, iterations_ = 0;
  long inner_steps_ = 0;
  dealii::Timer total_, in_points_, in_solver_;
};

}  // namespace dealii_fault
