// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/constitutive/linear_elastic.hpp"
#include "scarp/fault/fault_scene.hpp"
#include "scarp/fault/strip_footing.hpp"
#include "scarp/fault/strip_on_surface.hpp"
#include "scarp/run/root_rank.hpp"

namespace scarp {

/// A strip footing as an elastic block that shares the ground's nodes: neither slip nor gap, tension is transmitted,
/// as in the reference study.
struct TiedFooting {
  StripFooting footing{};                                            ///< place, width and weight
  double height = 1.0;                                               ///< [m]
  LinearElastic<2> block = LinearElastic<2>::from_lame(20e9, 12e9);  ///< the reference study's

  /// \throws InputError
  std::vector<double> edges() const { return footing.edges(); }
  /// Adds the block's elements to the mesh, as the region "footing".
  template <class Element>
  void put_on(Mesh<Element>& mesh) const {
    mark_footing_base(mesh, footing.centre, footing.width);
    double const facets = static_cast<double>(boundary(mesh, "footing_base").size());
    add_footing_block(mesh, height, footing.width / facets);
  }
  static constexpr double start() { return -1.0; }  ///< Load factor before the footing is placed.

  /// Weight [N] of the block, which replaces the surcharge [Pa] below it, as the load factor grows from -1 to 0.
  template <class Grid>
  void add_loads(Grid const& grid, double surcharge, LoadHistory& loads) const {
    add_uncovered_surcharge(grid, surcharge, start(), loads);
    loads.add(weight(grid), TimeFunction::ramp(start(), 0.0));
  }

  /// Nothing is attached to the mesh: the block is part of it.
  template <class Grid>
  static NoAttachment attached(Grid const&) {
    return {};
  }

  /// Materials of the mesh: the soil and the block, as "footing".
  template <class Soil>
  auto regions(Region<Soil> const& soil) const {
    return boost::hana::make_tuple(soil, Region<LinearElastic<2>>{"footing", block});
  }

  /// Stresses on the base are nodal forces between block and ground over each node's share of the base.
  /// load: factor of the committed state; below 0 a part of the block's weight acts
  template <class Problem>
  FootingMotion motion(Problem const& problem, double load = 0.0) const {
    auto const& grid = problem.discretisation();
    auto const& mesh = grid.mesh();
    auto nodes = boundary_nodes(mesh, "footing_base");
    using detail::index;
    std::sort(nodes.begin(), nodes.end(),
              [&](int a, int b) { return mesh.nodes[index(a)].x() < mesh.nodes[index(b)].x(); });
    Vector<2> const left = grid.positions()[index(nodes.front())];
    Vector<2> const right = grid.positions()[index(nodes.back())];
    Vector<2> const moved =
        (left + right) / 2.0 - (mesh.nodes[index(nodes.front())] + mesh.nodes[index(nodes.back())]) / 2.0;
    FootingMotion motion{-moved.y(), moved.x(), std::atan2(left.y() - right.y(), right.x() - left.x()), {}};
    Eigen::VectorXd const forces = forces_of_block(problem, load);
    Eigen::VectorXd const shares = grid.traction("footing_base", Vector<2>(1.0, 0.0));
    for (int const node : nodes) {
      double const area = shares(2 * node);
      Vector<2> const stress = forces.segment<2>(2 * node) / area;
      motion.base.push_back({grid.positions()[index(node)], area, stress, stress.y(), -stress.x(), 0.0});
    }
    return motion;
  }

 private:
  template <class Grid>
  Eigen::VectorXd weight(Grid const& grid) const {
    int const region = region_number(grid.mesh(), "footing");
    return grid.body_force(
        [&](int number) { return Vector<2>(0.0, number == region ? -footing.bearing / height : 0.0); });
  }

  /// Forces that the block alone needs at its nodes, its weight included.
  template <class Problem>
  Eigen::VectorXd forces_of_block(Problem const& problem, double load) const {
    auto const& grid = problem.discretisation();
    std::vector<VoigtStress<2>> stresses(detail::index(grid.point_count()), VoigtStress<2>::Zero());
    int const region = region_number(grid.mesh(), "footing");
    for (int point = 0; point < grid.point_count(); ++point) {
      if (grid.site(point, 0.0).region == region) stresses[detail::index(point)] = committed_stress(problem, point);
    }
    Eigen::VectorXd forces;
    grid.internal_force(Eigen::VectorXd::Zero(grid.dof_count()), stresses, forces);
    return forces - std::clamp(load - start(), 0.0, 1.0) * weight(grid);
  }
};

}  // namespace scarp
