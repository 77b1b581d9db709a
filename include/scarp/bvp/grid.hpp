// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <concepts>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/constitutive/constitutive_provider.hpp"
#include "scarp/core/error.hpp"
#include "scarp/core/index.hpp"
#include "scarp/mesh/cells.hpp"

namespace scarp {

/// An element's shape and what has become of it.
template <int Dim>
struct Distortion {
  double mean_ratio = 1.0;                  ///< of its shape now
  double shear = 0.0;                       ///< simple shear with the same change of lengths, since the start
  int element = -1;                         ///< number; -1 without elements
  Vector<Dim> place = Vector<Dim>::Zero();  ///< of its middle now [m]
};

/// Finite elements of any kind on a mesh, as a `Problem` sees them: displacement increments to gradients at the
/// integration points, stresses at the points to nodal forces and stiffness. `Discretisation` makes one of an element,
/// kinematics and integration, and documents the sums. Its only state is the committed positions of the nodes. Degree
/// of freedom = Dim * node + axis.
template <int Dim>
class Grid {
 public:
  static constexpr int dim = Dim;  ///< of the elements and of space

  virtual ~Grid() = default;

  std::vector<Vector<Dim>> const& positions() const { return positions_; }  ///< Committed positions of the nodes [m].
  int node_count() const { return detail::count(positions_); }              ///< of the mesh
  int dof_count() const { return Dim * node_count(); }                      ///< of all nodes

  virtual std::vector<Vector<Dim>> const& nodes() const = 0;    ///< Positions [m] at the start.
  virtual std::vector<std::string> const& regions() const = 0;  ///< Names of the regions; elements have their numbers.
  virtual std::unique_ptr<Grid> copy() const = 0;               ///< With the same committed positions.
  virtual Cells cells() const = 0;                              ///< Its elements.
  /// Nodes of a boundary, sorted, each once. \throws InputError for an unknown or empty one
  virtual std::vector<int> boundary_nodes(std::string_view name) const = 0;
  virtual bool has_boundary(std::string_view name) const = 0;  ///< Whether the mesh has a boundary of this name.
  /// Facets of a boundary. \throws InputError for an unknown or empty one
  virtual Cells facets(std::string_view boundary) const = 0;
  virtual double thickness() const = 0;                               ///< out of the plane [m]; 1 in space
  virtual bool turns_stresses() const = 0;                            ///< Whether nodes move from step to step.
  virtual int point_count() const = 0;                                ///< Material points of all elements.
  virtual int first_point(int element) const = 0;                     ///< Those of an element follow one another.
  virtual Site<Dim> site(int point, double surface_level) const = 0;  ///< Where a point is, and its depth [m].

  /// Gradient of the committed with respect to the initial position at a point; what its material sees may differ, see
  /// MeanDilatation.
  virtual Tensor<Dim> deformation(int point) const = 0;

  /// Number of the point nearest to a place [m] in the initial mesh.
  /// \throws InputError for a place that is not finite
  virtual int nearest_point(Vector<Dim> const& place) const = 0;
  /// Distortion of a point's element; its mean ratio is that at the point.
  virtual Distortion<Dim> distortion(int point) const = 0;

  /// Nodal forces [N], shape (dof_count), consistent with a force per volume on the initial mesh:
  /// \f$ f_a = \int N_a b\,dV \f$. A dead load: mass is conserved, so the forces stay when the mesh deforms.
  /// per_volume: b [N/m3] of every region of the mesh
  /// \throws InputError unless there is one for each region
  virtual Eigen::VectorXd body_force(std::vector<Vector<Dim>> const& per_volume) const = 0;
  /// Nodal forces [N], shape (dof_count), of force_of_region(number of a region): b [N/m3], shape (Dim).
  template <std::invocable<int> ForceOfRegion>
  Eigen::VectorXd body_force(ForceOfRegion const& force_of_region) const {
    std::vector<Vector<Dim>> per_volume;
    for (int region = 0; region < detail::count(regions()); ++region) per_volume.push_back(force_of_region(region));
    return body_force(per_volume);
  }

  /// Nodal forces [N], shape (dof_count), consistent with a force per area [Pa] on a boundary of the initial mesh:
  /// \f$ f_a = \int N_a t\,dA \f$. A dead load: it follows neither the size nor the direction of the deformed boundary.
  /// \throws InputError for an unknown boundary
  virtual Eigen::VectorXd traction(std::string_view boundary, Vector<Dim> const& per_area) const = 0;

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
  /// The stiffness [N/m] as a matrix of its own, shape (dof_count, dof_count).
  /// \throws InputError for arrays of other lengths
  Eigen::SparseMatrix<double> stiffness(Eigen::VectorXd const& increment, std::span<VoigtStress<Dim> const> stresses,
                                        std::span<VoigtTangent<Dim> const> tangents) const {
    Eigen::SparseMatrix<double> matrix;
    stiffness(increment, stresses, tangents, matrix);
    return matrix;
  }

  /// Engineering strains of all points for a small further displacement from the end of the increment [m];
  /// row = voigt_size * point + component, shape (voigt_size * point_count, dof_count)
  /// \throws InputError for an increment of another length
  virtual Eigen::SparseMatrix<double> strain_operator(Eigen::VectorXd const& increment) const = 0;

  /// Volume [m3] of each point, thickness included, in the configuration that forces are balanced in.
  /// \throws InputError for an increment of another length
  virtual std::vector<double> volumes(Eigen::VectorXd const& increment) const = 0;

  /// Regions of each node's elements, each once.
  std::vector<std::vector<int>> regions_of_nodes() const {
    auto const elements = cells();
    std::vector<std::vector<int>> regions_of(positions_.size());
    for (std::size_t k = 0; k < elements.connectivity.size(); ++k) {
      auto& regions = regions_of[detail::index(elements.connectivity[k])];
      int const region = elements.regions[k / detail::index(elements.nodes)];
      if (std::ranges::find(regions, region) == regions.end()) regions.push_back(region);
    }
    return regions_of;
  }

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
  /// positions [m]: of the nodes at the start
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

namespace detail {
/// \throws InputError where there is no grid
template <int Dim>
std::unique_ptr<Grid<Dim>> present(std::unique_ptr<Grid<Dim>> grid) {
  if (!grid) reject("a problem has no grid (its pointer is null): give it elements on a mesh");
  return grid;
}
}  // namespace detail

/// Number of a region. \throws InputError for an unknown name, listing the known ones
template <int Dim>
int region_number(Grid<Dim> const& grid, std::string_view name) {
  return detail::region_among(grid.regions(), name);
}

/// A degree of freedom in words: node, place, axis and the regions that the node belongs to.
template <int Dim>
std::string describe_dof(Grid<Dim> const& grid, int dof) {
  int const node = dof / Dim;
  if (dof < 0) return "an unknown degree of freedom";
  if (node >= grid.node_count()) return fmt::format("extra degree of freedom {}", dof - grid.dof_count());
  std::set<std::string> regions;
  auto const of_nodes = grid.regions_of_nodes();
  for (int const region : of_nodes[detail::index(node)]) regions.insert(grid.regions()[detail::index(region)]);
  return fmt::format("node {} at ({}), axis {}, region {}", node,
                     listed(grid.nodes()[detail::index(node)], ", ", "{:.6g}"), dof % Dim, listed(regions, " and "));
}

}  // namespace scarp
