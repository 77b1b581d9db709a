// SPDX-License-Identifier: BSL-1.0
// linear_systems TRIANGLES: the free field's stiffness on elastic ground: assembled and factorised by Eigen's LU, as every rank does it
// in each iteration, and factorised by MUMPS on all ranks of the MPI job. Least times of several, and the busiest rank's share of MUMPS's
// operations, as JSON on the first rank's stdout.
#include <dmumps_c.h>
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/fault/free_field_fault.hpp"
#include "scarp/measure/cpu_time.hpp"
#include "scarp/solver/executor.hpp"

namespace {

constexpr int repetitions = 5;

/// Least wall and CPU time [s] of several calls.
struct Least {
  double wall = std::numeric_limits<double>::infinity();
  double cpu = wall;
};

Least least_of(std::function<void()> const& call) {
  Least least;
  for (int k = 0; k < repetitions; ++k) {
    double const started = MPI_Wtime();
    scarp::CpuTime const cpu;
    call();
    least = {std::min(least.wall, MPI_Wtime() - started), std::min(least.cpu, cpu.seconds())};
  }
  return least;
}

std::string text_of(char const* name, Least const& least) {
  return fmt::format(R"(, "{}": {:.6f}, "{} cpu": {:.6f})", name, least.wall, name, least.cpu);
}

/// MUMPS on all ranks; the matrix is on the first, as are both sides.
class Mumps {
 public:
  explicit Mumps(scarp::SparseMatrix const& matrix) {
    id_.comm_fortran = -987654;  // MPI_COMM_WORLD, by MUMPS's own convention
    id_.par = 1;
    id_.sym = 0;
    run(-1);
    for (int const output : {0, 1, 2, 3}) id_.icntl[output] = output == 3 ? 0 : -1;
    for (int column = 0; column < matrix.outerSize(); ++column) {
      for (scarp::SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
        rows_.push_back(static_cast<int>(entry.row()) + 1);
        columns_.push_back(column + 1);
        values_.push_back(entry.value());
      }
    }
    id_.n = static_cast<int>(matrix.rows());
    id_.nnz = static_cast<MUMPS_INT8>(values_.size());
    id_.irn = rows_.data();
    id_.jcn = columns_.data();
    id_.a = values_.data();
  }
  Mumps(Mumps const&) = delete;
  Mumps& operator=(Mumps const&) = delete;
  ~Mumps() { run(-2); }

  void analyse() { run(1); }
  void factorise() { run(2); }
  /// Operations of the last factorisation on this rank.
  double operations() const { return id_.rinfo[2]; }
  void solve(Eigen::VectorXd& both) {
    id_.rhs = both.data();
    run(3);
  }

 private:
  void run(int job) {
    id_.job = job;
    dmumps_c(&id_);
    if (id_.infog[0] < 0) scarp::refuse("MUMPS ended job {} with error {}", job, id_.infog[0]);
  }

  DMUMPS_STRUC_C id_{};
  std::vector<int> rows_, columns_;
  std::vector<double> values_;
};

void measure(int triangles) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  using Soil = scarp::LinearElastic<2, scarp::GeostaticStress<2>>;
  scarp::FreeFieldFault<Soil> scene;
  scene.soil = Soil::from_young_poisson(25e6, 0.25, {.surcharge = 4e3, .unit_weight = 15.68e3, .k0 = 0.4});
  scene.ground.layer = scene.ground.layer.with_about(triangles);
  scarp::SerialExecutor executor;
  auto problem = scene.problem(executor);
  scarp::FreeSystem const system(problem.constraints());
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(problem.dof_count());
  auto const tangents = problem.committed_tangents();
  problem.evaluate_committed();
  scarp::SparseMatrix stiffness;
  scarp::SparseMatrix matrix;
  problem.ground_stiffness(still, tangents, stiffness);  // makes the pattern
  auto const assembly = least_of([&] {
    problem.ground_stiffness(still, tangents, stiffness);
    matrix = system.matrix(stiffness);
  });
  scarp::SparseLu linear;
  linear.factorize(matrix);  // orders the unknowns, once in a run
  auto const factors = least_of([&] { linear.factorize(matrix); });
  Eigen::VectorXd const right = Eigen::VectorXd::Ones(matrix.rows());
  Eigen::VectorXd solution;
  auto const answer = least_of([&] { solution = linear.solve(right); });
  Mumps mumps(matrix);
  Eigen::VectorXd found;
  mumps.analyse();
  auto const mumps_factors = least_of([&] { mumps.factorise(); });
  double const own = mumps.operations();
  double most = 0.0;
  double all = 0.0;
  MPI_Reduce(&own, &most, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
  MPI_Reduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  auto const mumps_answer = least_of([&] { mumps.solve(found = right); });
  if (rank > 0) return;
  double const error = (found - solution).norm() / solution.norm();
  if (!(error < 1e-8)) scarp::refuse("the two solvers differ by {:.1e}", error);
  fmt::print(R"({{"elements": {}, "unknowns": {}, "entries": {}, "ranks": {}, "busiest": {:.4f}{}{}{}{}{}}})"
             "\n",
             problem.discretisation().mesh().elements.size(), matrix.rows(), matrix.nonZeros(), ranks, most / all,
             text_of("assembly", assembly), text_of("factors", factors), text_of("solution", answer),
             text_of("MUMPS factors", mumps_factors), text_of("MUMPS solution", mumps_answer));
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int code = 0;
  try {
    if (argc != 2) scarp::refuse("{} arguments were given (one is expected): linear_systems TRIANGLES", argc - 1);
    measure(std::atoi(argv[1]));
  } catch (std::exception const& problem) {
    fmt::print(stderr, "linear_systems: {}\n", problem.what());
    code = 1;
    MPI_Abort(MPI_COMM_WORLD, code);
  }
  MPI_Finalize();
  return code;
}
