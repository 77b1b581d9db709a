// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/bvp/constraints.hpp"
#include "scarp/bvp/grid.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/status.hpp"
#include "scarp/io/state_bits.hpp"
#include "scarp/tensor/tensor.hpp"

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

/// Values at all nodes of a mesh under a name, for files.
struct NodalField {
  std::string name;            ///< in files
  std::vector<double> values;  ///< shape (nodes)
};

/// An attachment whose degrees of freedom are a field over the mesh, such as the pressure of pore water, and no bodies:
/// they are solved together with the displacements, and what is known of them belongs to the field itself. is_field:
/// true;
/// at(load): from now on forces belong to a step that ends at this load factor; next_knot(load): first load factor
/// beyond one where the field's own courses may turn; name(): of its residual; residual(unbalanced): imbalance of its
/// own equations, relative to its own measure, shape (extra_dofs); describe(number): a degree of freedom in words;
/// nodal_fields() and ground_force(), what it does to the mesh [N], shape (dof_count of the mesh): committed;
/// time_error(), where it has one: estimated error in time of the step whose forces were requested last, over what is
/// allowed.
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

/// An `Attachment` of any type.
template <int Dim>
class AttachedPart {
 public:
  using Nodes = std::vector<Vector<Dim>>;
  using Entries = std::vector<Eigen::Triplet<double>>;

  virtual ~AttachedPart() = default;
  virtual int extra_dofs() const = 0;
  virtual Verdict add_forces(Nodes const& nodes, Eigen::VectorXd const& increment, Eigen::VectorXd& forces) = 0;
  virtual void add_stiffness(Entries& entries) const = 0;
  virtual void add_stick_stiffness(Entries& entries) const = 0;
  virtual void commit(Nodes const& nodes, Eigen::VectorXd const& increment) = 0;
  virtual std::optional<double> thickness() const = 0;
  virtual std::optional<double> length() const = 0;
  virtual bool is_field() const = 0;
  virtual void at(double load) = 0;
  virtual double next_knot(double load) const = 0;
  virtual double time_error() const = 0;  ///< 0 for what estimates none
  virtual std::string name() const = 0;
  virtual double residual(Eigen::VectorXd const& unbalanced) const = 0;  ///< of a field
  virtual std::string describe(int number) const = 0;
  virtual std::vector<NodalField> nodal_fields() const = 0;
  virtual Eigen::VectorXd ground_force() const = 0;  ///< of a field
  virtual void write(StateWriter& writer) const = 0;
  virtual void read(StateReader& reader) = 0;

  /// \throws InputError for another thickness than the mesh's, and constraints of a field's degrees of freedom
  void require_fit(Grid<Dim> const& grid, Constraints const& constraints) const {
    if (auto const own = thickness(); own && *own != grid.thickness()) {
      reject("what is attached to the mesh is {} m thick out of the plane (the mesh is {} m): give both the same", *own,
             grid.thickness());
    }
    for (int number = 0; is_field() && number < extra_dofs(); ++number) {
      if (constraints.is_prescribed(grid.dof_count() + number))
        reject("{} is prescribed by a constraint (the field knows its own boundaries): give it there",
               describe(number));
    }
  }
};

/// A stiffness [N/m] of what is attached, nothing where that is null, shape (size, size).
template <int Dim>
Eigen::SparseMatrix<double> assembled(AttachedPart<Dim> const* part,
                                      void (AttachedPart<Dim>::*add)(std::vector<Eigen::Triplet<double>>&) const,
                                      int size) {
  std::vector<Eigen::Triplet<double>> entries;
  if (part) (part->*add)(entries);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <int Dim, class Part>
class AttachedPartOf final : public AttachedPart<Dim> {
  static_assert(Attachment<Part, Dim>,
                "scarp: what is attached needs extra_dofs(), add_forces(), add_stiffness() and commit()");
  static constexpr bool is_a_field = FieldAttachment<Part>;
  static_assert(is_a_field || !NamesField<Part>,
                "scarp: an attachment that is a field needs at(), next_knot(), name(), residual(), describe(), "
                "nodal_fields() and ground_force()");

 public:
  using typename AttachedPart<Dim>::Nodes, typename AttachedPart<Dim>::Entries;

  explicit AttachedPartOf(Part part) : part_(std::move(part)) {}
  Part const& part() const { return part_; }

  int extra_dofs() const override { return part_.extra_dofs(); }
  Verdict add_forces(Nodes const& nodes, Eigen::VectorXd const& increment, Eigen::VectorXd& forces) override {
    return part_.add_forces(nodes, increment, forces);
  }
  void add_stiffness(Entries& entries) const override { part_.add_stiffness(entries); }
  void add_stick_stiffness(Entries& entries) const override {
    if constexpr (requires { part_.add_stick_stiffness(entries); }) {
      part_.add_stick_stiffness(entries);
    } else {
      part_.add_stiffness(entries);
    }
  }
  void commit(Nodes const& nodes, Eigen::VectorXd const& increment) override { part_.commit(nodes, increment); }
  std::optional<double> thickness() const override {
    if constexpr (requires { part_.thickness(); }) return part_.thickness();
    return std::nullopt;
  }
  std::optional<double> length() const override {
    if constexpr (requires { part_.length(); }) return part_.length();
    return std::nullopt;
  }
  bool is_field() const override { return is_a_field; }
  void at(double load) override {
    if constexpr (is_a_field) part_.at(load);
  }
  double next_knot(double load) const override {
    if constexpr (is_a_field) return part_.next_knot(load);
    return std::numeric_limits<double>::infinity();
  }
  double time_error() const override {
    if constexpr (requires { part_.time_error(); }) return part_.time_error();
    return 0.0;
  }
  std::string name() const override {
    if constexpr (is_a_field) return part_.name();
    return "attached";
  }
  double residual(Eigen::VectorXd const& unbalanced) const override {
    if constexpr (is_a_field) return part_.residual(unbalanced);
    return 0.0;
  }
  std::string describe(int number) const override {
    if constexpr (is_a_field) return part_.describe(number);
    return fmt::format("extra degree of freedom {}", number);
  }
  std::vector<NodalField> nodal_fields() const override {
    if constexpr (is_a_field) return part_.nodal_fields();
    return {};
  }
  Eigen::VectorXd ground_force() const override {
    if constexpr (is_a_field) return part_.ground_force();
    return {};
  }
  void write(StateWriter& writer) const override { described(writer, part_); }
  void read(StateReader& reader) override { described(reader, part_); }

 private:
  template <class Visit, class Visited>
  static void described(Visit& visit, Visited& part) {
    if constexpr (Described<Part>) {
      visit("attached", part);
    } else {
      reject("what is attached to the mesh cannot be saved (it names no members): give it a function members");
    }
  }

  Part part_;
};

}  // namespace detail

/// A degree of freedom in words: that of a node, or one of what is attached.
template <int Dim>
std::string describe_dof(Grid<Dim> const& grid, int dof, detail::AttachedPart<Dim> const* attached) {
  return attached && dof >= grid.dof_count() ? attached->describe(dof - grid.dof_count()) : describe_dof(grid, dof);
}

}  // namespace scarp
