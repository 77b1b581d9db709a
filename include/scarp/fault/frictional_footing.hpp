// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/bvp/interface.hpp"
#include "scarp/bvp/standing_body.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/fault/fault_scene.hpp"
#include "scarp/fault/strip_footing.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/mesh/facets.hpp"

namespace scarp {

/// A rigid strip footing on an interface. With the default law, Coulomb friction and no tension, it may slide, tilt and
/// lift.
template <CheckedContactLaw Law = LinearFrictional>
struct FrictionalFooting {
  StripFooting footing{};  ///< place, width and weight
  Law interface {};        ///< [Pa/m] where grains have [N/m]

  /// \throws InputError
  std::vector<double> edges() const { return footing.edges(); }
  /// Names the part of the surface below the footing "footing_base".
  template <class Element>
  void put_on(Mesh<Element>& mesh) const {
    mark_footing_base(mesh, footing.centre, footing.width);
  }
  static constexpr double start() { return -1.0; }  ///< Load factor before the footing is placed.

  /// Weight [N] of the footing, which replaces the surcharge [Pa] below it, as the load factor grows from -1 to 0.
  template <class Grid>
  void add_loads(Grid const& grid, double surcharge, LoadHistory& loads) const {
    add_uncovered_surcharge(grid, surcharge, start(), loads);
    loads.add_dofs(RigidBody::extra_dofs);
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(loads.size());
    weight(grid.dof_count() + 1) = -footing.bearing * footing.width * grid.thickness();
    loads.add(std::move(weight), TimeFunction::ramp(start(), 0.0));
  }

  /// Rigid body on the interface, also beside the base, where it may slide to.
  template <class Grid>
  Interface<Law, RigidFooting> attached(Grid const& grid) const {
    auto const& mesh = grid.mesh();
    auto ground = straight_facets(mesh, "footing_base");
    double const level = mesh.nodes[detail::index(ground.front().front())].y();
    std::vector<double> breaks;
    for (int const node : boundary_nodes(mesh, "footing_base")) breaks.push_back(mesh.nodes[detail::index(node)].x());
    auto const beside = straight_facets(mesh, "surface");
    ground.insert(ground.end(), beside.begin(), beside.end());
    double const half = footing.width / 2.0;
    RigidFooting const body({{footing.centre, level}, half}, {footing.centre - half, level},
                            {footing.centre + half, level}, breaks, grid.thickness(), grid.dof_count());
    return {interface, body, FacetChain(std::move(ground)), mesh.nodes};
  }

  /// Materials of the mesh: the soil; the footing is no part of it.
  template <class Soil>
  static auto regions(Region<Soil> const& soil) {
    return boost::hana::make_tuple(soil);
  }

  /// Motion [m, rad] of the rigid body, and the interface's points, whatever part of its weight acts.
  template <class Problem>
  FootingMotion motion(Problem const& problem, double = 0.0) const {
    auto const& attached = problem.template attached<Interface<Law, RigidFooting>>();
    auto const& body = attached.body().body();
    auto const& mesh = problem.discretisation().mesh();
    int const node = boundary(mesh, "footing_base").front().front();
    Vector<2> const start(footing.centre, mesh.nodes[detail::index(node)].y());
    return {start.y() - body.reference().y(), body.reference().x() - start.x(), -body.rotation(), attached.points()};
  }
};

}  // namespace scarp
