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
#include "scarp/core/index.hpp"
#include "scarp/core/radius_search.hpp"

namespace scarp {

/// Weighted means over the points of a mesh around each of them, in one region:
/// \f$ \bar x_i = \sum_j w_{ij} x_j,\; w_{ij} = v_j \varphi(r_{ij}/l_i) / \sum_k v_k \varphi(r_{ik}/l_i),\;
/// \varphi(s) = (1-s)^4 (4s+1) \f$
/// below s = 1, zero beyond (H. Wendland, Adv. Comput. Math. 4 (1995) 389). This kernel is positive definite in the
/// plane and in space: no field is answered by its opposite, as the lobes of a bell's or a box's transform would do to
/// waves as short as the length. Its standard deviation along an axis is 0.264 l.
template <int Dim>
class NeighbourMean {
 public:
  struct Share {
    int point;
    double weight;
  };

  /// sites, volumes [m3] of all points; lengths [m] that a point looks around itself, 0: it stays alone
  /// \throws InputError for a length that is negative or not finite
  NeighbourMean(std::span<Site<Dim> const> sites, std::span<double const> volumes, std::span<double const> lengths) {
    Cloud const cloud{sites};
    Tree const tree(Dim, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12));
    auto const unsorted = detail::unsorted_search();
    std::vector<detail::RadiusSearchHit> hits;
    first_.push_back(0);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      double const length = require_not_negative("length that increments are averaged over", lengths[i]);
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
        shares_.push_back({static_cast<int>(j), weight});
        sum += weight;
      }
      for (std::size_t k = first_.back(); k < shares_.size(); ++k) shares_[k].weight /= sum;
      first_.push_back(shares_.size());
    }
  }

  int point_count() const { return detail::count(first_) - 1; }

  /// Points that take part in the mean of one, in increasing order; weights add up to one.
  std::span<Share const> of(int point) const {
    auto const k = detail::index(point);
    return std::span(shares_).subspan(first_[k], first_[k + 1] - first_[k]);
  }

  /// Whether every mean is the value itself.
  bool is_local() const { return shares_.size() + 1 == first_.size(); }

  /// The mean around a point; for a point alone its value, bit for bit.
  template <class Value>
  Value mean(int point, std::span<Value const> values) const {
    auto const shares = of(point);
    Value sum = shares[0].weight * values[detail::index(shares[0].point)];
    for (auto const& share : shares.subspan(1)) sum += share.weight * values[detail::index(share.point)];
    return sum;
  }

  /// The means around all points, by an executor's for_each; the same bits for any.
  template <class Value, class Executor>
  std::vector<Value> means(std::vector<Value> const& values, Executor& executor) const {
    constexpr int block = 64;
    std::vector<Value> all(values.size());
    executor.for_each((point_count() + block - 1) / block, [&](int part) {
      for (int point = block * part; point < std::min(block * (part + 1), point_count()); ++point)
        all[detail::index(point)] = mean(point, std::span<Value const>(values));
    });
    return all;
  }

 private:
  struct Cloud {
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
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, Dim, std::uint32_t>;

  std::vector<std::size_t> first_;
  std::vector<Share> shares_;
};

}  // namespace scarp
