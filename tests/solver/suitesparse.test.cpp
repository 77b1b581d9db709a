// SPDX-License-Identifier: BSL-1.0
#include <doctest/doctest.h>

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

#include "bvp/sample_problems.hpp"
#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/solver/linear_system.hpp"
#include "support/approx.hpp"
#include "support/crossed_rectangle.hpp"

TEST_CASE("UMFPACK and CHOLMOD solve a system as the default does, and name its condition and what nothing holds") {
  using scarp::SparseMatrix;
  auto const mesh = samples::CrossedRectangle{.columns = 4, .rows = 3}.generate();
  scarp::Discretisation<scarp::Tri3, scarp::SmallStrain> const grid(mesh);
  std::vector<scarp::VoigtStress<2>> const none(static_cast<std::size_t>(grid.point_count()),
                                                scarp::VoigtStress<2>::Zero());
  std::vector const tangents(none.size(), scarp::LinearElastic<2>::from_young_poisson(20e6, 0.3).tangent({}));
  SparseMatrix const stiffness = grid.stiffness(Eigen::VectorXd::Zero(grid.dof_count()), none, tangents);
  scarp::Constraints constraints(mesh);
  for (int const node : scarp::boundary_nodes(mesh, "bottom")) constraints.fix(node);
  scarp::LinearSystem expected(constraints);
  REQUIRE(expected.factorize({stiffness}).acceptable());
  Eigen::VectorXd const force = Eigen::VectorXd::LinSpaced(expected.free_count(), -1e3, 2e3);
  scarp::Verdict const singular{scarp::Status::failed, scarp::Reason::singular_system};
  for (auto const& solver : {scarp::direct_solver<Eigen::UmfPackLU<SparseMatrix>>,
                             scarp::direct_solver<Eigen::CholmodSupernodalLLT<SparseMatrix>>}) {
    scarp::LinearSystem system(constraints, solver);
    REQUIRE(system.factorize({stiffness}).acceptable());
    // Round-off of direct solvers, times a condition below 1e3.
    CHECK((system.solve(force) - expected.solve(force)).norm() < 1e-12 * expected.solve(force).norm());
    CHECK(system.condition() == samples::Approx(expected.condition()).epsilon(1e-10));
    SparseMatrix loose = stiffness;
    int const dof = constraints.free_dofs().back();
    loose.prune([&](auto row, auto column, double) { return row != dof && column != dof; });
    loose.coeffRef(dof, dof) = 0.0;
    CHECK(system.factorize({loose}) == singular);
    CHECK(system.weakest_dof() == dof);
  }
}
