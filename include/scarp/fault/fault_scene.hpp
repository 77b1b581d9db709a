// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/tri3.hpp"
#include "scarp/fault/fault_block.hpp"
#include "scarp/fault/fault_mesh.hpp"
#include "scarp/scene/scene.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/quasi_newton.hpp"

namespace scarp {

/// What stands on the ground: part of the mesh, loads, regions and what is attached, in stages of the load factor: from -1 to 0 it is
/// placed, from 0 on the fault moves.
template <class Structure, class Grid>
concept StandsOnGround = requires(Structure const& structure, FaultMesh const& layer, Grid const& grid,
                                  LoadHistory& loads) {
  { structure.on(layer) } -> std::same_as<FaultMesh>;
  { structure.extra_dofs() } -> std::same_as<int>;
  { structure.start() } -> std::same_as<double>;
  {structure.add_loads(grid, 4e3, loads)};
  {structure.attached(grid)};
};

/// Level ground over a dip-slip fault in the bedrock. `Soil` is any provider whose initial states carry the geostatic stress; the
/// load factor is the throw [m] once it is positive.
template <ConstitutiveProvider Soil, class Structure, class Solver = QuasiNewton<>>
struct FaultScene {
  using Grid = Discretisation<Tri3>;

  Soil soil;
  FaultMesh layer{};
  FaultBlock fault{};
  double unit_weight = 15.68e3;    ///< [N/m3]
  double surcharge = 4e3;          ///< [Pa], on the ground surface, below a structure until it is placed
  double throw_to = 0.085 * 25.0;  ///< [m]
  Solver solver{};
  LoadStepping stepping{};
  Structure structure{};

  /// \throws InputError for parts that do not fit
  template <class Executor>
  auto problem(Executor& executor) const {
    static_assert(StandsOnGround<Structure, Grid>);
    require_not_negative("unit weight", unit_weight);
    require_not_negative("surcharge", surcharge);
    require_positive("throw", throw_to);
    if (layer.tip != fault.tip) {
      refuse("the mesh has its kink at x = {} m, the fault at {} m (the kink belongs on a node): set both alike",
             layer.tip, fault.tip);
    }
    Grid grid(structure.on(layer).generate());
    Constraints constraints = fault.constraints(grid.mesh(), structure.extra_dofs(), TimeFunction::after(0.0));
    int const soil_region = region_number(grid.mesh(), "soil");
    Eigen::VectorXd dead =
        body_force(grid, [&](int region) { return Vector<2>(0.0, region == soil_region ? -unit_weight : 0.0); });
    dead += traction(grid, "surface", Vector<2>(0.0, -surcharge));
    dead.conservativeResizeLike(Eigen::VectorXd::Zero(grid.dof_count() + structure.extra_dofs()));
    LoadHistory loads(std::move(dead));
    structure.add_loads(grid, surcharge, loads);
    auto attached = structure.attached(grid);
    auto const regions = structure.regions(Region{"soil", soil});
    return make_problem(std::move(grid), layer.depth, regions, std::move(constraints), std::move(loads), executor,
                        std::move(attached));
  }

  /// First stage: the ground as prepared is brought into equilibrium.
  template <class ProblemType, class Observer>
  RunReport settle(ProblemType& problem, Observer& observer) const {
    return stepping.settle(solver, problem, structure.start(), observer);
  }

  /// Second stage: the structure is placed; without one nothing happens.
  template <class ProblemType, class Observer>
  RunReport place(ProblemType& problem, Observer& observer) const {
    LoadStepping stage = stepping;
    stage.first = 0.05;  // of the load
    return stage.run(solver, problem, structure.start(), 0.0, observer);
  }

  /// Last stage: the hanging wall moves.
  template <class ProblemType, class Observer>
  RunReport rupture(ProblemType& problem, Observer& observer) const {
    return stepping.run(solver, problem, 0.0, throw_to, observer);
  }
};

}  // namespace scarp
