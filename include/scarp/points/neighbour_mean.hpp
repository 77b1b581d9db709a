// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "scarp/core/executor.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Weighted means \f$ \bar x_i = \sum_j w_{ij} f_j x_j / \sum_j w_{ij} f_j \f$ over some points around each of many;
/// points/nonlocal.hpp finds neighbours and weights.
class NeighbourMean {
 public:
  /// A neighbour and its weight.
  struct Share {
    int point;      ///< number of the neighbour
    double weight;  ///< share in the mean, without unit
  };

  NeighbourMean() = default;
  /// first: where in `shares` the neighbours of each point begin, and their end; shape (points + 1). Of each point they
  /// are in increasing order, and their weights add up to one.
  NeighbourMean(std::vector<std::size_t> first, std::vector<Share> shares)
      : first_(std::move(first)), shares_(std::move(shares)) {}

  int size() const { return detail::count(first_) - 1; }  ///< Number of points.

  /// Points that take part in the mean of one, in increasing order; weights add up to one.
  std::span<Share const> of(int point) const {
    auto const k = detail::index(point);
    return std::span(shares_).subspan(first_[k], first_[k + 1] - first_[k]);
  }

  /// Whether every mean is the value itself.
  bool is_local() const { return shares_.size() + 1 == first_.size(); }

  /// The mean around a point; for a point alone its value, bit for bit. factors: of all points, more than zero
  template <class Value>
  Value mean(int point, std::span<Value const> values, std::span<double const> factors) const {
    auto const shares = of(point);
    if (shares.size() == 1) return values[detail::index(shares[0].point)];
    double whole = shares[0].weight * factors[detail::index(shares[0].point)];
    Value sum = whole * values[detail::index(shares[0].point)];
    for (auto const& share : shares.subspan(1)) {
      double const weight = share.weight * factors[detail::index(share.point)];
      whole += weight;
      sum += weight * values[detail::index(share.point)];
    }
    return sum / whole;
  }

  /// The means around all points, by an executor's for_each; the same bits for any.
  template <class Value>
  std::vector<Value> means(std::vector<Value> const& values, std::span<double const> factors,
                           Executor const& executor) const {
    constexpr int block = 64;
    std::vector<Value> all(values.size());
    executor.for_each((size() + block - 1) / block, [&](int part) {
      for (int point = block * part; point < std::min(block * (part + 1), size()); ++point)
        all[detail::index(point)] = mean(point, std::span<Value const>(values), factors);
    });
    return all;
  }

 private:
  std::vector<std::size_t> first_{0};
  std::vector<Share> shares_;
};

}  // namespace scarp
