// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <tuple>

#include "scarp/core/named_member.hpp"
#include "scarp/tensor/tensor.hpp"

SCARP_NAMED_MEMBER(reduced_quadrature)

namespace scarp {

/// A sampling point of a reference element: local coordinates and weight (the weights add up to the reference volume).
template <int Dim>
struct QuadraturePoint {
  Vector<Dim> xi = Vector<Dim>::Zero();  ///< local coordinates
  double weight = 0.0;                   ///< share of the reference volume, in its unit
};

/// Value of each shape function, shape (nodes).
template <class Element>
using ShapeValues = Eigen::Matrix<double, Element::nodes, 1>;

/// Derivative of each shape function, shape (nodes, dim).
template <class Element>
using ShapeGradients = Eigen::Matrix<double, Element::nodes, Element::dim>;

/// An element names its dimension, 1 to 3, and its number of nodes.
template <class Element>
concept HasNodes = requires {
  requires Element::dim >= 1 && Element::dim <= 3;
  requires Element::nodes > Element::dim;
};

/// shape(xi): values of the shape functions.
template <class Element>
concept GivesShapeValues = HasNodes<Element> && requires(Vector<Element::dim> const& xi) {
  { Element::shape(xi) } -> std::same_as<ShapeValues<Element>>;
};

/// shape_gradients(xi): derivatives of the shape functions by the local coordinates.
template <class Element>
concept GivesShapeGradients = HasNodes<Element> && requires(Vector<Element::dim> const& xi) {
  { Element::shape_gradients(xi) } -> std::same_as<ShapeGradients<Element>>;
};

/// quadrature(): a constexpr-sized array of points.
template <class Element>
concept GivesQuadrature = HasNodes<Element> && requires {
  requires std::tuple_size_v<decltype(Element::quadrature())>
  >= 1;
  { Element::quadrature()[0] } -> std::convertible_to<QuadraturePoint<Element::dim>>;
};

/// Anything that can be integrated over: an element, or the side of one.
template <class Element>
concept ReferenceCell = GivesShapeValues<Element> && GivesShapeGradients<Element> && GivesQuadrature<Element>;

/// An element names the element that its sides are, of one dimension less.
template <class Element>
concept NamesFacet = HasNodes<Element> && ReferenceCell<typename Element::Facet> && requires {
  requires Element::Facet::dim == Element::dim - 1;
  requires Element::facet_nodes == Element::Facet::nodes;
};

/// facets(): the local nodes of each side, in an order that runs with the outward normal's right-hand rule
/// (in 2D counter-clockwise around the element).
template <class Element>
concept HasFacets = NamesFacet<Element> && requires {
  { Element::facets()[0] } -> std::convertible_to<std::array<int, Element::facet_nodes>>;
};

/// An element names its cell type in VTK files.
template <class Element>
concept HasVtkCellType = requires {
  { Element::vtk_cell_type } -> std::convertible_to<int>;
};

/// For meshes made by Gmsh: its number of the element type, and for each of our local nodes Gmsh's local node.
template <class Element>
concept HasGmshType = HasNodes<Element> && requires {
  { Element::gmsh_type } -> std::convertible_to<int>;
  { Element::gmsh_order } -> std::convertible_to<std::array<int, Element::nodes>>;
};

/// reduced_quadrature(): fewer points than quadrature(), one order lower.
template <class Element>
concept GivesReducedQuadrature = GivesQuadrature<Element> && requires {
  requires std::tuple_size_v<decltype(Element::reduced_quadrature())> <
      std::tuple_size_v<decltype(Element::quadrature())>;
  { Element::reduced_quadrature()[0] } -> std::convertible_to<QuadraturePoint<Element::dim>>;
};

/// A finite element on its reference shape, without state: all members are static.
template <class Element>
concept ReferenceElement = ReferenceCell<Element> && HasFacets<Element> && HasVtkCellType<Element>;

/// Number of integration points of an element.
template <GivesQuadrature Element>
inline constexpr int quadrature_size = static_cast<int>(std::tuple_size_v<decltype(Element::quadrature())>);

namespace detail {

/// Names the missing member of a type that is no `ReferenceElement`.
template <class Element>
consteval bool check_element() {
  static_assert(HasNodes<Element>,
                "scarp: an element needs `static constexpr int` dim (1 to 3) and nodes (more than dim)");
  if constexpr (HasNodes<Element>) {
    static_assert(GivesShapeValues<Element>,
                  "scarp: an element needs `static ShapeValues<Element> shape(Vector<dim> const& xi)`");
    static_assert(GivesShapeGradients<Element>,
                  "scarp: an element needs `static ShapeGradients<Element> shape_gradients(Vector<dim> const& xi)`, "
                  "shape (nodes, dim)");
    static_assert(GivesQuadrature<Element>,
                  "scarp: an element needs `static std::array<QuadraturePoint<dim>, n> quadrature()`");
    static_assert(NamesFacet<Element>,
                  "scarp: an element needs `using Facet = ...`, an element of one dimension less, and `facet_nodes`, "
                  "its number of nodes");
    static_assert(
        !NamesFacet<Element> || HasFacets<Element>,
        "scarp: an element needs `static constexpr facets()`: arrays of its facets' local nodes, facet_nodes each");
    static_assert(GivesReducedQuadrature<Element> || !names_reduced_quadrature<Element>,
                  "scarp: reduced_quadrature of an element is never called: it needs `static "
                  "std::array<QuadraturePoint<dim>, n> reduced_quadrature()` of fewer points than quadrature()");
    static_assert(HasVtkCellType<Element>, "scarp: an element needs `static constexpr int vtk_cell_type`, for output");
  }
  return ReferenceElement<Element>;
}

}  // namespace detail

/// A `ReferenceElement`; for another type the compiler names the missing member.
template <class Element>
concept CheckedElement = detail::check_element<Element>();

}  // namespace scarp
