// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scarp/bvp/default_integration.hpp"
#include "scarp/bvp/grid.hpp"
#include "scarp/bvp/kinematics.hpp"
#include "scarp/bvp/sparsity.hpp"
#include "scarp/core/precompiled.hpp"

namespace scarp {

/// Finite elements on a mesh, see `Grid`: point = (number of an element's material points, those of `Scheme`) *
/// element + its own number. All sums run in the order of the elements: same input, same bits.
template <CheckedElement Element, Kinematics Motion = UpdatedLagrangian,
          Integration<Element> Scheme = DefaultIntegration<Element>>
class SCARP_EXPORT Discretisation : public Grid<Element::dim> {
  using Base = Grid<Element::dim>;
  using Base::moved, Base::require_length;
  using PointNumbers = std::make_index_sequence<material_points<Scheme, Element>>;

 public:
  using Base::body_force, Base::dof_count, Base::node_count, Base::positions, Base::stiffness;
  using ElementType = Element;  ///< type of all elements of the mesh
  static constexpr bool follows_motion = Motion::follows_motion;
  static constexpr int dim = Element::dim;  ///< of the elements and of space
  static constexpr int points_per_element = static_cast<int>(material_points<Scheme, Element>);  ///< placed by `Scheme`

  /// thickness [m] out of the plane; in 3D it is 1
  /// \throws InputError for an invalid mesh or thickness
  explicit Discretisation(Mesh<Element> mesh, double thickness = 1.0)
      : Base((validate(mesh), mesh.nodes)), mesh_(std::move(mesh)), thickness_(thickness), sparsity_(mesh_) {
    require_positive("thickness", thickness);
    if (dim == 3 && thickness != 1.0)
      reject("the thickness is {} m (a three-dimensional mesh has its own): leave it at 1", thickness);
  }

  Mesh<Element> const& mesh() const { return mesh_; }  ///< with the nodes where they were at the start
  std::vector<Vector<dim>> const& nodes() const override { return mesh_.nodes; }
  std::vector<std::string> const& regions() const override { return mesh_.regions; }
  std::unique_ptr<Base> copy() const override { return std::make_unique<Discretisation>(*this); }
  Cells cells() const override { return cells_of(mesh_); }
  std::vector<int> boundary_nodes(std::string_view name) const override { return scarp::boundary_nodes(mesh_, name); }
  bool has_boundary(std::string_view name) const override { return mesh_.boundaries.contains(std::string(name)); }
  Cells facets(std::string_view boundary) const override { return facets_of(mesh_, boundary); }
  double thickness() const override { return thickness_; }
  bool turns_stresses() const override { return follows_motion; }
  int point_count() const override { return points_per_element * detail::count(mesh_.elements); }
  int first_point(int element) const override { return points_per_element * element; }

  /// Where a point is on the reference element, with its weight.
  static QuadraturePoint<dim> local_point(int point) {
    return Scheme::template points<Element>()[detail::index(point % points_per_element)];
  }

  Site<dim> site(int point, double surface_level) const override {
    int const element = point / points_per_element;
    auto const rows = corners<Element, dim>(mesh_.elements[detail::index(element)], positions());
    Vector<dim> const position = rows.transpose() * Element::shape(local_point(point).xi);
    double volume = 0.0;
    for (auto const& shape : shapes_at(rows, PointNumbers{})) volume += std::abs(shape.volume);
    constexpr double lines_of_nodes = Element::nodes > 1 << dim ? 2.0 : 1.0;
    return {.index = point,
            .region = mesh_.element_region[detail::index(element)],
            .position = position,
            .depth = surface_level - position(dim - 1),
            .element = element,
            .place = point % points_per_element,
            .size = std::pow(volume / thickness_, 1.0 / dim) / lines_of_nodes};
  }
  Tensor<dim> deformation(int point) const override {
    auto const& nodes = nodes_of(point);
    auto const shape = spatial_shape<Element>(corners<Element, dim>(nodes, mesh_.nodes), local_point(point));
    return corners<Element, dim>(nodes, positions()).transpose().lazyProduct(shape.gradients);
  }
  /// See `Grid`.
  int nearest_point(Vector<dim> const& place) const override {
    for (double const coordinate : place) require_finite("place whose nearest point is looked for", coordinate);
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int point = 0; point < point_count(); ++point) {
      auto const shape = Element::shape(local_point(point).xi);
      Vector<dim> distance = -place;
      for (int a = 0; a < Element::nodes; ++a)
        distance += shape(a) * mesh_.nodes[detail::index(nodes_of(point)[detail::index(a)])];
      if (!(distance.norm() < least)) continue;
      least = distance.norm();
      nearest = point;
    }
    return nearest;
  }
  Distortion<dim> distortion(int point) const override {
    auto const nodes = corners<Element, dim>(nodes_of(point), positions());
    Tensor<dim> const deformed = deformation(point);
    double const volume = deformed.determinant();
    double const lengths = volume > 0.0 ? deformed.squaredNorm() / std::pow(volume, 2.0 / dim) - dim : 0.0;
    return {mean_ratio<Element>(nodes, local_point(point).xi), std::sqrt(std::max(lengths, 0.0)),
            point / points_per_element, nodes.colwise().mean().transpose()};
  }

  /// See `Grid`.
  Eigen::VectorXd body_force(std::vector<Vector<dim>> const& per_volume) const override {
    if (per_volume.size() != mesh_.regions.size())
      reject("forces per volume are given for {} regions (the mesh has {}: {}): give one for each", per_volume.size(),
             mesh_.regions.size(), listed(mesh_.regions));
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(dof_count());
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
      add_forces<Element>(mesh_.elements[e], per_volume[detail::index(mesh_.element_region[e])], forces);
    return forces;
  }
  /// See `Grid`.
  Eigen::VectorXd traction(std::string_view boundary, Vector<dim> const& per_area) const override {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(dof_count());
    for (auto const& facet : scarp::boundary(mesh_, boundary))
      add_forces<typename Element::Facet>(facet, per_area, forces);
    return forces;
  }

  std::optional<int> gradients(Eigen::VectorXd const& increment, std::span<Gradient<dim>> out) const override;

  /// \f$ f_{a} = \int \sigma \nabla N_a\,dv \f$ [N] as Scheme sums it
  void internal_force(Eigen::VectorXd const& increment, std::span<VoigtStress<dim> const> stresses,
                      Eigen::VectorXd& out) const override;

  /// The stiffness [N/m] into the memory of an earlier one.
  void stiffness(Eigen::VectorXd const& increment, std::span<VoigtStress<dim> const> stresses,
                 std::span<VoigtTangent<dim> const> tangents, Eigen::SparseMatrix<double>& out) const override;

  Eigen::SparseMatrix<double> strain_operator(Eigen::VectorXd const& increment) const override;
  std::vector<double> volumes(Eigen::VectorXd const& increment) const override {
    require_length("displacement increment", increment.size(), dof_count());
    std::vector<double> volumes(detail::index(point_count()));
    for_each_element(balanced(increment), [&](int element, Shapes const& shapes) {
      for (std::size_t p = 0; p < shapes.size(); ++p) volumes[first_of(element) + p] = shapes[p].volume;
    });
    return volumes;
  }

 private:
  using Shapes = ElementShapes<Element, material_points<Scheme, Element>>;

  std::array<int, Element::nodes> const& nodes_of(int point) const {
    return mesh_.elements[detail::index(point / points_per_element)];
  }

  static constexpr std::size_t first_of(int element) { return detail::index(points_per_element * element); }

  /// The entries of an array of all points that belong to an element.
  template <class Value>
  static std::span<Value const, material_points<Scheme, Element>> of_element(std::span<Value const> values,
                                                                             int element) {
    return values.subspan(first_of(element)).template first<material_points<Scheme, Element>>();
  }

  /// Configuration that gradients of an increment refer to.
  std::vector<Vector<dim>> const& reference() const { return follows_motion ? positions() : mesh_.nodes; }

  /// Configuration that forces are balanced in.
  std::vector<Vector<dim>> balanced(Eigen::VectorXd const& increment) const {
    return follows_motion ? moved(increment) : mesh_.nodes;
  }

  Corners<Element, dim> element_part(Eigen::VectorXd const& field, int element) const {
    Corners<Element, dim> rows;
    auto const& nodes = mesh_.elements[detail::index(element)];
    for (int a = 0; a < Element::nodes; ++a) {
      rows.row(a) = field.template segment<dim>(dim * nodes[detail::index(a)]).transpose();
    }
    return rows;
  }

  /// Adds the nodal forces [N] of a force per measure of a cell, an element or a facet, on the initial mesh.
  template <class Cell>
  void add_forces(std::array<int, Cell::nodes> const& nodes, Vector<dim> const& force, Eigen::VectorXd& forces) const {
    auto const rows = corners<Cell, dim>(nodes, mesh_.nodes);
    for (auto const& where : Cell::quadrature()) {
      ShapeValues<Cell> const shape = Cell::shape(where.xi);
      double const size = thickness_ * where.weight * measure<Cell, dim>(rows, where.xi);
      for (int a = 0; a < Cell::nodes; ++a)
        forces.template segment<dim>(dim * nodes[detail::index(a)]) += shape(a) * size * force;
    }
  }

  /// visit(element, shapes) for all elements in order, as they are at the given positions.
  template <class Visit>
  void for_each_element(std::vector<Vector<dim>> const& nodes, Visit&& visit) const {
    for (int element = 0; element < detail::count(mesh_.elements); ++element) {
      auto const rows = corners<Element, dim>(mesh_.elements[detail::index(element)], nodes);
      visit(element, shapes_at(rows, PointNumbers{}));
    }
  }

  /// A pack of points, since a loop over them changes what compilers contract, and so the last bits of stiffness.
  template <std::size_t... Point>
  Shapes shapes_at(Corners<Element, dim> const& rows, std::index_sequence<Point...>) const {
    auto const points = Scheme::template points<Element>();
    auto const at = [&](std::size_t p) {
      auto shape = spatial_shape<Element>(rows, points[p]);
      shape.volume *= thickness_;
      return shape;
    };
    return {{at(Point)...}};
  }

  Mesh<Element> mesh_;
  double thickness_;
  Sparsity sparsity_;
};

template <CheckedElement Element, Kinematics Motion, Integration<Element> Scheme>
std::optional<int> Discretisation<Element, Motion, Scheme>::gradients(Eigen::VectorXd const& increment,
                                                                      std::span<Gradient<dim>> out) const {
  require_length("displacement increment", increment.size(), dof_count());
  require_length("gradients", std::ssize(out), point_count());
  std::optional<int> inverted;
  for_each_element(reference(), [&](int element, Shapes const& shapes) {
    auto const gradients = Scheme::template gradients<Motion>(shapes, element_part(increment, element));
    for (std::size_t p = 0; p < gradients.size(); ++p) {
      out[first_of(element) + p] = Motion::template material_gradient<dim>(gradients[p]);
      if (Motion::follows_motion && !inverted && !((Tensor<dim>::Identity() + gradients[p]).determinant() > 0.0)) {
        inverted = element;
      }
    }
  });
  return inverted;
}

template <CheckedElement Element, Kinematics Motion, Integration<Element> Scheme>
void Discretisation<Element, Motion, Scheme>::internal_force(Eigen::VectorXd const& increment,
                                                             std::span<VoigtStress<dim> const> stresses,
                                                             Eigen::VectorXd& out) const {
  require_length("displacement increment", increment.size(), dof_count());
  require_length("stresses", std::ssize(stresses), point_count());
  out.setZero(dof_count());
  for_each_element(balanced(increment), [&](int element, Shapes const& shapes) {
    Corners<Element, dim> const forces = Scheme::forces(shapes, of_element(stresses, element));
    auto const& nodes = mesh_.elements[detail::index(element)];
    for (int a = 0; a < Element::nodes; ++a) {
      out.template segment<dim>(dim * nodes[detail::index(a)]) += forces.row(a).transpose();
    }
  });
}

template <CheckedElement Element, Kinematics Motion, Integration<Element> Scheme>
void Discretisation<Element, Motion, Scheme>::stiffness(Eigen::VectorXd const& increment,
                                                        std::span<VoigtStress<dim> const> stresses,
                                                        std::span<VoigtTangent<dim> const> tangents,
                                                        Eigen::SparseMatrix<double>& out) const {
  require_length("displacement increment", increment.size(), dof_count());
  require_length("stresses", std::ssize(stresses), point_count());
  require_length("tangents", std::ssize(tangents), point_count());
  sparsity_.reset(out);
  double* const values = out.valuePtr();
  for_each_element(balanced(increment), [&](int element, Shapes const& shapes) {
    ElementMatrix<Element> const matrix =
        Scheme::template stiffness<Motion>(shapes, of_element(stresses, element), of_element(tangents, element));
    int const* const to = sparsity_.addresses().data() + element * matrix.size();
    for (int entry = 0; entry < matrix.size(); ++entry) values[to[entry]] += matrix(entry);
  });
}

template <CheckedElement Element, Kinematics Motion, Integration<Element> Scheme>
Eigen::SparseMatrix<double> Discretisation<Element, Motion, Scheme>::strain_operator(
    Eigen::VectorXd const& increment) const {
  require_length("displacement increment", increment.size(), dof_count());
  std::vector<Eigen::Triplet<double>> entries;
  for_each_element(balanced(increment), [&](int element, Shapes const& shapes) {
    auto const& nodes = mesh_.elements[detail::index(element)];
    for (int a = 0; a < Element::nodes; ++a) {
      for (int axis = 0; axis < dim; ++axis) {
        Corners<Element, dim> move = Corners<Element, dim>::Zero();
        move(a, axis) = 1.0;
        auto const gradients = Scheme::template gradients<SmallStrain>(shapes, move);
        for (int p = 0; p < points_per_element; ++p) {
          auto const strain = to_engineering_strain<dim, double>(gradients[detail::index(p)]);
          int const row = voigt_size<dim> * (points_per_element * element + p);
          for (int k = 0; k < voigt_size<dim>; ++k) {
            entries.emplace_back(row + k, dim * nodes[detail::index(a)] + axis, strain(k));
          }
        }
      }
    }
  });
  Eigen::SparseMatrix<double> strains(voigt_size<dim> * point_count(), dof_count());
  strains.setFromTriplets(entries.begin(), entries.end());
  return strains;
}

}  // namespace scarp
