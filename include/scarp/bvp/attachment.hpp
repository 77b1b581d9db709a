// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <concepts>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/bvp/grid.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/core/status.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/tensor/tensor.hpp"

SCARP_NAMED_MEMBER(add_stick_stiffness)
SCARP_NAMED_MEMBER(length)
SCARP_NAMED_MEMBER(thickness)

namespace scarp {

/// What acts on the nodes of a mesh in addition to its elements: contact with another body, springs, the other body
/// itself with degrees of freedom of its own, which follow those of the mesh. Committed and trial states as for
/// materials:
/// add_forces(nodes, increment, forces): adds the internal forces [N] at an increment from the committed state, given
/// the committed positions of the nodes [m]; add_stiffness(entries): their derivative at the last requested increment;
/// commit(nodes, increment): makes that state the committed one, before the nodes move; thickness(), where it has one,
/// is compared with the mesh's; length() [m], where it has one, is the size of a body with degrees of freedom of its
/// own, which its motions are measured by. What can slide also has
/// add_stick_stiffness(entries): the stiffness as if nothing slid, positive where bodies touch.
template <class Part, int Dim>
concept Attachment = requires(Part& part, Part const& constant, std::vector<Vector<Dim>> const& nodes,
                              Eigen::VectorXd const& increment, Eigen::VectorXd& forces,
                              std::vector<Eigen::Triplet<double>>& entries) {
  { constant.extra_dofs() } -> std::same_as<int>;
  { part.add_forces(nodes, increment, forces) } -> std::same_as<Verdict>;
  {constant.add_stiffness(entries)};
  {part.commit(nodes, increment)};
};

/// Nothing: the elements alone.
struct NoAttachment {};

namespace detail {

/// What attachments of any type have in common.
template <int Dim>
class Attached {
 public:
  using Nodes = std::vector<Vector<Dim>>;
  using Entries = std::vector<Eigen::Triplet<double>>;

  virtual ~Attached() = default;
  virtual int extra_dofs() const = 0;
  virtual Verdict add_forces(Nodes const& nodes, Eigen::VectorXd const& increment, Eigen::VectorXd& forces) = 0;
  virtual void add_stiffness(Entries& entries) const = 0;
  virtual void commit(Nodes const& nodes, Eigen::VectorXd const& increment) = 0;
  virtual std::optional<double> thickness() const = 0;
  virtual void write(StateWriter& writer) const = 0;
  virtual void read(StateReader& reader) = 0;
};

/// A body or load of any type.
template <int Dim>
class AttachedPart : public Attached<Dim> {
 public:
  using typename Attached<Dim>::Entries;

  virtual void add_stick_stiffness(Entries& entries) const = 0;
  virtual std::optional<double> length() const = 0;
};

/// \throws InputError for another thickness [m] than the mesh's
template <int Dim>
void require_thickness(Grid<Dim> const& grid, std::optional<double> own) {
  if (own && *own != grid.thickness())
    reject("what is attached to the mesh is {} m thick out of the plane (the mesh is {} m): give both the same", *own,
           grid.thickness());
}

/// A stiffness [N/m] of what is attached, zero without it, shape (size, size).
template <class Part, class Class>
Eigen::SparseMatrix<double> assembled(Part const* part, void (Class::*add)(std::vector<Eigen::Triplet<double>>&) const,
                                      int size) {
  std::vector<Eigen::Triplet<double>> entries;
  if (part) (part->*add)(entries);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Saves or loads what is attached. \throws InputError for one that names no members
template <class Visit, class Part>
void visit_attached(Visit& visit, Part& part) {
  if constexpr (Described<std::remove_const_t<Part>>) {
    visit("attached", part);
  } else {
    reject("what is attached to the mesh cannot be saved (it names no members): give it a function members");
  }
}

/// The common part of an attachment of one type.
/// \tparam Kind `AttachedPart` or `AttachedField`
template <class Kind, class Part>
class AttachedAs : public Kind {
  static constexpr bool has_thickness = requires(Part const& part) {
    { part.thickness() } -> std::convertible_to<std::optional<double>>;
  };
  static_assert(
      has_thickness || !names_thickness<Part>,
      "scarp: thickness of what is attached is never called: it needs `double thickness() const` [m], out of the "
      "plane; give what is something else another name");

 public:
  using typename Kind::Nodes, typename Kind::Entries;

  explicit AttachedAs(Part part) : part_(std::move(part)) {}
  Part const& part() const { return part_; }

  int extra_dofs() const final { return part_.extra_dofs(); }
  Verdict add_forces(Nodes const& nodes, Eigen::VectorXd const& increment, Eigen::VectorXd& forces) final {
    return part_.add_forces(nodes, increment, forces);
  }
  void add_stiffness(Entries& entries) const final { part_.add_stiffness(entries); }
  void commit(Nodes const& nodes, Eigen::VectorXd const& increment) final { part_.commit(nodes, increment); }
  std::optional<double> thickness() const final {
    if constexpr (has_thickness) return part_.thickness();
    return std::nullopt;
  }
  void write(StateWriter& writer) const final { visit_attached(writer, part_); }
  void read(StateReader& reader) final { visit_attached(reader, part_); }

 protected:
  Part part_;
};

template <int Dim, class Part>
class AttachedPartOf final : public AttachedAs<AttachedPart<Dim>, Part> {
  static_assert(Attachment<Part, Dim>,
                "scarp: what is attached needs extra_dofs(), add_forces(), add_stiffness() and commit()");
  static constexpr bool has_stick_stiffness = requires(Part const& part, std::vector<Eigen::Triplet<double>>& entries) {
    part.add_stick_stiffness(entries);
  };
  static_assert(has_stick_stiffness || !names_add_stick_stiffness<Part>,
                "scarp: add_stick_stiffness of what is attached is never called: it needs "
                "`void add_stick_stiffness(std::vector<Eigen::Triplet<double>>& entries) const`");
  static constexpr bool has_length = requires(Part const& part) {
    { part.length() } -> std::convertible_to<std::optional<double>>;
  };
  static_assert(
      has_length || !names_length<Part>,
      "scarp: length of what is attached is never called: it needs `double length() const` [m], of a body with "
      "degrees of freedom; give what is something else another name");
  using Base = AttachedAs<AttachedPart<Dim>, Part>;
  using Base::part_;

 public:
  using Base::Base;

  void add_stick_stiffness(typename Base::Entries& entries) const override {
    if constexpr (has_stick_stiffness) {
      part_.add_stick_stiffness(entries);
    } else {
      part_.add_stiffness(entries);
    }
  }
  std::optional<double> length() const override {
    if constexpr (has_length) return part_.length();
    return std::nullopt;
  }
};

}  // namespace detail

}  // namespace scarp
