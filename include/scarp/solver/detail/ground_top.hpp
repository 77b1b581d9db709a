// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/bvp/grid.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp::detail {

/// The top of the ground, its highest nodes or a lower level, and what the stress of level ground at rest needs there.
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

  /// The unit weight [N/m3] of all regions, or of one that nothing of another weight lies above; weights: of all.
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
    if (least != most && is_below_others(weights, number))
      reject(
          "the stress at rest is requested of region '{}' below ground of another unit weight: give its material a "
          "stress of its own, with the weight above as surcharge",
          region);
    return weight;
  }

  /// The surcharge [Pa] of all sides that have one; 0 without any.
  /// \throws InputError for different ones, and for those on a part of the surface
  double surcharge(std::map<std::string, double> const& of_sides) const {
    double surcharge = 0.0;
    std::vector<bool> is_pressed(grid_.nodes().size());
    for (auto const& [side, pressure] : of_sides) {
      if (pressure == 0.0) continue;
      if (surcharge == 0.0) surcharge = pressure;
      if (pressure != surcharge)
        reject("the stress at rest is requested below surcharges of {} and {} Pa: give the material its own stress",
               surcharge, pressure);
      for (int const node : grid_.boundary_nodes(side)) is_pressed[index(node)] = true;
    }
    if (surcharge == 0.0) return 0.0;
    for (std::size_t n = 0; n < is_pressed.size(); ++n) {
      if (!is_pressed[n] && is_top(grid_.nodes()[n]))
        reject(
            "the surcharge is on a part of the surface (not at ({}); the stress at rest is that below a uniform one): "
            "give it an amplitude that begins at the load factor 1",
            listed(grid_.nodes()[n]));
    }
    return surcharge;
  }

 private:
  static constexpr int up = Dim - 1;

  bool is_top(Vector<Dim> const& node) const { return node(up) >= top_; }

  struct Box {
    Vector<Dim> low = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
    Vector<Dim> high = -low;

    void add(Vector<Dim> const& place) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  };

  /// Whether elements of another weight are higher than the region anywhere within its width, below the level.
  bool is_below_others(std::vector<double> const& weights, int region) const {
    auto const cells = grid_.cells();
    Box own;
    std::vector<Box> others;
    for (int e = 0; e < cells.count(); ++e) {
      int const there = cells.regions[index(e)];
      Box box;
      for (int k = cells.nodes * e; k < cells.nodes * (e + 1); ++k)
        box.add(grid_.nodes()[index(cells.connectivity[index(k)])]);
      if (there == region) {
        own.add(box.low);
        own.add(box.high);
      } else if (weights[index(there)] != weights[index(region)]) {
        others.push_back(box);
      }
    }
    return std::ranges::any_of(others, [&](Box const& box) {
      bool above = std::min(box.high(up), top_) > own.high(up) + nearly_;
      for (int axis = 0; axis < up; ++axis)
        above = above && box.low(axis) < own.high(axis) - nearly_ && box.high(axis) > own.low(axis) + nearly_;
      return above;
    });
  }

  Grid<Dim> const& grid_;
  double nearly_ = 0.0;  ///< [m]
  double top_ = 0.0;     ///< height from which on nodes belong to the top [m]
};

}  // namespace scarp::detail
