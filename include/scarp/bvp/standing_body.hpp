// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "scarp/bvp/facet_chain.hpp"
#include "scarp/bvp/rigid_body.hpp"
#include "scarp/core/described.hpp"

namespace scarp {

/// Points of a base on the ground below it: two Gauss points between all neighbouring nodes of either side, so that
/// every product of a linear pressure and a linear shape function is integrated exactly while the two stay opposite
/// each other (the contact patch test).
struct BasePoint {
  double along = 0.0;   ///< 0 to 1 over the part of the base that was requested
  double weight = 0.0;  ///< share of that part
};

/// from, to [m]: ends of the base along a straight line; breaks [m]: places of nodes along it, any order, also outside
inline std::vector<BasePoint> base_points(double from, double to, std::vector<double> breaks) {
  std::erase_if(breaks, [&](double place) { return !(place > from && place < to); });
  breaks.push_back(from);
  breaks.push_back(to);
  std::sort(breaks.begin(), breaks.end());
  std::vector<BasePoint> points;
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    double const length = breaks[k] - breaks[k - 1];
    if (length <= 1e-9 * (to - from)) continue;  // the same place on both sides
    for (double const gauss : {-1.0, 1.0}) {
      double const place = (breaks[k] + breaks[k - 1] + gauss * length / std::sqrt(3.0)) / 2.0;
      points.push_back({(place - from) / (to - from), 0.5 * length / (to - from)});
    }
  }
  return points;
}

/// A rigid body that stands with a flat base on a mesh's outline.
class RigidFooting {
 public:
  /// body: at its start; left, right [m]: ends of the base; breaks [m]: places of the ground's nodes along x
  /// dofs_before: degrees of freedom of the mesh's nodes
  /// \throws InputError for a base that does not go from left to right, or a thickness that is not positive
  RigidFooting(RigidBody body, Vector<2> const& left, Vector<2> const& right, std::vector<double> const& breaks,
               double thickness, int dofs_before)
      : body_(std::move(body)),
        first_(dofs_before),
        base_((right - left).normalized()),
        length_((right - left).norm()),
        thickness_(require_positive("thickness", thickness)) {
    if (!(left.allFinite() && right.allFinite() && left.x() < right.x())) {
      reject(
          "the base of a footing goes from ({} m, {} m) to ({} m, {} m) (it must go from left to right): give its ends "
          "in this order",
          left.x(), left.y(), right.x(), right.y());
    }
    for (auto const& point : base_points(left.x(), right.x(), breaks)) {
      own_.push_back(left + point.along * (right - left) - body_.reference());
      area_.push_back(point.weight * length_ * thickness);
    }
  }

  RigidBody const& body() const { return body_; }  ///< committed place and rotation

  double length() const { return length_; }        ///< width of the base [m]
  double thickness() const { return thickness_; }  ///< out of the plane [m]
  int first_dof() const { return first_; }         ///< first degree of freedom of the body
  static int extra_dofs() { return RigidBody::extra_dofs; }
  std::size_t point_count() const { return own_.size(); }
  double area(std::size_t k) const { return area_[k]; }
  Vector<2> place(std::size_t k, std::vector<Vector<2>> const&) const { return body_.place(own_[k]); }
  Vector<2> place(std::size_t k, std::vector<Vector<2>> const&, Eigen::VectorXd const& increment) const {
    return body_.place(own_[k], increment, first_);
  }
  Vector<2> along(std::size_t, std::vector<Vector<2>> const&, Eigen::VectorXd const& increment) const {
    return body_.turned(base_, increment, first_);
  }
  std::array<DofJacobian, RigidBody::jacobians> jacobians_at(std::size_t k, std::vector<Vector<2>> const&,
                                                             Eigen::VectorXd const& increment) const {
    return body_.jacobians_at(own_[k], increment, first_);
  }
  void commit(std::vector<Vector<2>> const&, Eigen::VectorXd const& increment) { body_.commit(increment, first_); }

  SCARP_MEMBERS_EXCEPT((first_, base_, length_, thickness_, own_, area_), body_)

 private:
  RigidBody body_;
  int first_;
  Vector<2> base_;
  double length_;
  double thickness_;
  std::vector<Vector<2>> own_;
  std::vector<double> area_;
};

/// A body of the same mesh that stands with one of its boundaries on another part of the outline.
class MeshedFooting {
 public:
  /// base: facets of the standing body with the body on their left; breaks [m]: places of the ground's nodes along x
  /// \throws InputError for an empty base, facets of nodes that are not there or upright, or a thickness that is not
  /// positive
  MeshedFooting(FacetChain base, std::vector<double> const& breaks, std::vector<Vector<2>> const& nodes,
                double thickness)
      : base_(std::move(base)), thickness_(require_positive("thickness", thickness)) {
    detail::require_nodes("the base of a footing", base_.facets(), nodes.size());
    for (int f = 0; f < detail::count(base_.facets()); ++f) {
      Vector<2> const from = base_.place({f, 0.0}, nodes);
      Vector<2> const to = base_.place({f, 1.0}, nodes);
      if (std::abs(to.x() - from.x()) <= 1e-9 * (to - from).norm())
        reject(
            "the base of a footing has an upright facet at ({} m, {} m) (the ground below it is looked for): leave it "
            "out",
            from.x(), from.y());
      bool const rightward = to.x() > from.x();
      for (auto const& point : base_points(std::min(from.x(), to.x()), std::max(from.x(), to.x()), breaks)) {
        at_.push_back({f, rightward ? point.along : 1.0 - point.along});
        area_.push_back(point.weight * (to - from).norm() * thickness);
      }
    }
  }

  double thickness() const { return thickness_; }  ///< out of the plane [m]
  static int extra_dofs() { return 0; }
  std::size_t point_count() const { return at_.size(); }
  double area(std::size_t k) const { return area_[k]; }
  Vector<2> place(std::size_t k, std::vector<Vector<2>> const& nodes) const { return base_.place(at_[k], nodes); }
  Vector<2> place(std::size_t k, std::vector<Vector<2>> const& nodes, Eigen::VectorXd const& increment) const {
    Vector<2> moved = place(k, nodes);
    for (auto const& lever : jacobians_at(k, nodes, increment)) moved += lever.direction * increment(lever.dof);
    return moved;
  }
  Vector<2> along(std::size_t k, std::vector<Vector<2>> const& nodes, Eigen::VectorXd const& increment) const {
    auto const& [a, b] = base_.facets()[detail::index(at_[k].facet)];
    Vector<2> const side = base_.place({at_[k].facet, 1.0}, nodes) - base_.place({at_[k].facet, 0.0}, nodes);
    return (side + increment.segment<2>(2 * b) - increment.segment<2>(2 * a)).normalized();
  }
  std::array<DofJacobian, 4> jacobians_at(std::size_t k, std::vector<Vector<2>> const&, Eigen::VectorXd const&) const {
    auto const& [a, b] = base_.facets()[detail::index(at_[k].facet)];
    double const xi = at_[k].xi;
    return {{{2 * a, (1.0 - xi) * Vector<2>::UnitX()},
             {2 * a + 1, (1.0 - xi) * Vector<2>::UnitY()},
             {2 * b, xi * Vector<2>::UnitX()},
             {2 * b + 1, xi * Vector<2>::UnitY()}}};
  }
  static void commit(std::vector<Vector<2>> const&, Eigen::VectorXd const&) {}

  /// Nothing: it moves with the mesh.
  SCARP_MEMBERS_EXCEPT((base_, thickness_, at_, area_))

 private:
  FacetChain base_;
  double thickness_;
  std::vector<FacetChain::ClosestPoint> at_;
  std::vector<double> area_;
};

}  // namespace scarp
