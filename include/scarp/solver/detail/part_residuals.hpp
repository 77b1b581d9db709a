// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/grid.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/solver/step_report.hpp"
#include "scarp/tensor/tensor.hpp"

namespace scarp::detail {

/// Square of a vector's Euclidean norm over some degrees of freedom.
inline double squared_over(std::vector<int> const& dofs, Eigen::VectorXd const& forces) {
  double sum = 0.0;
  for (int const dof : dofs) sum += forces(dof) * forces(dof);
  return sum;
}

/// Imbalance of a problem as a whole, see Problem::residuals.
struct WholeResidual {
  std::vector<int> free_dofs;
  std::vector<int> prescribed_dofs;
  double carried = 0.0;        ///< at free degrees of freedom in the last evaluation, squared [N2]
  double largest_scale = 0.0;  ///< of the committed states that were evaluated, squared [N2]

  /// The residual of the degrees of freedom below `count`.
  static WholeResidual of(Constraints const& constraints, int count) {
    auto const below = [count](std::vector<int> dofs) {
      std::erase_if(dofs, [count](int dof) { return dof >= count; });
      return dofs;
    };
    return {below(constraints.free_dofs()), below(constraints.prescribed_dofs())};
  }

  /// Takes forces [N] of a part, such as the elements, into account.
  void carry(Eigen::VectorXd const& forces) { carried = std::max(carried, squared_over(free_dofs, forces)); }

  double residual(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads) const {
    constexpr double least = 1e-3 * 1e-3;  // of the largest scale, squared
    double const free = squared_over(free_dofs, unbalanced);
    return free == 0.0 ? 0.0 : std::sqrt(free / std::max(scale(unbalanced, loads), least * largest_scale));
  }
  /// What residuals are relative to, squared [N2]. Reactions alone may be round-off: those of a body that is pressed
  /// from all sides.
  double scale(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads) const {
    return std::max({squared_over(prescribed_dofs, unbalanced), loads.squaredNorm(), carried});
  }
};

/// How large a part's loads were at the knots of their history: what passes through zero has no size of its own there.
class PastLoads {
 public:
  /// size [N] at the next knot, a load factor
  void add(double load, double size) {
    sizes_.emplace_back(load, std::max(size, sizes_.empty() ? 0.0 : sizes_.back().second));
  }
  /// What imbalances count relative to [N], for loads of this size at a load factor: a tenth at least of the largest at
  /// the knots up to there; 0 for no loads.
  double scale(double size, double load) const {
    constexpr double least = 0.1;
    auto const next = std::upper_bound(sizes_.begin(), sizes_.end(), load,
                                       [](double at, auto const& knot) { return at < knot.first; });
    return size == 0.0 || next == sizes_.begin() ? size : std::max(size, least * (next - 1)->second);
  }

 private:
  std::vector<std::pair<double, double>> sizes_;  ///< load factor, largest up to there
};

/// Imbalance of each region that is held nowhere, as a rigid body, relative to its own dead loads: the reactions of
/// heavy ground would hide a light block that shares its nodes. Regions with a prescribed node have reactions and
/// count in the whole; a mesh of one region has no parts.
///
/// The resultant \f$ \sqrt{|\sum f|^2 + |\sum a \times f|^2 / r^2} \f$ of the unbalanced forces f over that of the
/// loads; a is the initial place of a node from the mean place of the region's nodes, r the root mean square of |a|.
/// Where loads pass through zero, a tenth of the largest that they had at a knot counts in their place.
/// The imbalance is that of all nodes of the region, since what carries it acts where it meets its neighbours; the
/// loads are those of nodes that no other region has, since the weight of a neighbour must not make them look large.
/// Sums rather than norms over the nodes: a block of concrete's own forces, 1e3 times as stiff as the ground, are
/// known to no more digits than its strains, but they have no sum; and a sum does not change with the size of the
/// elements.
template <int Dim>
class SCARP_EXPORT RegionResiduals {
 public:
  RegionResiduals(Grid<Dim> const& grid, Constraints const& constraints) {
    auto const& names = grid.regions();
    if (names.size() < 2) return;
    auto const regions_of = grid.regions_of_nodes();
    std::vector<bool> held(names.size(), false);
    for (int const dof : constraints.prescribed_dofs()) {
      if (dof < grid.dof_count())
        for (int const region : regions_of[index(dof / Dim)]) held[index(region)] = true;
    }
    for (int region = 0; region < count(names); ++region) {
      if (held[index(region)]) continue;
      Part part{.name = names[index(region)]};
      std::vector<int> shared;
      for (int node = 0; node < grid.node_count(); ++node) {
        auto const& regions = regions_of[index(node)];
        if (std::find(regions.begin(), regions.end(), region) == regions.end()) continue;
        (regions.size() == 1 ? part.nodes : shared).push_back(node);
      }
      part.own = part.nodes.size();
      part.nodes.insert(part.nodes.end(), shared.begin(), shared.end());
      if (part.nodes.empty()) continue;
      for (int const node : part.nodes) part.arms.push_back(grid.nodes()[index(node)]);
      centre(part.arms);
      parts_.push_back(std::move(part));
    }
  }

  bool empty() const { return parts_.empty(); }

  /// loads [N], shape (degrees of freedom), at a knot of their history, the next one
  void add_knot(double load, Eigen::VectorXd const& loads) {
    for (auto& part : parts_) part.past.add(load, part.resultant(loads, part.own));
  }

  /// unbalanced, loads [N], shape (degrees of freedom); load: factor
  double largest(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads, double load) const {
    double largest = 0.0;
    for (auto const& part : parts_) largest = std::max(largest, part.residual(unbalanced, loads, load));
    return largest;
  }

  void list(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads, double load,
            std::vector<PartResidual>& to) const {
    for (auto const& part : parts_) to.push_back({part.name, part.residual(unbalanced, loads, load)});
  }

 private:
  struct Part {
    std::string name;
    std::vector<int> nodes{};         ///< of its elements; none is prescribed. First those that no other region has
    std::vector<Vector<Dim>> arms{};  ///< of these nodes, over the region's radius
    std::size_t own = 0;              ///< how many no other region has
    PastLoads past{};

    /// 0 for a region without loads, such as a block before it is placed, and for one whose loads balance to round-off.
    /// A region with less than a millionth of all loads is measured by that.
    double residual(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads, double load) const {
      double const size = resultant(loads, own);
      double applied = 0.0;
      for (std::size_t k = 0; k < own; ++k) applied += loads.template segment<Dim>(Dim * nodes[k]).norm();
      constexpr double round_off = 1e-12;
      if (size <= round_off * applied) return 0.0;
      constexpr double least = 1e-6;  // of the sizes of all loads' components
      double const scale = std::max(past.scale(size, load), least * loads.template lpNorm<1>());
      return resultant(unbalanced, nodes.size()) / scale;
    }

    /// Sum and couple of the first so many nodes' forces, the latter over the region's radius.
    double resultant(Eigen::VectorXd const& forces, std::size_t first) const {
      Vector<Dim> sum = Vector<Dim>::Zero();
      Tensor<Dim> turning = Tensor<Dim>::Zero();
      for (std::size_t k = 0; k < first; ++k) {
        auto const force = forces.template segment<Dim>(Dim * nodes[k]);
        sum += force;
        turning += arms[k] * force.transpose();
      }
      // The squared length of a skew tensor is twice that of its vector.
      double const couple = (turning - turning.transpose()).squaredNorm() / 2.0;
      return std::sqrt(sum.squaredNorm() + couple);
    }
  };

  /// Makes places [m] arms from their mean, over the root mean square of their lengths.
  static void centre(std::vector<Vector<Dim>>& places) {
    Vector<Dim> mean = Vector<Dim>::Zero();
    for (auto const& place : places) mean += place / static_cast<double>(places.size());
    double squares = 0.0;
    for (auto& place : places) squares += (place -= mean).squaredNorm();
    for (auto& place : places) place /= std::sqrt(squares / static_cast<double>(places.size()));
  }

  std::vector<Part> parts_;
};

/// Imbalances of a problem's forces, see Problem::residuals.
template <int Dim>
class ForceResiduals {
 public:
  WholeResidual whole;

  /// end: first degree of freedom behind those of mesh and attached body
  ForceResiduals(Grid<Dim> const& grid, Constraints const& constraints, int end)
      : whole(WholeResidual::of(constraints, end)), first_(grid.dof_count()), end_(end), regions_(grid, constraints) {}

  bool has_regions() const { return !regions_.empty(); }

  /// How large the parts' loads are at the knots of their history.
  void learn(LoadHistory const& history) {
    if (end_ == first_ && regions_.empty()) return;
    double knot = history.next_knot(-std::numeric_limits<double>::infinity());
    for (; std::isfinite(knot); knot = history.next_knot(knot)) {
      Eigen::VectorXd const loads = history.at(knot);
      regions_.add_knot(knot, loads);
      past_.add(knot, size_beside(loads));
    }
  }

  // unbalanced, loads [N], shape (degrees of freedom); load: factor
  double largest(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads, double load) const {
    return std::max({whole.residual(unbalanced, loads), regions_.largest(unbalanced, loads, load),
                     beside(unbalanced, loads, load)});
  }
  std::vector<PartResidual> list(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads, double load,
                                 bool has_attachment) const {
    std::vector<PartResidual> parts{{"all", whole.residual(unbalanced, loads)}};
    regions_.list(unbalanced, loads, load, parts);
    if (has_attachment) parts.push_back({"attached", beside(unbalanced, loads, load)});
    return parts;
  }
  /// Residual of attached bodies over their loads; 0 without such loads.
  double beside(Eigen::VectorXd const& unbalanced, Eigen::VectorXd const& loads, double load) const {
    double free = 0.0;
    for (int const dof : whole.free_dofs) free += dof < first_ || dof >= end_ ? 0.0 : unbalanced(dof) * unbalanced(dof);
    double const scale = past_.scale(size_beside(loads), load);
    return free == 0.0 || scale == 0.0 ? 0.0 : std::sqrt(free) / scale;
  }

 private:
  double size_beside(Eigen::VectorXd const& loads) const { return loads.segment(first_, end_ - first_).norm(); }

  int first_;  ///< degree of freedom of attached bodies
  int end_;
  PastLoads past_{};  ///< of attached bodies
  RegionResiduals<Dim> regions_;
};

}  // namespace scarp::detail
