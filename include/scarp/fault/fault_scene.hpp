// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scarp/bvp/default_grid.hpp"
#include "scarp/constitutive/buoyancy.hpp"
#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/fault/dip_slip_faults.hpp"
#include "scarp/fault/fault_stages.hpp"
#include "scarp/fault/ground.hpp"
#include "scarp/solver/load_stepping.hpp"
#include "scarp/solver/make_problem.hpp"
#include "scarp/solver/quasi_newton.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/fault/fault_mesh.hpp"
#endif

SCARP_NAMED_MEMBER(buoyancy)
SCARP_NAMED_MEMBER(end)
SCARP_NAMED_MEMBER(field)

namespace scarp::detail {

/// A material without its neighbours.
template <Material Soil>
auto const& alone(Soil const& soil) {
  if constexpr (requires { soil.neighbourhood(); }) {
    return soil.provider;
  } else {
    return soil;
  }
}

/// Rejects soil whose vertical stress does not carry the weight that the scene puts on it: ground that begins out of
/// balance settles or heaves first, and its strength is that of another stress. Of some sites from the shallowest to
/// the deepest the middle one counts, by its error: packings prepared for a few depths carry too much here and too
/// little there. overburden(depth [m]) [Pa] \throws InputError
template <Material Soil, int Dim, class Overburden>
void require_carried(Soil const& soil, std::vector<Site<Dim>> sites, Overburden const& overburden) {
  constexpr double tolerance = 0.01;  // servos of preparations reach 1e-3
  constexpr std::size_t looks = 15;
  struct Look {
    double depth, carried, weight;
    double error() const { return carried / weight - 1.0; }
  };
  std::ranges::sort(sites, {}, [](auto const& site) { return site.depth; });
  std::vector<Look> found;
  for (std::size_t k = 0; k < looks && !sites.empty(); ++k) {
    auto const& site = sites[k * (sites.size() - 1) / (looks - 1)];
    double const weight = overburden(site.depth);
    if (!(weight > 0.0)) continue;
    MaterialPoints<Dim> const point(alone(soil), std::span(&site, 1));
    found.push_back({site.depth, -point.committed_stress(0)(Dim - 1), weight});
  }
  if (found.empty()) return;
  auto const middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::ranges::nth_element(found, middle, {}, &Look::error);
  if (std::abs(middle->error()) <= tolerance) return;
  reject(
      "the soil carries {:.4g} Pa at a depth of {:.4g} m (the scene's surcharge and unit weight, less the lift of "
      "water, are {:.4g} Pa there): give them to the soil's initial stress and to the scene alike",
      middle->carried, middle->depth, middle->weight);
}

/// A field of the ground below a structure, or nothing.
template <class Structure, class Grid>
auto field_of(Structure const& structure, Grid const& grid, double throw_to) {
  if constexpr (requires { structure.field(grid, throw_to); }) {
    return structure.field(grid, throw_to);
  } else {
    static_assert(
        !names_field<Structure>,
        "scarp: field of a structure is never called: it needs "
        "`auto field(Grid const& grid, double throw_to) const` of the scene's grid; give what is something else "
        "another name");
    return NoAttachment{};
  }
}

/// What water carries of the ground below a structure.
template <class Structure>
Buoyancy buoyancy_of(Structure const& structure) {
  if constexpr (requires { structure.buoyancy(); }) {
    return structure.buoyancy();
  } else {
    static_assert(
        !names_buoyancy<Structure>,
        "scarp: buoyancy of a structure is never called: it needs `Buoyancy buoyancy() const`; give what is something "
        "else another name");
    return {};
  }
}

/// Forces [N] of the water that carries a region of the ground, shape (dof_count): those of the vertical stress that it
/// relieves the points of, so that ground at rest is in balance also where the water table crosses an element.
template <class Grid>
Eigen::VectorXd lift(Grid const& grid, double surface_level, int region, Buoyancy const& buoyancy) {
  std::vector<VoigtStress<Grid::dim>> relieved(index(grid.point_count()), VoigtStress<Grid::dim>::Zero());
  for (int point = 0; point < grid.point_count(); ++point) {
    auto const site = grid.site(point, surface_level);
    if (site.region == region) relieved[index(point)](Grid::dim - 1) = buoyancy.relief(site.depth);
  }
  Eigen::VectorXd forces;
  grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), relieved, forces);
  return forces;
}

/// Degrees of freedom of what is attached to a mesh.
inline int extra_dofs(NoAttachment const&) { return 0; }
template <class Attached>
int extra_dofs(Attached const& attached) {
  return attached.extra_dofs();
}

}  // namespace scarp::detail

namespace scarp {

/// What stands on the ground: the edges where it wants nodes, its part of the mesh, loads, regions and what is
/// attached, in stages of the load factor: from start() to 0 it is placed, from 0 on the fault moves. field(grid,
/// throw_to), where there is one, is a field of the ground by the throw [m], such as pore water, and end(throw_to) the
/// load factor up to which the bedrock rests after it. buoyancy(), where there is one, is that of the ground's
/// water.
template <class Structure, class Grid>
concept StandsOnGround = requires(Structure const& structure, Mesh<typename Grid::ElementType>& mesh, Grid const& grid,
                                  LoadHistory& loads) {
  { structure.edges() } -> std::same_as<std::vector<double>>;
  structure.put_on(mesh);
  { structure.start() } -> std::same_as<double>;
  structure.add_loads(grid, 4e3, loads);
  structure.attached(grid);
};

/// Level ground over a fault in the bedrock, with whatever stands on it. `Soil` is any provider whose initial states
/// carry the geostatic stress; the load factor is the throw [m] once it is positive. Soil, ground, motion of the
/// bedrock, structure, solver and grid (element, integration, kinematics) are chosen independently of one another.
/// \tparam Structure a `StandsOnGround`
/// \tparam Solver such as `QuasiNewton`
/// \tparam GridType a `Discretisation` of the ground's element
template <CheckedMaterial Soil, class Structure, class Solver = QuasiNewton<>,
          Ground GroundType = StructuredGround<Tri3>, BedrockMotion Motion = NormalFault,
          class GridType = DefaultGridOf<GroundType>>
struct SCARP_EXPORT FaultScene {
  using Grid = GridType;                 ///< elements, integration and kinematics of the ground
  static constexpr int dim = Grid::dim;  ///< of the grid

  Soil soil;                       ///< carries the geostatic stress at first
  GroundType ground{};             ///< mesh and level of the surface
  Motion fault{};                  ///< motion of the bedrock
  double unit_weight = 15.68e3;    ///< [N/m3], without water
  double surcharge = 4e3;          ///< [Pa], on the ground surface, below a structure until it is placed
  double throw_to = 0.085 * 25.0;  ///< [m]
  Solver solver{};                 ///< of each load step
  LoadStepping stepping{};         ///< of all stages; its load increments are metres of throw
  Structure structure{};           ///< what stands on the ground

  /// The ground with what of the structure is part of the mesh.
  /// \throws InputError for parts that do not fit
  Mesh<typename GroundType::Element> mesh() const;

  /// All points of the soil, for those who prepare it.
  /// \throws InputError for parts that do not fit
  std::vector<Site<dim>> soil_sites() const { return soil_sites(Grid(mesh())); }

  /// Their depths [m].
  /// \throws InputError for parts that do not fit
  std::vector<double> soil_depths() const {
    std::vector<double> depths;
    for (auto const& site : soil_sites()) depths.push_back(site.depth);
    return depths;
  }

  /// Vertical effective stress [Pa] of the ground at rest, compression positive, at a depth [m].
  double overburden(double depth) const {
    return surcharge + unit_weight * depth - detail::buoyancy_of(structure).relief(depth);
  }

  /// \throws InputError for parts that do not fit, and for soil that does not carry the weight
  EquilibriumProblem<Grid> problem(Executor& executor) const;

  /// Stages by load factor, whatever stands on the ground.
  FaultStages<Solver> stages() const { return {solver, stepping, structure.start(), throw_to, end()}; }
  /// First stage, see FaultStages.
  template <class ProblemType, class Observer>
  RunReport settle(ProblemType& problem, Observer& observer) const {
    return stages().settle(problem, observer);
  }
  /// Second stage, see FaultStages.
  template <class ProblemType, class Observer>
  RunReport place(ProblemType& problem, Observer& observer) const {
    return stages().place(problem, observer);
  }
  /// Third stage, see FaultStages.
  template <class ProblemType, class Observer>
  RunReport rupture(ProblemType& problem, Observer& observer) const {
    return stages().rupture(problem, observer);
  }
  /// Last stage, see FaultStages.
  template <class ProblemType, class Observer>
  RunReport rest(ProblemType& problem, Observer& observer) const {
    return stages().rest(problem, observer);
  }
  /// Load factor at the end of all stages.
  double end() const {
    if constexpr (requires { structure.end(throw_to); }) {
      return structure.end(throw_to);
    } else {
      static_assert(
          !detail::names_end<Structure>,
          "scarp: end of a structure is never called: it needs `double end(double throw_to) const`, the load factor "
          "up to which the bedrock rests after the throw; give what is something else another name");
      return throw_to;
    }
  }

 private:
  std::vector<Site<dim>> soil_sites(Grid const& grid) const {
    int const region = region_number(grid.mesh(), "soil");
    std::vector<Site<dim>> sites;
    for (int point = 0; point < grid.point_count(); ++point) {
      auto const site = grid.site(point, ground.surface_level());
      if (site.region == region) sites.push_back(site);
    }
    return sites;
  }
};

// Outside of the class, so that a library can contain them.

template <CheckedMaterial Soil, class Structure, class Solver, Ground GroundType, BedrockMotion Motion, class GridType>
Mesh<typename GroundType::Element> FaultScene<Soil, Structure, Solver, GroundType, Motion, GridType>::mesh() const {
  static_assert(StandsOnGround<Structure, Grid>,
                "scarp: a structure needs edges(), put_on(), start(), add_loads() and attached()");
  static_assert(std::same_as<typename GroundType::Element, typename Grid::ElementType>,
                "the grid is of the ground's element");
  auto made = ground.mesh(structure.edges());
  structure.put_on(made);
  require_node_at_tip(made, fault.tip);
  return made;
}

template <CheckedMaterial Soil, class Structure, class Solver, Ground GroundType, BedrockMotion Motion, class GridType>
EquilibriumProblem<GridType> FaultScene<Soil, Structure, Solver, GroundType, Motion, GridType>::problem(
    Executor& executor) const {
  require_not_negative("unit weight", unit_weight);
  require_not_negative("surcharge", surcharge);
  require_positive("throw", throw_to);
  auto const buoyancy = detail::buoyancy_of(structure);
  buoyancy.validate(unit_weight);
  Grid grid(mesh());
  detail::require_carried(soil, soil_sites(grid), [&](double depth) { return overburden(depth); });
  auto attached = structure.attached(grid);
  auto field = detail::field_of(structure, grid, throw_to);
  int const extra_dofs = detail::extra_dofs(attached) + detail::extra_dofs(field);
  auto const moved = end() > throw_to ? TimeFunction({{0.0, 0.0}, {throw_to, throw_to}}) : TimeFunction::after(0.0);
  Constraints constraints = bedrock_constraints(grid.mesh(), fault, extra_dofs, moved);
  int const soil_region = region_number(grid.mesh(), "soil");
  Vector<dim> const down = -Vector<dim>::Unit(dim - 1);
  Eigen::VectorXd dead =
      grid.body_force([&](int region) { return (region == soil_region ? unit_weight : 0.0) * down; });
  if (buoyancy.lift > 0.0) dead += detail::lift(grid, ground.surface_level(), soil_region, buoyancy);
  dead += grid.traction("surface", surcharge * down);
  LoadHistory loads(std::move(dead));
  structure.add_loads(grid, surcharge, loads);
  loads.add_dofs(grid.dof_count() + extra_dofs - static_cast<int>(loads.size()));
  return make_problem(std::move(grid), ground.surface_level(), structure.regions(Region{"soil", soil}),
                      std::move(constraints), std::move(loads), executor, std::move(attached), std::move(field));
}

#ifdef SCARP_PRECOMPILED
/// What `scarp::precompiled` has of level ground over a normal fault: meshes and motions of the usual elements.
/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_GROUND(DECLARE, ELEMENT)                                                  \
  DECLARE Mesh<ELEMENT> FaultMesh::generate<ELEMENT>(std::vector<double> const&) const; \
  DECLARE void require_node_at_tip(Mesh<ELEMENT> const&, double);                       \
  DECLARE Constraints bedrock_constraints(Mesh<ELEMENT> const&, NormalFault const&, int, TimeFunction const&);

SCARP_GROUND(extern template, Tri3)
SCARP_GROUND(extern template, Tri6)
SCARP_GROUND(extern template, Quad4)
SCARP_GROUND(extern template, Quad8)
#endif

}  // namespace scarp
