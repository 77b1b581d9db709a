// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/bvp/grid.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp::detail {

/// The highest nodes of a mesh, and what the stress of level ground at rest needs there.
template <int Dim>
class GroundTop {
 public:
  /// level: height from which depths are measured [m]
  GroundTop(Grid<Dim> const& grid, double level) : grid_(grid) {
    auto const ends = std::ranges::minmax(grid.nodes(), {}, [](auto const& node) { return node(up); });
    nearly_ = 1e-6 * (ends.max(up) - ends.min(up));
    top_ = std::min(level, ends.max(up)) - nearly_;
  }

  /// \throws InputError for ground that is highest in one place only
  void require_level() const {
    auto const& nodes = grid_.nodes();
    auto const& high = *std::ranges::max_element(nodes, {}, [](auto const& node) { return node(up); });
    for (int axis = 0; axis < up; ++axis) {
      auto const is_apart = [&](auto const& node) {
        return is_top(node) && std::abs(node(axis) - high(axis)) > nearly_;
      };
      if (std::ranges::none_of(nodes, is_apart))
        reject(
            "the ground is highest at ({}) and not level there (the stress at rest is that below one level): set the "
            "level where one is meant, or give the material its own stress",
            listed(high));
    }
  }

  /// The unit weight [N/m3] of all regions, or of one that reaches the top; weights: of all.
  /// \throws InputError for an unknown region, one without weight or below another unit weight, and different weights
  /// without a name
  double weight(std::vector<double> const& weights, std::string_view region) const {
    auto const [least, most] = std::ranges::minmax(weights);
    if (region.empty() && least != most)
      reject("the stress at rest is requested of ground with unit weights from {} to {} N/m3: name a region", least,
             most);
    int const number = region.empty() ? 0 : region_number(grid_, region);
    double const weight = weights[index(number)];
    if (weight == 0.0) reject("the stress at rest is requested of ground without weight: give gravity first");
    if (least != most && !reaches_top(number))
      reject(
          "the stress at rest is requested of region '{}' below ground of another unit weight: give its material a "
          "stress of its own, with the weight above as surcharge",
          region);
    return weight;
  }

  /// The surcharge [Pa] of all sides that have one; 0 without any.
  /// \throws InputError for different ones, and for those on a part of the surface
  double surcharge(std::map<std::string, double> const& of_sides) const {
    if (of_sides.empty()) return 0.0;
    double const surcharge = of_sides.begin()->second;
    std::vector<bool> is_pressed(grid_.nodes().size());
    for (auto const& [side, pressure] : of_sides) {
      if (pressure != surcharge)
        reject("the stress at rest is requested below surcharges of {} and {} Pa: give the material its own stress",
               surcharge, pressure);
      for (int const node : grid_.boundary_nodes(side)) is_pressed[index(node)] = true;
    }
    for (std::size_t n = 0; n < is_pressed.size(); ++n) {
      if (!is_pressed[n] && is_top(grid_.nodes()[n]))
        reject(
            "the stress at rest is requested below a surcharge on a part of the surface (there is none at ({})): give "
            "it an amplitude that begins when the ground is at rest",
            listed(grid_.nodes()[n]));
    }
    return surcharge;
  }

 private:
  static constexpr int up = Dim - 1;

  bool is_top(Vector<Dim> const& node) const { return node(up) >= top_; }
  bool reaches_top(int region) const {
    auto const cells = grid_.cells();
    for (int k = 0; k < count(cells.connectivity); ++k)
      if (cells.regions[index(k / cells.nodes)] == region && is_top(grid_.nodes()[index(cells.connectivity[index(k)])]))
        return true;
    return false;
  }

  Grid<Dim> const& grid_;
  double nearly_ = 0.0;  ///< [m]
  double top_ = 0.0;     ///< height from which on nodes belong to the top [m]
};

}  // namespace scarp::detail
