// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <vector>

#include "scarp/core/precompiled.hpp"
#include "scarp/fault/rupture_measures.hpp"
#include "scarp/fault/surface_profile.hpp"
#include "scarp/mesh/mesh.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#endif

namespace scarp {

namespace detail {

/// visit(a, b) for the straight parts of an element's sides, as node numbers of the mesh in increasing order: two parts
/// where a side has a node in its middle.
template <class Element, class Visit>
void for_each_edge(std::array<int, Element::nodes> const& nodes, Visit const& visit) {
  auto const part = [&](int a, int b) { visit(std::min(a, b), std::max(a, b)); };
  for (auto const& facet : Element::facets()) {
    int const first = nodes[index(facet[0])];
    int const last = nodes[index(facet[1])];
    if constexpr (Element::facet_nodes == 3) {
      int const middle = nodes[index(facet[2])];
      part(first, middle);
      part(middle, last);
    } else {
      part(first, last);
    }
  }
}

}  // namespace detail

/// Where a level line crosses the sides of the elements, from left to right, as a profile inside the ground. Settlement
/// is linear along sides, on each half of a side with a node in its middle.
/// height [m]: of the line where the nodes were at rest; along the bottom it crosses nothing
/// rest, positions [m]: of the mesh's nodes when the fault began to move, see GroundAtRest, and now
/// \throws InputError for positions of another mesh
template <class Element>
  requires(Element::dim == 2)
std::vector<SurfacePoint> level_profile(Mesh<Element> const& mesh, std::vector<Vector<2>> const& rest,
                                        std::vector<Vector<2>> const& positions, double height) {
  static_assert(Element::facet_nodes <= 3, "sides are lines of two or three nodes");
  detail::require_for_each_node("positions at rest", rest.size(), mesh.nodes.size());
  detail::require_for_each_node("positions", positions.size(), mesh.nodes.size());
  std::vector<detail::Placed> crossings;
  std::vector<detail::Span> spans;
  for (auto const& nodes : mesh.elements) {
    std::size_t const before = crossings.size();
    detail::for_each_edge<Element>(nodes, [&](int a, int b) {
      auto const i = detail::index(a);
      auto const j = detail::index(b);
      double const from = rest[i].y() - height;
      double const to = rest[j].y() - height;
      if ((from >= 0.0) == (to >= 0.0))
        return;  // a node on the line counts as above it: no crossing is lost or found twice
      double const part = from / (from - to);
      Vector<2> const was = rest[i] + part * (rest[j] - rest[i]);
      Vector<2> const is = positions[i] + part * (positions[j] - positions[i]);
      crossings.push_back({was.x(), {was.x(), is.x(), was.y() - is.y(), false}});
    });
    if (crossings.size() == before) continue;
    detail::Span span{crossings.back().along, crossings.back().along};
    for (std::size_t k = before; k < crossings.size(); ++k) {
      span.from = std::min(span.from, crossings[k].along);
      span.to = std::max(span.to, crossings[k].along);
    }
    spans.push_back(span);
  }
  return detail::joined_places(std::move(crossings), spans);
}

/// The band through which the offset of a fault passes, where it crosses a level inside the ground. NaN where it does
/// not.
struct BandAtLevel {
  double height;       ///< above the bottom of the ground [m]
  double band_x05;     ///< place at rest that has gone 5 % of the offset [m], the left end of band_width
  double band_x50;     ///< place that has gone half of it [m]
  double band_width;   ///< along the level, between 5 and 95 % of the offset [m]
  double band_across;  ///< the same across the band, by its dip here [m]
  double band_dip;     ///< of its middle line from `reach` below to `reach` above, see line_dip [rad]
};

/// level, reach [m]: a height in the coordinates of the nodes at rest, and how far below and above it the middle line
/// is looked for
/// \throws InputError for positions of another mesh
template <class Element>
  requires(Element::dim == 2)
BandAtLevel band_at_level(Mesh<Element> const& mesh, std::vector<Vector<2>> const& rest,
                          std::vector<Vector<2>> const& positions, FaultOffset const& fault, double level,
                          double reach) {
  auto const middle = [&](double height) {
    return first_passage(level_profile(mesh, rest, positions, height), fault, 0.5);
  };
  auto const profile = level_profile(mesh, rest, positions, level);
  double const left = first_passage(profile, fault, 0.05);
  double const width = first_passage(profile, fault, 0.95) - left;
  double const dip = line_dip(middle(level - reach) - middle(level + reach), 2.0 * reach);
  return {level, left, first_passage(profile, fault, 0.5), width, width * std::sin(dip), dip};
}

/// A rupture from bedrock to surface, so that meshes, soils and seeds can be compared.
struct RuptureSurvey {
  double depth;                      ///< height of the surface above the fault's tip [m]
  RuptureMeasures surface;           ///< measures of the surface's profile
  std::array<BandAtLevel, 3> bands;  ///< at a quarter, half and three quarters of the depth
};

/// Extents are read from the mesh: boundary "bottom", and ground_boundaries(mesh) for the surface, both above the
/// fault's tip. Dips of bands are taken over a quarter of the depth, so that the three together follow the band from an
/// eighth to seven eighths of it.
/// rest, positions [m]: of the mesh's nodes when the fault began to move, see GroundAtRest, and now
/// \throws InputError for positions of another mesh and a mesh without these boundaries
template <class Element>
  requires(Element::dim == 2)
SCARP_EXPORT RuptureSurvey rupture_survey(Mesh<Element> const& mesh, std::vector<Vector<2>> const& rest,
                                          std::vector<Vector<2>> const& positions, FaultOffset const& fault) {
  auto const profile = surface_profile(mesh, rest, positions);
  auto const level_at_tip = [&](std::vector<std::string> const& boundaries) {
    double level = std::numeric_limits<double>::quiet_NaN();
    double least = std::numeric_limits<double>::infinity();
    for (auto const& name : boundaries) {
      for (int const node : boundary_nodes(mesh, name)) {
        auto const& place = rest[detail::index(node)];
        double const apart = std::abs(place.x() - fault.tip);
        if (!(apart < least)) continue;
        least = apart;
        level = place.y();
      }
    }
    return level;
  };
  double const bottom = level_at_tip({"bottom"});
  double const depth = level_at_tip(ground_boundaries(mesh)) - bottom;
  auto const band = [&](double share) {
    auto found = band_at_level(mesh, rest, positions, fault, bottom + share * depth, depth / 8.0);
    found.height = share * depth;
    return found;
  };
  return {depth, rupture_measures(profile, fault, depth), {band(0.25), band(0.5), band(0.75)}};
}

#ifdef SCARP_PRECOMPILED
/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_SURVEY(DECLARE, ELEMENT)                                                      \
  DECLARE RuptureSurvey rupture_survey(Mesh<ELEMENT> const&, std::vector<Vector<2>> const&, \
                                       std::vector<Vector<2>> const&, FaultOffset const&);
#define SCARP_SURVEYS(DECLARE) \
  SCARP_SURVEY(DECLARE, Tri3) SCARP_SURVEY(DECLARE, Tri6) SCARP_SURVEY(DECLARE, Quad4) SCARP_SURVEY(DECLARE, Quad8)
SCARP_SURVEYS(extern template)
#endif

}  // namespace scarp
