// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "scarp/bvp/attachment.hpp"
#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/grid.hpp"
#include "scarp/bvp/load_history.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/io/state_bits.hpp"

SCARP_NAMED_MEMBER(time_error)
SCARP_NAMED_MEMBER(limit)
SCARP_NAMED_MEMBER(grid)

namespace scarp {

/// Values at all nodes of a mesh under a name, for files.
struct NodalField {
  std::string name;            ///< in files
  std::vector<double> values;  ///< shape (nodes)
};

/// Estimated error in time of one step of a field, in the field's unit.
struct FieldTimeError {
  double estimate = 0.0;            ///< largest of all values
  std::optional<double> allowed{};  ///< without it none is too large
  double size = 0.0;                ///< largest value of the committed field

  double over_allowed() const { return allowed ? estimate / *allowed : 0.0; }  ///< at most 1 where a step is accepted
};

/// An `Attachment` whose degrees of freedom are a field over the mesh, such as the pressure of pore water, and no body:
/// they are solved together with the displacements, and what is known of them belongs to the field itself. They are the
/// last ones of the problem. is_field: true; at(load): from now on forces belong to a step that ends at this load
/// factor; next_knot(load): first load factor beyond one where the field's own courses may turn; name(): of its
/// residual; residual(unbalanced): imbalance of its own equations, relative to its own measure, shape (extra_dofs);
/// describe(number): a degree of freedom in words; nodal_fields() and ground_force(), what it does to the mesh [N],
/// shape (dof_count of the mesh): committed; time_error(), where it has one: `FieldTimeError` of the step whose
/// forces were requested last; grid(), where it has one: that it was made of, which must be the problem's;
/// limit(last, next), where its equations have kinks: moves an iterate back to a kink that a linear step from the
/// last one has passed without seeing it, both increments of shape (degrees of freedom of the problem).
template <class Part>
concept FieldAttachment = Part::is_field &&
    requires(Part& part, Part const& constant, Eigen::VectorXd const& unbalanced) {
  {part.at(0.0)};
  { constant.next_knot(0.0) } -> std::same_as<double>;
  { constant.name() } -> std::convertible_to<std::string>;
  { constant.residual(unbalanced) } -> std::same_as<double>;
  { constant.describe(0) } -> std::convertible_to<std::string>;
  { constant.nodal_fields() } -> std::same_as<std::vector<NodalField>>;
  { constant.ground_force() } -> std::same_as<Eigen::VectorXd>;
};

namespace detail {

template <class Part>
concept NamesField = requires {
  Part::is_field;
};

/// A `FieldAttachment` of any type.
template <int Dim>
class AttachedField : public Attached<Dim> {
 public:
  virtual void at(double load) = 0;
  virtual double next_knot(double load) const = 0;
  virtual FieldTimeError time_error() const = 0;  ///< 0 for what estimates none
  virtual std::string name() const = 0;
  virtual double residual(Eigen::VectorXd const& unbalanced) const = 0;
  virtual std::string describe(int number) const = 0;
  virtual std::vector<NodalField> nodal_fields() const = 0;
  virtual Eigen::VectorXd ground_force() const = 0;
  virtual void limit(Eigen::VectorXd const& last, Eigen::VectorXd& next) const = 0;  ///< Nothing where it has no kink.
  virtual Grid<Dim> const* grid() const = 0;  ///< that it was made of; null for what names none

  /// first: its first degree of freedom
  /// \throws InputError for constraints and loads of its degrees of freedom
  void require_free(Constraints const& constraints, LoadHistory const& loads, int first) const {
    if (loads.act_from(first))
      reject("a load acts on a degree of freedom of {} (the field knows what flows into it): give it there", name());
    for (int number = 0; number < this->extra_dofs(); ++number) {
      if (constraints.is_prescribed(first + number))
        reject("{} is prescribed by a constraint (the field knows its own boundaries): give it there",
               describe(number));
    }
  }
};

template <int Dim, class Part>
class AttachedFieldOf final : public AttachedAs<AttachedField<Dim>, Part> {
  static_assert(Attachment<Part, Dim> && FieldAttachment<Part>,
                "scarp: an attachment that is a field needs extra_dofs(), add_forces(), add_stiffness() and commit(), "
                "at(), next_knot(), name(), residual(), describe(), nodal_fields() and ground_force()");
  static constexpr bool has_time_error = requires(Part const& part) { part.time_error(); };
  static_assert(has_time_error || !names_time_error<Part>,
                "scarp: time_error of a field is never called: it needs `FieldTimeError time_error() const`");
  static constexpr bool has_limit = requires(Part const& part, Eigen::VectorXd& next) { part.limit(next, next); };
  static_assert(has_limit || !names_limit<Part>,
                "scarp: limit of a field is never called: it needs "
                "`void limit(Eigen::VectorXd const& last, Eigen::VectorXd& next) const`");
  static constexpr bool has_grid = requires(Part const& part) { part.grid(); };
  static_assert(has_grid || !names_grid<Part>,
                "scarp: grid of a field is never called: it needs `Grid<Dim> const& grid() const`");
  using Base = AttachedAs<AttachedField<Dim>, Part>;
  using Base::part_;

 public:
  using Base::Base;

  void at(double load) override { part_.at(load); }
  double next_knot(double load) const override { return part_.next_knot(load); }
  FieldTimeError time_error() const override {
    if constexpr (has_time_error) return part_.time_error();
    return {};
  }
  std::string name() const override { return part_.name(); }
  double residual(Eigen::VectorXd const& unbalanced) const override { return part_.residual(unbalanced); }
  std::string describe(int number) const override { return part_.describe(number); }
  std::vector<NodalField> nodal_fields() const override { return part_.nodal_fields(); }
  Eigen::VectorXd ground_force() const override { return part_.ground_force(); }
  void limit(Eigen::VectorXd const& last, Eigen::VectorXd& next) const override {
    if constexpr (has_limit) part_.limit(last, next);
  }
  Grid<Dim> const* grid() const override {
    if constexpr (has_grid) return &part_.grid();
    return nullptr;
  }
};

/// What is attached to a mesh: at most one body or load, and at most one field.
template <int Dim>
struct Attachments {
  std::unique_ptr<AttachedPart<Dim>> part{};
  std::unique_ptr<AttachedField<Dim>> field{};

  int part_dofs() const { return part ? part->extra_dofs() : 0; }
  int field_dofs() const { return field ? field->extra_dofs() : 0; }
  std::optional<double> length() const { return part ? part->length() : std::nullopt; }
  /// First load factor beyond one where the field's courses may turn.
  double next_knot(double load) const {
    return field ? field->next_knot(load) : std::numeric_limits<double>::infinity();
  }
  /// unbalanced: shape (degrees of freedom of the problem); 0 without a field
  double field_residual(Eigen::VectorXd const& unbalanced) const {
    return field ? field->residual(unbalanced.tail(field->extra_dofs())) : 0.0;
  }

  /// \throws InputError for another thickness than the mesh's, a field of another grid, and constraints and loads of
  /// its degrees of freedom
  void require_fit(Grid<Dim> const& grid, Constraints const& constraints, LoadHistory const& loads) const {
    if (part) require_thickness(grid, part->thickness());
    if (!field) return;
    require_thickness(grid, field->thickness());
    auto const* const own = field->grid();
    if (own && (typeid(*own) != typeid(grid) || own->nodes() != grid.nodes() ||
                (grid.turns_stresses() && own->positions() != grid.positions())))
      reject(
          "the field is of other elements or another mesh than the problem, or of other positions ({} and {} nodes): "
          "make it of the same grid",
          own->node_count(), grid.node_count());
    field->require_free(constraints, loads, grid.dof_count() + part_dofs());
  }
  Verdict add_forces(std::vector<Vector<Dim>> const& nodes, Eigen::VectorXd const& increment, Eigen::VectorXd& forces) {
    Verdict const of_part = part ? part->add_forces(nodes, increment, forces) : Verdict{};
    Verdict const of_field = field ? field->add_forces(nodes, increment, forces) : Verdict{};
    return of_part.acceptable() ? of_field : of_part;
  }
  // Derivative of the forces that were requested last, shape (size, size) [N/m].
  Eigen::SparseMatrix<double> part_stiffness(int size) const {
    return assembled(part.get(), &AttachedPart<Dim>::add_stiffness, size);
  }
  Eigen::SparseMatrix<double> stick_stiffness(int size) const {
    return assembled(part.get(), &AttachedPart<Dim>::add_stick_stiffness, size);
  }
  Eigen::SparseMatrix<double> field_stiffness(int size) const {
    return assembled(field.get(), &AttachedField<Dim>::add_stiffness, size);
  }
  void commit(std::vector<Vector<Dim>> const& nodes, Eigen::VectorXd const& increment) {
    if (part) {  // with the trial state of the increment, whatever was requested last
      Eigen::VectorXd unused = Eigen::VectorXd::Zero(increment.size());
      static_cast<void>(part->add_forces(nodes, increment, unused));
      part->commit(nodes, increment);
    }
    if (field) field->commit(nodes, increment);
  }
  /// \throws InputError for one that cannot be saved
  void write(StateWriter& writer) const {
    if (part) part->write(writer);
    if (field) field->write(writer);
  }
  template <class Self, class Visit>
  static void members(Self& self, Visit& visit) {
    if constexpr (std::same_as<std::remove_cvref_t<Visit>, StateWriter>) {
      self.write(visit);
    } else if constexpr (std::same_as<std::remove_cvref_t<Visit>, StateReader>) {
      if (self.part) self.part->read(visit);
      if (self.field) self.field->read(visit);
    }
  }

  /// The attachment of this type; a null pointer if there is none.
  template <class Part>
  Part const* find() const {
    if constexpr (NamesField<Part>) {
      auto const* found = dynamic_cast<AttachedFieldOf<Dim, Part> const*>(field.get());
      return found ? &found->part() : nullptr;
    } else {
      auto const* found = dynamic_cast<AttachedPartOf<Dim, Part> const*>(part.get());
      return found ? &found->part() : nullptr;
    }
  }
  /// \throws InputError for a second one of a kind
  template <class Part>
  void add(Part attached) {
    if constexpr (std::same_as<Part, NoAttachment>) {
      return;
    } else if constexpr (NamesField<Part>) {
      if (field) reject("a second field is attached to the mesh (it can have one): leave one out");
      field = std::make_unique<AttachedFieldOf<Dim, Part>>(std::move(attached));
    } else {
      if (part) reject("a second body or load is attached to the mesh (it can have one): leave one out");
      part = std::make_unique<AttachedPartOf<Dim, Part>>(std::move(attached));
    }
  }
};

}  // namespace detail

}  // namespace scarp
