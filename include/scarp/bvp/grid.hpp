// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/described.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Finite elements of any kind on a mesh, as a `Problem` sees them: displacement increments to gradients at the integration points,
/// stresses at the points to nodal forces and stiffness. `Discretisation` makes one of an element, kinematics and integration, and
/// documents the sums. Its only state is the committed positions of the nodes. Degree of freedom = Dim * node + axis.
template <int Dim>
class Grid {
 public:
  static constexpr int dim = Dim;  ///< of the elements and of space

  virtual ~Grid() = default;

  std::vector<Vector<Dim>> const& positions() const { return positions_; }  ///< Committed positions of the nodes [m].
  int node_count() const { return detail::count(positions_); }              ///< of the mesh
  int dof_count() const { return Dim * node_count(); }                      ///< of all nodes

  virtual std::vector<Vector<Dim>> const& nodes() const = 0;           ///< Positions [m] at the start.
  virtual std::vector<std::string> const& regions() const = 0;         ///< Names, by number.
  virtual std::vector<std::vector<int>> regions_of_nodes() const = 0;  ///< Regions of each node's elements, each once.
  virtual double thickness() const = 0;                                ///< out of the plane [m]; 1 in space
  virtual bool turns_stresses() const = 0;                             ///< Whether nodes move from step to step.
  virtual int point_count() const = 0;                                 ///< Material points of all elements.
  virtual int first_point(int element) const = 0;                      ///< Those of an element follow one another.
  virtual Site<Dim> site(int point, double surface_level) const = 0;   ///< Where a point is, and its depth [m].

  /// Displacement gradient of the increment at every point.
  /// increment [m], shape (dof_count); out: shape (point_count), always filled
  /// \return the first element whose Jacobian is not positive (or NaN) after the increment, if there is one
  /// \throws InputError for arrays of other lengths
  virtual std::optional<int> gradients(Eigen::VectorXd const& increment, std::span<Gradient<Dim>> out) const = 0;

  /// Nodal forces [N] of the points' stresses [Pa] at the end of the increment; out: shape (dof_count), overwritten
  /// \throws InputError for arrays of other lengths
  virtual void internal_force(Eigen::VectorXd const& increment, std::span<VoigtStress<Dim> const> stresses,
                              Eigen::VectorXd& out) const = 0;

  /// Derivative of the internal force [N/m] with respect to a further displacement from the end of the increment.
  /// tangents [Pa]: change of the co-rotated Cauchy stress with the strain of that further displacement
  /// out: overwritten; its memory is used again when it comes from an earlier call
  /// \throws InputError for arrays of other lengths
  virtual void stiffness(Eigen::VectorXd const& increment, std::span<VoigtStress<Dim> const> stresses,
                         std::span<VoigtTangent<Dim> const> tangents, Eigen::SparseMatrix<double>& out) const = 0;

  /// Engineering strains of all points for a small further displacement from the end of the increment [m];
  /// row = voigt_size * point + component, shape (voigt_size * point_count, dof_count)
  /// \throws InputError for an increment of another length
  virtual Eigen::SparseMatrix<double> strain_operator(Eigen::VectorXd const& increment) const = 0;

  /// Volume [m3] of each point, thickness included, in the configuration that forces are balanced in.
  /// \throws InputError for an increment of another length
  virtual std::vector<double> volumes(Eigen::VectorXd const& increment) const = 0;

  /// Makes the configuration at the end of the increment the committed one.
  /// \throws InputError when the increment is not finite or has another length; nothing has moved then
  void commit(Eigen::VectorXd const& increment) {
    require_length("displacement increment", increment.size(), dof_count());
    if (!increment.allFinite()) {
      reject("the displacement increment is not finite (a diverged step must not be committed): cut the load step");
    }
    positions_ = moved(increment);
  }

  /// What evolves: the committed positions.
  template <class Self, class Visit>
  static void members(Self& self, Visit&& visit) {
    visit("positions of nodes", std::span(self.positions_));
  }

 protected:
  explicit Grid(std::vector<Vector<Dim>> positions) : positions_(std::move(positions)) {}
  Grid(Grid const&) = default;
  Grid(Grid&&) noexcept = default;
  Grid& operator=(Grid const&) = default;
  Grid& operator=(Grid&&) noexcept = default;

  /// \throws InputError for an array of another length
  static void require_length(char const* what, std::ptrdiff_t length, int wanted) {
    if (length != wanted) {
      reject("{}: {} entries are given ({} are needed): size it by dof_count, point_count or node_count", what, length,
             wanted);
    }
  }

  /// Positions [m] at the end of an increment.
  std::vector<Vector<Dim>> moved(Eigen::VectorXd const& increment) const {
    auto nodes = positions_;
    for (int n = 0; n < node_count(); ++n) nodes[detail::index(n)] += increment.template segment<Dim>(Dim * n);
    return nodes;
  }

 private:
  std::vector<Vector<Dim>> positions_;
};

}  // namespace scarp
