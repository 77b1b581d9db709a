// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "scarp/bvp/detail/corner_field.hpp"
#include "scarp/bvp/pore_water_settings.hpp"
#include "scarp/core/index.hpp"

namespace scarp::detail {

/// What of a field is at a water table or above it.
struct Above {
  std::vector<int> corners;
  std::vector<int> elements;  ///< with all corners
};

/// level: height of the water table [m] \throws InputError for one below the whole ground
template <class Field>
Above above(Field const& field, double level) {
  auto const& nodes = field.grid().nodes();
  auto const up = [](auto const& place) { return place(Field::dim - 1); };
  auto const [lowest, highest] = std::ranges::minmax(nodes, {}, up);
  double const same = 1e-9 * (up(highest) - up(lowest));
  auto const is_above = [&](int corner) { return up(field.place(corner)) >= level - same; };
  Above found;
  for (int corner = 0; corner < field.count(); ++corner)
    if (is_above(corner)) found.corners.push_back(corner);
  if (count(found.corners) == field.count())
    reject("the water table is at a height of {} m (the ground begins at {} m and has none): raise it", level,
           up(lowest));
  for (int element = 0; element < count(field.grid().mesh().elements); ++element)
    if (std::ranges::all_of(field.corners_of(element), is_above)) found.elements.push_back(element);
  return found;
}

/// Vapour at the corners of a field of excess pressures u: where u falls below the lowest that water has, it takes a
/// volume that is proportional to what u lacks.
class Vapour {
 public:
  using Values = Eigen::VectorXd;

  /// modulus [Pa]: volume over what the pressure lacks
  template <class Field>
  Vapour(Field const& field, WaterAtRest const& rest, double modulus) : lowest_(field.count()) {
    for (int corner = 0; corner < field.count(); ++corner)
      lowest_(corner) = rest.cavitation - rest.pressure(field.place(corner)(Field::dim - 1));
    auto const volumes = field.grid().volumes(Values::Zero(field.grid().dof_count()));
    slopes_ = field.shapes().transpose() * viewed(volumes) / modulus;
  }

  Values volumes(Values const& pressures) const { return slopes_.cwiseProduct((lowest_ - pressures).cwiseMax(0.0)); }
  /// By which a corner's volume grows as its pressure falls [m3/Pa].
  double slope(int corner, double pressure) const { return pressure < lowest_(corner) ? slopes_(corner) : 0.0; }
  /// A linear step from water alone ends where vapour begins; of a motion through there its part below continues.
  /// corners: whose pressures change by scale [Pa] times last, shape (corners), and the last entries of next, from
  /// start
  void limit(std::vector<int> const& corners, Values const& start, double scale, Values const& last,
             Values& next) const {
    Eigen::Index row = next.size() - last.size();
    constexpr double within = 1e-6;  // [Pa], so that round-off does not leave a corner above
    for (Eigen::Index k = 0; k < last.size(); ++k, ++row) {
      int const corner = corners[static_cast<std::size_t>(k)];
      double const begins = (lowest_(corner) - within - start(corner)) / scale;
      if (last(k) > begins && next(row) < begins) next(row) = begins < 0.0 ? begins : next(row) * begins / last(k);
    }
  }

 private:
  Values lowest_;  ///< [Pa]
  Values slopes_;  ///< [m3/Pa]
};

}  // namespace scarp::detail
