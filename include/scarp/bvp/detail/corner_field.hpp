// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/bvp/grid.hpp"
#include "scarp/element/mid_sides.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::detail {

/// Stresses [Pa] that pressures at points are, tension positive.
template <int Dim>
std::vector<VoigtStress<Dim>> stresses_of(Eigen::VectorXd const& pressures) {
  std::vector<VoigtStress<Dim>> all(static_cast<std::size_t>(pressures.size()), VoigtStress<Dim>::Zero());
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k].template head<Dim>().setConstant(-pressures(static_cast<Eigen::Index>(k)));
  return all;
}

/// \f$ \det(I + G) - 1 \f$ of a displacement gradient, to its own digits.
template <int Dim>
double volume_growth(Gradient<Dim> const& gradient) {
  double const trace = gradient.trace();
  double const second = (trace * trace - gradient.cwiseProduct(gradient.transpose()).sum()) / 2.0;
  return trace + second + (Dim == 3 ? gradient.determinant() : 0.0);
}

inline Eigen::Map<Eigen::VectorXd const> viewed(std::vector<double> const& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// Adds a block to a matrix. row_of, column_of: number in the matrix of one in the block, below 0 for none
template <class Rows, class Columns>
void add_block(Eigen::SparseMatrix<double> const& block, double factor, Rows const& row_of, Columns const& column_of,
               std::vector<Eigen::Triplet<double>>& entries) {
  for (int column = 0; column < block.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(block, column); entry; ++entry) {
      int const to = row_of(static_cast<int>(entry.row()));
      int const from = column_of(column);
      if (to >= 0 && from >= 0) entries.emplace_back(to, from, factor * entry.value());
    }
  }
}

/// A scalar field with values at the corners of a grid's elements, seen at the grid's points.
/// \tparam GridType a `Discretisation`
template <class GridType>
class CornerField {
 public:
  using Element = typename GridType::ElementType;
  using Corner = LinearOf<Element>;  ///< element of the field
  using Matrix = Eigen::SparseMatrix<double>;
  using Triplets = std::vector<Eigen::Triplet<double>>;
  using CornerMatrix = Eigen::Matrix<double, Corner::nodes, Corner::nodes>;
  static constexpr int dim = GridType::dim;
  static constexpr bool is_equal_order = std::is_same_v<Corner, Element>;  ///< as the displacements

  /// What the field sees of an element, in the committed configuration.
  struct Cell {
    int number = 0;                                 ///< of the element
    std::array<int, Corner::nodes> corners{};       ///< numbers of its corners
    CornerMatrix gradients = CornerMatrix::Zero();  ///< \f$ \int \nabla N_a \cdot \nabla N_b\,dv \f$
    CornerMatrix deviations =
        CornerMatrix::Zero();   ///< \f$ \int (N_a - \bar N_a)(N_b - \bar N_b)\,dv \f$ with means over the element
    double squared_size = 0.0;  ///< of an edge [m2]
  };

  explicit CornerField(GridType grid)
      : grid_(std::move(grid)), of_node_(index(grid_.node_count()), -1), has_field_(grid_.mesh().elements.size(), 1) {
    for (auto const& element : grid_.mesh().elements)
      for (std::size_t a = 0; a < Corner::nodes; ++a) of_node_[index(element[a])] = 0;
    for (int node = 0; node < grid_.node_count(); ++node) {
      if (of_node_[index(node)] < 0) continue;
      of_node_[index(node)] = detail::count(nodes_);
      nodes_.push_back(node);
    }
    Triplets entries;
    Triplets ones;
    for (int point = 0; point < grid_.point_count(); ++point) {
      ShapeValues<Corner> const shape = Corner::shape(GridType::local_point(point).xi);
      auto const& element = grid_.mesh().elements[index(element_of(point))];
      for (int a = 0; a < Corner::nodes; ++a) entries.emplace_back(point, of_node_[index(element[index(a)])], shape(a));
      for (int axis = 0; axis < dim; ++axis) ones.emplace_back(point, voigt_size<dim> * point + axis, 1.0);
    }
    shapes_.resize(grid_.point_count(), count());
    shapes_.setFromTriplets(entries.begin(), entries.end());
    trace_.resize(grid_.point_count(), voigt_size<dim> * grid_.point_count());
    trace_.setFromTriplets(ones.begin(), ones.end());
  }

  /// Numbers of a region's elements.
  std::vector<int> elements_of(std::string_view region) const {
    int const number = region_number(grid_, region);
    std::vector<int> elements;
    for (int element = 0; element < detail::count(grid_.mesh().elements); ++element)
      if (region_of(element) == number) elements.push_back(element);
    return elements;
  }
  /// Takes the field out of elements.
  /// \return corners that no element is left to
  std::vector<int> exclude(std::vector<int> const& elements) {
    for (int const element : elements) has_field_[index(element)] = 0;
    shapes_.prune(
        [&](auto point, auto, double) { return has_field_[index(element_of(static_cast<int>(point)))] != 0; });
    std::vector<int> left;
    for (int corner = 0; corner < count(); ++corner)
      if (shapes_.col(corner).nonZeros() == 0) left.push_back(corner);
    return left;
  }

  GridType const& grid() const { return grid_; }
  int count() const { return detail::count(nodes_); }  ///< of corners
  Matrix const& shapes() const { return shapes_; }     ///< values of corners to those of points
  static int element_of(int point) { return point / GridType::points_per_element; }
  int region_of(int element) const { return grid_.mesh().element_region[index(element)]; }

  /// Change of each point's volume, over the volume, for a small further displacement from the end of an increment [m].
  Matrix divergence(Eigen::VectorXd const& increment) const { return trace_ * grid_.strain_operator(increment); }

  Vector<dim> const& place(int corner) const {
    return grid_.nodes()[index(nodes_[index(corner)])];
  }  ///< at the start [m]
  /// Corners of an element.
  auto corners_of(int element) const {
    std::array<int, Corner::nodes> corners{};
    for (std::size_t a = 0; a < corners.size(); ++a)
      corners[a] = of_node_[index(grid_.mesh().elements[index(element)][a])];
    return corners;
  }

  /// visit(Cell) for all elements with the field.
  template <class Visit>
  void for_each_cell(Visit const& visit) const {
    for (std::size_t e = 0; e < grid_.mesh().elements.size(); ++e) {
      if (has_field_[e] == 0) continue;
      Cell cell{.number = static_cast<int>(e), .corners = corners_of(static_cast<int>(e))};
      std::array<int, Corner::nodes> nodes{};
      std::copy_n(grid_.mesh().elements[e].begin(), nodes.size(), nodes.begin());
      auto const rows =
          scarp::corners<Corner, dim>(nodes, GridType::follows_motion ? grid_.positions() : grid_.nodes());
      ShapeValues<Corner> mean = ShapeValues<Corner>::Zero();
      double volume = 0.0;
      for (auto const& where : Corner::template rule<2>()) {
        auto const shape = spatial_shape<Corner>(rows, where);
        double const share = shape.volume * grid_.thickness();
        ShapeValues<Corner> const values = Corner::shape(where.xi);
        cell.gradients += share * shape.gradients * shape.gradients.transpose();
        cell.deviations += share * values * values.transpose();
        mean += share * values;
        volume += share;
      }
      cell.deviations -= mean * mean.transpose() / volume;
      constexpr double cells = Corner::nodes == dim + 1 ? (dim == 2 ? 2.0 : 6.0) : 1.0;  // that share a square or cube
      cell.squared_size = std::pow(cells * volume / grid_.thickness(), 2.0 / dim);
      visit(cell);
    }
  }

  /// A value over the mean size of the elements with the field [1/m].
  double over_mean_size(double value) const {
    double size = 0.0;
    double cells = 0.0;
    for_each_cell([&](Cell const& cell) {
      size += std::sqrt(cell.squared_size);
      cells += 1.0;
    });
    return value * cells / size;
  }

  /// Areas [m2] of a boundary's corners, thickness included, on the initial mesh: \f$ \int N_a\,dA \f$
  Eigen::VectorXd areas(std::initializer_list<std::string_view> sides) const {
    using Facet = typename Element::Facet;  // curved where the element is
    using Ends = typename Corner::Facet;
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(count());
    for (auto const side : sides) {
      for (auto const& facet : boundary(grid_.mesh(), side)) {
        auto const rows = scarp::corners<Facet, dim>(facet, grid_.nodes());
        for (auto const& where : Facet::quadrature()) {
          ShapeValues<Ends> const shape = Ends::shape(where.xi);
          double const size = grid_.thickness() * where.weight * measure<Facet, dim>(rows, where.xi);
          for (int a = 0; a < Ends::nodes; ++a) areas(of_node_[index(facet[index(a)])]) += size * shape(a);
        }
      }
    }
    return areas;
  }
  /// Numbers of boundaries' corners.
  std::vector<int> corners_on(std::initializer_list<std::string_view> sides) const {
    std::vector<int> found;
    for (auto const side : sides)
      for (int const node : grid_.boundary_nodes(side))
        if (int const corner = of_node_[index(node)]; corner >= 0) found.push_back(corner);
    return found;
  }
  /// Values of corners as those of all nodes.
  std::vector<double> at_nodes(std::vector<double> const& values) const {
    std::vector<double> all(of_node_.size());
    for (auto const& element : grid_.mesh().elements) {
      ShapeValues<Corner> own;
      for (int a = 0; a < Corner::nodes; ++a) own(a) = values[index(of_node_[index(element[index(a)])])];
      for (int a = 0; a < Element::nodes; ++a) all[index(element[index(a)])] = value_at(own, a);
    }
    return all;
  }
  /// A corner in words.
  std::string describe(int corner) const {
    int const node = nodes_[index(corner)];
    return fmt::format("node {} at ({})", node, listed(grid_.nodes()[index(node)], ", ", "{:.6g}"));
  }

  void commit(Eigen::VectorXd const& increment) { grid_.commit(increment); }
  SCARP_MEMBERS_EXCEPT((of_node_, nodes_, has_field_, shapes_, trace_), grid_)

 private:
  /// The field at a node of an element.
  static double value_at(ShapeValues<Corner> const& own, int node) {
    if (node < Corner::nodes) return own(node);
    if constexpr (PlacesNodes<Element>) {
      return own.dot(Corner::shape(Element::node_places()[index(node)]));
    } else if constexpr (HasMidSides<Element>) {
      auto const [first, second] = Element::mid_sides()[index(node - Corner::nodes)];
      return (own(first) + own(second)) / 2.0;
    }
    return 0.0;
  }

  GridType grid_;
  std::vector<int> of_node_;     ///< number of each node's corner, -1 for others
  std::vector<int> nodes_;       ///< of the corners
  std::vector<char> has_field_;  ///< whether each element has
  Matrix shapes_;
  Matrix trace_;  ///< strains of all points to their changes of volume
};

}  // namespace scarp::detail
