// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <limits>

#include "scarp/fault/rupture_measures.hpp"
#include "scarp/mesh/region_area.hpp"

namespace scarp {

/// Where a rupture comes out on average. With straight, rigid sides and bedrock the area of the ground decides it: for
/// the slip (a, -h) of the hanging wall and a ground of the mean depth H at rest
/// \f$ x_{mean} = x_{tip} + a / 2 - H a / h + A / h \f$
/// where x is measured from the footwall, A is the dilated area and a = h / tan(dip) for a normal fault. The area below
/// the profile follows from the divergence theorem on the outline. NaN without an offset.
struct SurfaceMean {
  double surface_mean;  ///< x now of the one step of the whole offset below which the ground has this area [m]
  double dilated_area;  ///< growth of the area of the region "soil" since the fault began to move [m2]
};

namespace detail {

/// Integral of the height over a level along the ground surface, from left to right [m2].
template <class Element>
double area_over(Mesh<Element> const& mesh, std::vector<Vector<2>> const& places, double level) {
  using Facet = typename Element::Facet;
  double area = 0.0;
  for (auto const& name : ground_boundaries(mesh)) {
    for (auto const& facet : boundary(mesh, name)) {
      auto const rows = corners<Facet, 2>(facet, places);
      bool const to_right = mesh.nodes[index(facet[1])].x() > mesh.nodes[index(facet[0])].x();
      for (auto const& point : Facet::quadrature()) {
        double const height = rows.col(1).dot(Facet::shape(point.xi)) - level;
        double const along = jacobian<Facet, 2>(rows, point.xi)(0);
        area += (to_right ? 1.0 : -1.0) * point.weight * height * along;
      }
    }
  }
  return area;
}

}  // namespace detail

/// rest, positions [m]: of the mesh's nodes when the fault began to move, see GroundAtRest, and now
/// \throws InputError for positions of another mesh and a mesh without surface or soil
template <class Element>
  requires(Element::dim == 2)
SurfaceMean surface_mean(Mesh<Element> const& mesh, std::vector<Vector<2>> const& rest,
                         std::vector<Vector<2>> const& positions, FaultOffset const& fault) {
  auto const profile = surface_profile(mesh, rest, positions);
  double const width = profile.back().x_initial - profile.front().x_initial;
  double const level = detail::area_over(mesh, rest, 0.0) / width;
  double const missing = -detail::area_over(mesh, positions, level - fault.foot);
  double const offset = fault.hanging - fault.foot;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {.surface_mean = offset == 0.0 ? none : profile.back().x - missing / offset,
          .dilated_area = region_area(mesh, "soil", positions) - region_area(mesh, "soil", rest)};
}

}  // namespace scarp
