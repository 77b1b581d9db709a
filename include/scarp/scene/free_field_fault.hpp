// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/bvp/fault_block.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/mesh/fault_mesh.hpp"
#include "scarp/scene/scene.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {

/// Level ground over a dip-slip fault in the bedrock, nothing built on it: the study's free-field case. `Soil` is any
/// provider whose initial states carry the geostatic stress; the load factor is the throw [m].
template <ConstitutiveProvider Soil, class Solver = QuasiNewton<>>
struct FreeFieldFault {
  using Grid = Discretisation<Tri3>;
  template <class Executor>
  using Problem = SceneProblem<Grid, Executor, Soil>;

  Soil soil;
  FaultMesh layer{};
  FaultBlock fault{};
  double unit_weight = 15.68e3;    ///< [N/m3]
  double surcharge = 4e3;          ///< [Pa], on the whole surface
  double throw_to = 0.085 * 25.0;  ///< [m]
  Solver solver{};
  LoadStepping stepping{};

  /// \throws InputError for parts that do not fit
  template <class Executor>
  Problem<Executor> problem(Executor& executor) const {
    require_not_negative("unit weight", unit_weight);
    require_not_negative("surcharge", surcharge);
    require_positive("throw", throw_to);
    if (layer.tip != fault.tip) {
      refuse("the mesh has its kink at x = {} m, the fault at {} m (the kink belongs on a node): set both alike",
             layer.tip, fault.tip);
    }
    Grid grid(layer.generate());
    Constraints constraints = fault.constraints(grid.mesh());
    Eigen::VectorXd loads = body_force(grid, [&](int) { return Vector<2>(0.0, -unit_weight); });
    loads += traction(grid, "surface", Vector<2>(0.0, -surcharge));
    return make_problem(std::move(grid), layer.depth, boost::hana::make_tuple(Region{"soil", soil}),
                        std::move(constraints), std::move(loads), executor);
  }

  /// First stage: the ground as prepared is brought into equilibrium.
  template <class ProblemType, class Observer>
  RunReport settle(ProblemType& problem, Observer& observer) const {
    return stepping.settle(solver, problem, 0.0, observer);
  }

  /// Second stage: the hanging wall moves.
  template <class ProblemType, class Observer>
  RunReport rupture(ProblemType& problem, Observer& observer) const {
    return stepping.run(solver, problem, 0.0, throw_to, observer);
  }
};

}  // namespace scarp
