// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scarp/tensor/tensor.hpp"

namespace scarp::detail {

/// Numbers at places, to be found by boxes in space: buckets of one edge length, hashed.
template <int Dim>
class PlaceIndex {
 public:
  /// edge: of a bucket [m], above zero
  explicit PlaceIndex(double edge) : edge_(edge) {}

  void add(Vector<Dim> const& place, int number) { buckets_[key(bucket(place))].push_back({place, number}); }

  /// visit(place, number) for everything between the corners low and high [m], and possibly for others
  template <class Visit>
  void near(Vector<Dim> const& low, Vector<Dim> const& high, Visit const& visit) const {
    Bucket const first = bucket(low);
    Bucket const last = bucket(high);
    Bucket at = first;
    for (int axis = 0; axis < Dim;) {
      if (auto const found = buckets_.find(key(at)); found != buckets_.end()) {
        for (auto const& entry : found->second) visit(entry.place, entry.number);
      }
      for (axis = 0; axis < Dim && ++at(axis) > last(axis); ++axis) at(axis) = first(axis);
    }
  }

  /// \return the lowest number within a distance [m] of a place, -1 if there is none
  int at(Vector<Dim> const& place, double distance) const {
    int lowest = -1;
    Vector<Dim> const reach = Vector<Dim>::Constant(distance);
    near(place - reach, place + reach, [&](Vector<Dim> const& other, int number) {
      if ((other - place).norm() <= distance && (lowest < 0 || number < lowest)) lowest = number;
    });
    return lowest;
  }

 private:
  using Bucket = Eigen::Matrix<std::int64_t, Dim, 1>;
  struct Entry {
    Vector<Dim> place;
    int number;
  };

  Bucket bucket(Vector<Dim> const& place) const {
    return (place / edge_).array().floor().matrix().template cast<std::int64_t>();
  }

  /// Different buckets may share a key: then some entries are visited in vain, or twice.
  static std::uint64_t key(Bucket const& bucket) {
    std::uint64_t mixed = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      mixed = (mixed ^ static_cast<std::uint64_t>(bucket(axis))) * 0x9e3779b97f4a7c15ULL;
      mixed ^= mixed >> 29U;
    }
    return mixed;
  }

  double edge_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> buckets_;
};

}  // namespace scarp::detail
