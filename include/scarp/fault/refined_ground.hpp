// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scarp/fault/ground.hpp"
#include "scarp/mesh/refined.hpp"

namespace scarp {

/// Small elements in a strip around the line along which a rupture is expected, from the fault's tip upwards and, for a
/// dip below 90 degrees, to the left; the size grows linearly outside the strip.
struct StripSize {
  double tip = 0.0;          ///< x [m]
  double bedrock = 0.0;      ///< height of the tip [m]
  double dip = 1.107;        ///< of the line [rad]; in dilating sand above the dip of a normal fault
  double half_width = 4.0;   ///< along x, at the tip [m]
  double widening = 0.16;    ///< of half the width over the height
  double fine = 1.25;        ///< size inside [m]
  double coarse = 5.0;       ///< size from `transition` outside on [m]
  double transition = 14.0;  ///< along x [m]

  /// Left and right edge of the strip at a height above bedrock [m].
  std::array<double, 2> edges(double height) const {
    double const middle = tip - height / std::tan(dip);
    double const half = half_width + widening * height;
    return {middle - half, middle + half};
  }

  /// \throws InputError for parameters that make no strip
  void validate() const {
    require_finite("tip of the strip", tip);
    require_finite("height of the strip's tip", bedrock);
    require_between("dip of the strip", dip, 1e-3, std::numbers::pi - 1e-3);
    require_not_negative("half width of the strip", half_width);
    require_finite("widening of the strip", widening);
    require_positive("size of elements in the strip", fine);
    require_at_least("size of elements far from the strip", coarse, fine);
    require_positive("transition next to the strip", transition);
  }

  /// Size of an element [m] at a place [m], by the horizontal distance from the strip.
  double size(Vector<2> const& place) const {
    auto const [left, right] = edges(place.y() - bedrock);
    double const outside = std::max(left - place.x(), place.x() - right);
    return fine + (coarse - fine) * std::clamp(outside / transition, 0.0, 1.0);
  }
};

/// Any plane ground with the elements of its mesh refined where a field wants them smaller, see `refined`. The ground's
/// own mesh is as coarse as the field's largest size; the directions of its sides, its jitter and its seed carry over.
template <Ground GroundType, SizeField Field = StripSize>
  requires(GroundType::Element::dim == 2)
struct RefinedGround {
  using Element = typename GroundType::Element;  ///< of the mesh

  GroundType ground{};  ///< whose mesh is refined
  Field field{};        ///< size of elements by place

  /// edges: x [m] where a structure needs corner nodes on the surface
  /// \throws InputError for a ground or a field that cannot be used
  Mesh<Element> mesh(std::vector<double> const& edges) const {
    return refined(ground.mesh(edges), detail::validated(field));
  }

  double surface_level() const { return ground.surface_level(); }  ///< along the last axis [m]
};

template <class GroundType, class Field>
RefinedGround(GroundType, Field) -> RefinedGround<GroundType, Field>;

static_assert(Ground<RefinedGround<StructuredGround<>>>);

}  // namespace scarp
