// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scarp/bvp/attachment.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"

namespace scarp {

/// A field over a mesh and a load that follows the nodes of the mesh, as the one attachment of a problem: pore water in
/// a specimen below a `FollowingPressure`. All degrees of freedom are the field's.
/// \code
/// FieldWithLoad both(grid, FollowingPressure<Line3>(sides, 100e3), water);
/// auto problem = make_problem(grid, ..., both);
/// auto const& solved = problem.attached<decltype(both)>().field();
/// \endcode
/// \tparam Load an `Attachment` without degrees of freedom of its own, which nothing slides on
/// \tparam Field with the dimension `dim` of its mesh
template <class Load, FieldAttachment Field>
class FieldWithLoad {
  using Values = Eigen::VectorXd;
  using Entries = std::vector<Eigen::Triplet<double>>;
  static_assert(
      Attachment<Load, Field::dim> &&
          !requires(Load const& load, Entries& entries) { load.add_stick_stiffness(entries); },
      "scarp: beside a field stands a load whose forces follow the nodes, not a contact that opens or slides, which is "
      "followed "
      "where the ground alone is linearised");

 public:
  static constexpr int dim = Field::dim;   ///< of the mesh
  static constexpr bool is_field = true;   ///< see FieldAttachment
  using Nodes = std::vector<Vector<dim>>;  ///< places [m]

  /// grid: that of the problem, before its first step
  /// \throws InputError for a load with degrees of freedom of its own, or of another thickness than the mesh's
  FieldWithLoad(Grid<dim> const& grid, Load load, Field field) : load_(std::move(load)), field_(std::move(field)) {
    if (load_.extra_dofs() != 0)
      reject(
          "a load beside a field has {} degrees of freedom of its own (a field is solved with the ground, a body is "
          "followed by itself): attach one of the two",
          load_.extra_dofs());
    detail::AttachedPartOf<dim, Load>(load_).require_fit(grid, Constraints(grid));
    remember(grid.positions(), Values::Zero(grid.dof_count()));
  }

  Load const& load() const { return load_; }     ///< Committed.
  Field const& field() const { return field_; }  ///< Committed.

  // What an attachment needs.
  int extra_dofs() const { return field_.extra_dofs(); }
  double thickness() const requires requires(Field const& field) { field.thickness(); }
  { return field_.thickness(); }  ///< of the field's mesh [m]
  Verdict add_forces(Nodes const& nodes, Values const& increment, Values& forces) {
    Verdict const of_load = load_.add_forces(nodes, increment, forces);
    Verdict const of_field = field_.add_forces(nodes, increment, forces);
    return of_load.acceptable() ? of_field : of_load;
  }
  void add_stiffness(Entries& entries) const {
    load_.add_stiffness(entries);
    field_.add_stiffness(entries);
  }
  void commit(Nodes const& nodes, Values const& increment) {
    remember(nodes, increment);
    load_.commit(nodes, increment);
    field_.commit(nodes, increment);
  }

  // What a field needs.
  void at(double load) { field_.at(load); }
  double next_knot(double load) const { return field_.next_knot(load); }
  double time_error() const requires requires(Field const& field) { field.time_error(); }
  { return field_.time_error(); }  ///< of the field's last step, over what is allowed
  std::string name() const { return field_.name(); }
  /// Of the field's own equations, relative to its own measure.
  double residual(Values const& unbalanced) const { return field_.residual(unbalanced); }
  std::string describe(int number) const { return field_.describe(number); }
  std::vector<NodalField> nodal_fields() const { return field_.nodal_fields(); }
  /// Committed force [N] of load and field on the nodes of the mesh.
  Values ground_force() const {
    return field_.ground_force() + Eigen::Map<Values const>(of_load_.data(), detail::count(of_load_));
  }

  SCARP_MEMBERS(load_, field_, of_load_)

 private:
  /// Keeps the load's forces at an increment, since ground_force() has no places of nodes.
  void remember(Nodes const& nodes, Values const& increment) {
    Values forces = Values::Zero(increment.size());
    static_cast<void>(load_.add_forces(nodes, increment, forces));
    of_load_.assign(forces.data(), forces.data() + dim * nodes.size());
  }

  Load load_;
  Field field_;
  std::vector<double> of_load_;  ///< on the nodes of the mesh, committed [N]
};

}  // namespace scarp
