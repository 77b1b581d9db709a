// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <optional>
#include <span>

#include "scarp/bvp/attachment.hpp"
#include "scarp/bvp/facet_chain.hpp"
#include "scarp/bvp/rigid_body.hpp"
#include "scarp/contact/contact_law.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/named_member.hpp"

SCARP_NAMED_MEMBER(first_dof)

namespace scarp {

/// The body that stands on a mesh's outline: how its places move. place(k): committed; place(k, nodes, increment):
/// after an increment; along(k, ...): unit vector along its base there, body on the left; jacobians_at(k, ...): what
/// moves it. Its own degrees of freedom begin where those of the mesh's nodes end.
template <class Body>
concept StandsOnMesh = requires(Body& body, Body const& constant, std::size_t k, std::vector<Vector<2>> const& nodes,
                                Eigen::VectorXd const& increment) {
  { constant.extra_dofs() } -> std::same_as<int>;
  { constant.point_count() } -> std::same_as<std::size_t>;
  { constant.area(k) } -> std::same_as<double>;
  { constant.place(k, nodes) } -> std::same_as<Vector<2>>;
  { constant.place(k, nodes, increment) } -> std::same_as<Vector<2>>;
  { constant.along(k, nodes, increment) } -> std::same_as<Vector<2>>;
  {constant.jacobians_at(k, nodes, increment)};
  {body.commit(nodes, increment)};
};

/// Kinematics and stress of one point of an interface.
struct InterfacePoint {
  Vector<2> place = Vector<2>::Zero();   ///< of the standing body [m]
  double area = 0.0;                     ///< [m2]
  Vector<2> stress = Vector<2>::Zero();  ///< of the ground on the standing body [Pa]
  double pressure = 0.0;                 ///< [Pa], positive pushes apart
  double shear = 0.0;                    ///< [Pa], on the standing body, along its base, ground on the left
  double gap = 0.0;                      ///< [m], negative: overlap
};

/// Contact between the outline of a mesh and a body that stands on it, in the plane: a contact law, in stresses over
/// displacements [Pa/m] where grains have forces, at fixed points of the standing body against the facet opposite to
/// them. Areas and directions are the body's: the force of a uniform pressure is exact, and a point that slides over a
/// kink of the ground changes its force continuously.
template <CheckedContactLaw Law, StandsOnMesh Body>
class Interface {
  static_assert(
      !Law::inputs.moment && !Law::inputs.radius && !Law::inputs.motion && Law::inputs.species == 0,
      "an interface has neither rolling nor radii nor dashpots nor species: use a law of springs and sliders");
  static constexpr bool has_first_dof = requires(Body const& body) {
    { body.first_dof() } -> std::same_as<int>;
  };
  static_assert(has_first_dof || !detail::names_first_dof<Body>,
                "scarp: first_dof of a body is never called: it needs `int first_dof() const`");
  static constexpr bool has_thickness = requires(Body const& body) {
    { body.thickness() } -> std::convertible_to<double>;
  };
  static_assert(has_thickness || !detail::names_thickness<Body>,
                "scarp: thickness of a body is never called: it needs `double thickness() const` [m]");
  static constexpr bool has_length = requires(Body const& body) {
    { body.length() } -> std::convertible_to<double>;
  };
  static_assert(has_length || !detail::names_length<Body>,
                "scarp: length of a body is never called: it needs `double length() const` [m]");

 public:
  using Memory = ContactMemory<2, double>;  ///< shear [Pa] and further numbers of the law at one point

  /// nodes [m]: committed places. Laws with bonds begin intact at every point.
  /// \throws InputError for facets of nodes that are not there, a body whose degrees of freedom do not follow those of
  /// the nodes, stiffnesses or a friction below 0, and a law without normal stiffness
  Interface(Law law, Body body, FacetChain ground, std::vector<Vector<2>> const& nodes)
      : law_(std::move(law)), body_(std::move(body)), ground_(std::move(ground)) {
    detail::require_nodes("the ground of an interface", ground_.facets(), nodes.size());
    constexpr double slight = 1e-6;  // overlap [m], for laws that have no stiffness in mere touch
    auto const springs = law_.stiffness(slight, 0.0);
    require_positive("normal stiffness of an interface [Pa/m]", springs.normal);
    require_not_negative("tangential stiffness of an interface [Pa/m]", springs.tangential);
    for_each_friction(law_, [](double friction) { require_not_negative("friction of an interface", friction); });
    if constexpr (has_first_dof) {
      if (body_.first_dof() != 2 * detail::count(nodes))
        reject("the body's degrees of freedom begin at {} (those of {} nodes end before {}): give that as dofs_before",
               body_.first_dof(), nodes.size(), 2 * nodes.size());
    }
    committed_.resize(body_.point_count());
    for (std::size_t k = 0; k < committed_.size(); ++k) {
      committed_[k].place = body_.place(k, nodes);
      committed_[k].foot = ground_.nearest(committed_[k].place, nodes);
      if constexpr (Bonds<Law>) Law::bond(committed_[k].memory);
    }
    trial_ = committed_;
    couplings_.resize(trial_.size());
  }

  Law const& law() const { return law_; }     ///< stresses [Pa] of relative displacements [m]
  Body const& body() const { return body_; }  ///< the body that stands on the ground, in its committed place
  int extra_dofs() const { return body_.extra_dofs(); }
  /// Out of the plane, where the body has one [m].
  std::optional<double> thickness() const {
    if constexpr (has_thickness) return body_.thickness();
    return std::nullopt;
  }
  /// Length of the body, where it has one [m].
  std::optional<double> length() const {
    if constexpr (has_length) return body_.length();
    return std::nullopt;
  }

  Verdict add_forces(std::vector<Vector<2>> const& nodes, Eigen::VectorXd const& increment, Eigen::VectorXd& forces) {
    auto moved = nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) moved[n] += increment.segment<2>(static_cast<Eigen::Index>(2 * n));
    for (std::size_t k = 0; k < trial_.size(); ++k) {
      update(k, nodes, moved, increment);
      Vector<2> const force = body_.area(k) * stress_vector(trial_[k]);
      for (auto const& lever : couplings_[k]) forces(lever.dof) -= lever.direction.dot(force);
    }
    return {};
  }

  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
    add_stiffness(entries, [&](State const& state) { return state.stiffness; });
  }

  /// Appends the stiffness [N/m] as if nothing slid: that of the closed contact where there is pressure or stiffness,
  /// else zero.
  void add_stick_stiffness(std::vector<Eigen::Triplet<double>>& entries) const {
    add_stiffness(entries, [&](State const& state) {
      bool const touches = state.pressure != 0.0 || state.stiffness != Tensor<2>::Zero();
      return touches ? closed_stiffness(state) : Tensor<2>(Tensor<2>::Zero());
    });
  }

  void commit(std::vector<Vector<2>> const& nodes, Eigen::VectorXd const& increment) {
    body_.commit(nodes, increment);
    committed_ = trial_;
  }

  /// The committed state, point by point.
  std::vector<InterfacePoint> points() const {
    std::vector<InterfacePoint> all;
    for (std::size_t k = 0; k < committed_.size(); ++k) {
      State const& state = committed_[k];
      all.push_back({state.place, body_.area(k), stress_vector(state), state.pressure, state.shear, -state.overlap});
    }
    return all;
  }

  /// What evolves: the committed state of body and points.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    SCARP_ALL_MEMBERS(law_, body_, ground_, committed_, trial_, couplings_);
    visit("body", self.body_);
    visit("points", std::span(self.committed_));
  }
  /// Trial states begin as the committed ones that were read.
  void after_loading() { trial_ = committed_; }

 private:
  struct State {
    FacetChain::ClosestPoint foot{};
    Memory memory{};
    Vector<2> place = Vector<2>::Zero();
    Vector<2> along = Vector<2>::UnitX();
    double overlap = 0.0;
    double pressure = 0.0;
    double shear = 0.0;
    Tensor<2> stiffness = Tensor<2>::Zero();  ///< of the stress on the body against its relative motion [Pa/m]

    SCARP_MEMBERS(foot, memory, place, along, overlap, pressure, shear, stiffness)
  };

  /// Out of the ground, which is on the left of its outline.
  static Vector<2> outward(Vector<2> const& along) { return {along.y(), -along.x()}; }
  static Vector<2> stress_vector(State const& state) {
    return state.pressure * outward(state.along) + state.shear * state.along;
  }

  ContactForce<2, double> response(double overlap, double slip, Memory& memory) const {
    ContactKinematics<2, double> approach{.overlap = overlap, .slip_increment = slip};
    return law_.respond(approach, memory);
  }

  template <class StiffnessOf>
  void add_stiffness(std::vector<Eigen::Triplet<double>>& entries, StiffnessOf const& of) const {
    for (std::size_t k = 0; k < trial_.size(); ++k) {
      Tensor<2> const stiffness = body_.area(k) * of(trial_[k]);
      for (auto const& row : couplings_[k]) {
        for (auto const& column : couplings_[k])
          entries.emplace_back(row.dof, column.dof, row.direction.dot(stiffness * column.direction));
      }
    }
  }

  Tensor<2> closed_stiffness(State const& state) const {
    auto const closed = law_.stiffness(std::max(state.overlap, 0.0), 0.0);
    Vector<2> const normal = outward(state.along);
    return closed.normal * normal * normal.transpose() + closed.tangential * state.along * state.along.transpose();
  }

  /// Finds the closest place of a point, evaluates the law, and stores the derivative by forward differences: laws of
  /// springs and sliders are piecewise linear, and the closing side is the one that matters at a point that just
  /// touches.
  void update(std::size_t k, std::vector<Vector<2>> const& nodes, std::vector<Vector<2>> const& moved,
              Eigen::VectorXd const& increment) {
    State const& before = committed_[k];
    State& state = trial_[k];
    state = before;
    state.place = body_.place(k, nodes, increment);
    state.along = -body_.along(k, nodes, increment);
    Vector<2> const normal = outward(state.along);
    state.foot = ground_.project_along(state.place, normal, moved);
    Vector<2> const apart = state.place - ground_.place(state.foot, moved);
    state.overlap = state.foot.at_end ? -apart.norm() : -apart.dot(normal);
    Vector<2> const relative =
        state.place - body_.place(k, nodes) - ground_.place(before.foot, moved) + ground_.place(before.foot, nodes);
    double const slip = relative.dot(state.along);
    auto const force = response(state.overlap, slip, state.memory);
    state.pressure = force.normal;
    state.shear = force.shear;

    double const step = 1e-9 * facet_length(state.foot.facet, moved);
    if (force.normal == 0.0 && std::abs(state.overlap) < step) {
      // Just touching: a body without weight is held by the closed contact's springs or by nothing.
      state.stiffness = closed_stiffness(state);
    } else {
      Memory closing = before.memory;
      Memory sliding = before.memory;
      auto const closer = response(state.overlap + step, slip, closing);
      auto const further = response(state.overlap, slip + step, sliding);
      Tensor<2> derivative;  // of (pressure, shear) with respect to the motion along (normal, tangent)
      derivative << force.normal - closer.normal, further.normal - force.normal,  //
          force.shear - closer.shear, further.shear - force.shear;
      derivative /= step;
      if (!state.foot.at_end) {
        // Along a facet that is not parallel to the base the gap changes too.
        Vector<2> const facing = outward(ground_.along(state.foot.facet, moved));
        derivative.col(1) += facing.dot(state.along) / facing.dot(normal) * derivative.col(0);
      }
      Tensor<2> frame;
      frame << normal, state.along;
      state.stiffness = -frame * derivative * frame.transpose();
    }
    couple(k, nodes, increment);
  }

  double facet_length(int facet, std::vector<Vector<2>> const& nodes) const {
    return (ground_.place({facet, 1.0}, nodes) - ground_.place({facet, 0.0}, nodes)).norm();
  }

  /// Degrees of freedom that move a point relative to its foot.
  void couple(std::size_t k, std::vector<Vector<2>> const& nodes, Eigen::VectorXd const& increment) {
    auto& jacobians = couplings_[k];
    jacobians.clear();
    for (auto const& lever : body_.jacobians_at(k, nodes, increment)) jacobians.push_back(lever);
    auto const& foot = trial_[k].foot;
    auto const& facet = ground_.facets()[detail::index(foot.facet)];
    for (int axis = 0; axis < 2; ++axis) {
      jacobians.push_back({2 * facet[0] + axis, -(1.0 - foot.xi) * Vector<2>::Unit(axis)});
      jacobians.push_back({2 * facet[1] + axis, -foot.xi * Vector<2>::Unit(axis)});
    }
  }

  Law law_;
  Body body_;
  FacetChain ground_;
  std::vector<State> committed_;
  std::vector<State> trial_;
  std::vector<std::vector<DofJacobian>> couplings_;
};

}  // namespace scarp
