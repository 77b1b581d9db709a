// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/core/precompiled.hpp"
#ifdef SCARP_PRECOMPILED
#include "scarp/element/quad4.hpp"
#include "scarp/element/quad8.hpp"
#include "scarp/element/tri3.hpp"
#include "scarp/element/tri6.hpp"
#endif
#include "scarp/observe/level_profile.hpp"
#include "scarp/observe/rupture_measures.hpp"

namespace scarp {

/// The band through which the offset of a fault passes, where it crosses a level inside the ground. NaN where it does
/// not.
struct BandAtLevel {
  double height;       ///< above the bottom of the ground [m]
  double band_x50;     ///< place at rest that has gone half of the offset [m]
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
  double const width = first_passage(profile, fault, 0.95) - first_passage(profile, fault, 0.05);
  double const dip = line_dip(middle(level - reach) - middle(level + reach), 2.0 * reach);
  return {level, first_passage(profile, fault, 0.5), width, width * std::sin(dip), dip};
}

/// A rupture from bedrock to surface, so that meshes, soils and seeds can be compared.
struct RuptureSurvey {
  double depth;  ///< height of the surface above the fault's tip [m]
  RuptureMeasures surface;
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
