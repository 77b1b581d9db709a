// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>

#include "scarp/bvp/attachment.hpp"
#include "scarp/mesh/mesh.hpp"

namespace earth_pressure {

/// Springs between pairs of nodes, so stiff that both move alike: sides of a body that is endless.
class TiedPairs {
 public:
  /// stiffness [N/m]
  TiedPairs(std::vector<std::array<int, 2>> pairs, double stiffness)
      : pairs_(std::move(pairs)), stiffness_(stiffness), apart_(pairs_.size(), scarp::Vector<2>::Zero()) {}

  static int extra_dofs() { return 0; }

  scarp::Verdict add_forces(std::vector<scarp::Vector<2>> const&, Eigen::VectorXd const& increment,
                            Eigen::VectorXd& forces) const {
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      scarp::Vector<2> const pull = stiffness_ * (apart_[k] + opening(k, increment));
      forces.segment<2>(2 * pairs_[k][0]) -= pull;
      forces.segment<2>(2 * pairs_[k][1]) += pull;
    }
    return {};
  }

  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
    for (auto const& [a, b] : pairs_) {
      for (int axis = 0; axis < 2; ++axis) {
        for (auto const& [row, column, sign] : {std::tuple{a, a, 1.0}, {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}})
          entries.emplace_back(2 * row + axis, 2 * column + axis, sign * stiffness_);
      }
    }
  }

  void commit(std::vector<scarp::Vector<2>> const&, Eigen::VectorXd const& increment) {
    for (std::size_t k = 0; k < pairs_.size(); ++k) apart_[k] += opening(k, increment);
  }

 private:
  scarp::Vector<2> opening(std::size_t k, Eigen::VectorXd const& increment) const {
    return increment.segment<2>(2 * pairs_[k][1]) - increment.segment<2>(2 * pairs_[k][0]);
  }

  std::vector<std::array<int, 2>> pairs_;
  double stiffness_;
  std::vector<scarp::Vector<2>> apart_;
};

static_assert(scarp::Attachment<TiedPairs, 2>);

/// Nodes of the left and right side at the same height.
template <class Element>
std::vector<std::array<int, 2>> opposite_nodes(scarp::Mesh<Element> const& mesh) {
  auto const sorted = [&](char const* side) {
    auto nodes = boundary_nodes(mesh, side);
    std::sort(nodes.begin(), nodes.end(), [&](int a, int b) {
      return mesh.nodes[static_cast<std::size_t>(a)].y() < mesh.nodes[static_cast<std::size_t>(b)].y();
    });
    return nodes;
  };
  auto const left = sorted("left");
  auto const right = sorted("right");
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t k = 0; k < left.size(); ++k) pairs.push_back({left[k], right[k]});
  return pairs;
}

}  // namespace earth_pressure
