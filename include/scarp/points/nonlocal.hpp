// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/gmres.hpp"
#include "scarp/core/radius_search.hpp"
#include "scarp/points/point_means.hpp"

namespace scarp {

namespace detail {

template <int Dim>
struct SiteCloud {
  std::span<Site<Dim> const> sites;
  std::size_t kdtree_get_point_count() const { return sites.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return sites[i].position(static_cast<Eigen::Index>(axis));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace detail

/// Means over the points around each, in one region:
/// \f$ w_{ij} = v_j \varphi(r_{ij}/l_i) / \sum_k v_k \varphi(r_{ik}/l_i),\; \varphi(s) = (1-s)^4 (4s+1) \f$
/// below s = 1, zero beyond (H. Wendland, Adv. Comput. Math. 4 (1995) 389). This kernel is positive definite in the
/// plane and in space: no field is turned into its opposite, as the lobes of a bell's or a box's transform would do to
/// waves as short as the length. Its standard deviation along an axis is 0.264 l.
/// sites, volumes [m3] of all points; lengths [m] that a point looks around itself, 0: it stays alone
/// \throws InputError for a length that is negative or not finite, and counts that differ
template <int Dim>
NeighbourMean neighbour_mean(std::span<Site<Dim> const> sites, std::span<double const> volumes,
                             std::span<double const> lengths) {
  using Cloud = detail::SiteCloud<Dim>;
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, Dim, std::uint32_t>;
  if (volumes.size() != sites.size() || lengths.size() != sites.size()) {
    reject("{} volumes and {} lengths are given for {} points: give one of each to every point", volumes.size(),
           lengths.size(), sites.size());
  }
  Cloud const cloud{sites};
  Tree const tree(Dim, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12));
  auto const unsorted = detail::unsorted_search();
  std::vector<detail::RadiusSearchHit> hits;
  std::vector<std::size_t> first{0};
  std::vector<NeighbourMean::Share> shares;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    double const length = require_not_negative("length that increments are averaged over", lengths[i]);
    require_positive("volume of a point", volumes[i]);
    hits.clear();
    if (length > 0.0) static_cast<void>(tree.radiusSearch(sites[i].position.data(), length * length, hits, unsorted));
    std::erase_if(hits, [&](auto const& hit) {
      return hit.first == i || sites[hit.first].region != sites[i].region || !(hit.second < length * length);
    });
    hits.emplace_back(static_cast<std::uint32_t>(i), 0.0);
    std::ranges::sort(hits, {}, &detail::RadiusSearchHit::first);  // sums run in the order of the points
    double sum = 0.0;
    for (auto const& [j, squared] : hits) {
      double const s = hits.size() == 1 ? 0.0 : std::sqrt(squared) / length;
      double const weight = volumes[j] * std::pow(1.0 - s, 4) * (4.0 * s + 1.0);
      shares.push_back({static_cast<int>(j), weight});
      sum += weight;
    }
    for (std::size_t k = first.back(); k < shares.size(); ++k) shares[k].weight /= sum;
    first.push_back(shares.size());
  }
  return {std::move(first), std::move(shares)};
}

/// sites, volumes [m3], neighbourhoods and tangents [Pa] of the states that they begin with: of all points
/// \throws InputError for numbers that no neighbourhood can have, and counts that differ
template <int Dim>
PointMeans<Dim> point_means(std::span<Site<Dim> const> sites, std::span<double const> volumes,
                            std::span<Neighbourhood const> neighbourhoods,
                            std::vector<VoigtTangent<Dim>> const& initial) {
  std::vector<double> lengths;
  for (auto const& neighbourhood : neighbourhoods) lengths.push_back(detail::validated(neighbourhood).length);
  return {neighbour_mean<Dim>(sites, volumes, lengths), neighbourhoods, initial, gmres};
}

/// Any material whose points see means of the increments around them, see PointMeans, so that one that softens has a
/// length of its
/// own: `FaultScene<Nonlocal<Soil>, ...>`, or `Region{"soil", Nonlocal{soil, 2.0}}`.
/// \tparam Provider a `ConstitutiveProvider` or `AnyProvider`
template <class Provider>
struct Nonlocal {
  static constexpr int dim = Provider::dim;  ///< of the material

  Provider provider{};     ///< the material
  double length = 0.0;     ///< radius [m] of the neighbourhood; 0: the material as it is
  double stiffness = 1.0;  ///< against strain that the mean does not see, as a share of the initial tangent
  double fading = 1e-3;    ///< strain after which the stress of that stiffness has faded

  /// Settings of the means, equal for all points.
  Neighbourhood neighbourhood() const { return {length, stiffness, fading}; }

  /// How the neighbours of points are found.
  static constexpr auto means = &point_means<dim>;
};

template <class Provider, class... Numbers>
Nonlocal(Provider, Numbers...) -> Nonlocal<Provider>;

}  // namespace scarp
