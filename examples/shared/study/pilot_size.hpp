// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/mesh/refined.hpp"
#include "scarp/tensor/geo.hpp"

namespace fault_rupture {

/// Small elements where a pilot run on a coarse mesh has strained the ground; the size grows linearly around these.
struct PilotSize {
  std::vector<scarp::Vector<2>> strained;  ///< [m], see strained_places
  double margin = 4.0;                     ///< around each of them [m], at least the size of the pilot run's elements
  double fine = 1.25;                      ///< size up to the margin [m]
  double coarse = 5.0;                     ///< size from `transition` beyond the margin on [m]
  double transition = 14.0;                ///< [m]

  /// Outermost edges of the small elements at a height of the mesh [m]; not finite where it has none.
  std::array<double, 2> edges(double height) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 2> found{infinity, -infinity};
    for (auto const& place : strained) {
      double const square = margin * margin - (place.y() - height) * (place.y() - height);
      if (square < 0.0) continue;
      found = {std::min(found[0], place.x() - std::sqrt(square)), std::max(found[1], place.x() + std::sqrt(square))};
    }
    return found;
  }

  /// \throws InputError for parameters that give no sizes
  void validate() const {
    if (strained.empty()) scarp::reject("the pilot run has strained 0 places: use a larger share of its strain");
    scarp::require_not_negative("margin around strained places", margin);
    scarp::require_positive("size of elements near strained places", fine);
    scarp::require_at_least("size of elements far from strained places", coarse, fine);
    scarp::require_positive("transition next to strained places", transition);
  }

  /// Size of an element [m] at a place [m], by the distance from the nearest strained place.
  double size(scarp::Vector<2> const& place) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (auto const& other : strained) nearest = std::min(nearest, (other - place).squaredNorm());
    return fine + (coarse - fine) * std::clamp((std::sqrt(nearest) - margin) / transition, 0.0, 1.0);
  }
};

/// Where a run has strained the ground most: centres [m], on its mesh before anything moved, of the elements with the
/// largest deviatoric strains that together have the share of the sum of deviatoric strain over volume.
/// share: 1 for all elements that are strained
/// \throws InputError for a share outside of 0 to 1, and for ground that has no strain
template <class Problem>
  requires(std::remove_cvref_t<decltype(std::declval<Problem const&>().discretisation())>::dim == 2)
std::vector<scarp::Vector<2>> strained_places(Problem const& problem, double share) {
  scarp::require_between("share of the strain", share, 0.0, 1.0);
  auto const& grid = problem.discretisation();
  using Grid = std::remove_cvref_t<decltype(grid)>;
  auto const& mesh = grid.mesh();
  auto const volumes = grid.volumes(Eigen::VectorXd::Zero(grid.dof_count()));
  struct Part {
    double strain = 0.0;  // times volume
    double volume = 0.0;
    scarp::Vector<2> centre = scarp::Vector<2>::Zero();
  };
  std::vector<Part> parts(mesh.elements.size());
  double all = 0.0;
  for (int point = 0; point < grid.point_count(); ++point) {
    auto& part = parts[scarp::detail::index(point / Grid::points_per_element)];
    double const volume = volumes[scarp::detail::index(point)];
    double const strain = volume * scarp::geo::strain<2>(grid.deformation(point)).deviatoric;
    part.volume += volume;
    part.strain += strain;
    all += strain;
  }
  if (!(all > 0.0)) scarp::reject("the strain of the pilot run is {} (nothing has moved): apply a throw", all);
  for (std::size_t e = 0; e < parts.size(); ++e) {
    for (int const node : mesh.elements[e]) parts[e].centre += mesh.nodes[scarp::detail::index(node)];
    parts[e].centre /= static_cast<double>(mesh.elements[e].size());
  }
  std::ranges::stable_sort(parts, std::ranges::greater{}, [](Part const& part) { return part.strain / part.volume; });
  std::vector<scarp::Vector<2>> places;
  double sum = 0.0;
  for (auto const& part : parts) {
    if (sum >= share * all) break;
    sum += part.strain;
    places.push_back(part.centre);
  }
  return places;
}

static_assert(scarp::SizeField<PilotSize>);

}  // namespace fault_rupture
