// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <limits>

#include "scarp/fault/rupture_measures.hpp"

namespace fault_rupture {

/// Where a rupture comes out on average. With straight, rigid sides and bedrock the area of the ground decides it: for
/// the slip (a, -h) of the hanging wall and a ground of the mean depth H at rest
/// \f$ x_{mean} = x_{tip} + a / 2 - H a / h + A / h \f$
/// where x is measured from the footwall, A is the dilated area and a = h / tan(dip) for a normal fault. The area below
/// the profile follows from the divergence theorem on the outline. NaN without an offset.
struct SurfaceMean {
  double surface_mean;  ///< x now of the one step of the whole offset below which the ground has this area [m]
  double dilated_area;  ///< growth of the area of the region "soil" since the fault began to move [m2]
};

/// Integral of the height over a level along the ground surface, from left to right [m2].
template <class Element>
double area_over(scarp::Mesh<Element> const& mesh, std::vector<scarp::Vector<2>> const& places, double level) {
  using Facet = typename Element::Facet;
  double area = 0.0;
  for (auto const& name : scarp::ground_boundaries(mesh)) {
    for (auto const& facet : scarp::boundary(mesh, name)) {
      auto const rows = scarp::corners<Facet, 2>(facet, places);
      bool const to_right =
          mesh.nodes[scarp::detail::index(facet[1])].x() > mesh.nodes[scarp::detail::index(facet[0])].x();
      for (auto const& point : Facet::quadrature()) {
        double const height = rows.col(1).dot(Facet::shape(point.xi)) - level;
        double const along = scarp::jacobian<Facet, 2>(rows, point.xi)(0);
        area += (to_right ? 1.0 : -1.0) * point.weight * height * along;
      }
    }
  }
  return area;
}

/// rest, positions [m]: of the mesh's nodes when the fault began to move, see GroundAtRest, and now
/// \throws InputError for positions of another mesh and a mesh without surface or soil
template <class Element>
  requires(Element::dim == 2)
SurfaceMean surface_mean(scarp::Mesh<Element> const& mesh, std::vector<scarp::Vector<2>> const& rest,
                         std::vector<scarp::Vector<2>> const& positions, scarp::FaultOffset const& fault) {
  auto const profile = scarp::surface_profile(mesh, rest, positions);
  double const width = profile.back().x_initial - profile.front().x_initial;
  double const level = area_over(mesh, rest, 0.0) / width;
  double const missing = -area_over(mesh, positions, level - fault.foot);
  double const offset = fault.hanging - fault.foot;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {.surface_mean = offset == 0.0 ? none : profile.back().x - missing / offset,
          .dilated_area = scarp::region_area(mesh, "soil", positions) - scarp::region_area(mesh, "soil", rest)};
}

}  // namespace fault_rupture
