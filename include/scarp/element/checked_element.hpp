// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/element/reference_element.hpp"

namespace scarp {

namespace detail {

template <class Element>
concept GivesShapeValues = requires(Vector<Element::dim> const& xi) {
  { Element::shape(xi) } -> std::same_as<ShapeValues<Element>>;
};
template <class Element>
concept GivesShapeGradients = requires(Vector<Element::dim> const& xi) {
  { Element::shape_gradients(xi) } -> std::same_as<ShapeGradients<Element>>;
};
template <class Element>
concept NamesFacet = ReferenceCell<typename Element::Facet> && requires {
  requires Element::Facet::dim == Element::dim - 1;
  requires Element::facet_nodes == Element::Facet::nodes;
};

/// What of an element is missing, in words.
template <class Element, bool counted = HasNodes<Element>>
struct MissingOfElement {
  static_assert(counted, "scarp: an element needs `static constexpr int` dim (1 to 3) and nodes (more than dim)");
  static constexpr bool nothing = false;
};
template <class Element>
struct MissingOfElement<Element, true> {
  static_assert(GivesShapeValues<Element>,
                "scarp: an element needs `static ShapeValues<Element> shape(Vector<dim> const& xi)`");
  static_assert(GivesShapeGradients<Element>,
                "scarp: an element needs `static ShapeGradients<Element> shape_gradients(Vector<dim> const& xi)`, "
                "shape (nodes, dim)");
  static_assert(GivesQuadrature<Element>,
                "scarp: an element needs `static std::array<QuadraturePoint<dim>, n> quadrature()`");
  static_assert(NamesFacet<Element>,
                "scarp: an element needs `using Facet = ...`, an element of one dimension less, and `facet_nodes`, its "
                "number of nodes");
  static_assert(
      !NamesFacet<Element> || HasFacets<Element>,
      "scarp: an element needs `static constexpr facets()`: arrays of its facets' local nodes, facet_nodes each");
  static_assert(HasVtkCellType<Element>, "scarp: an element needs `static constexpr int vtk_cell_type`, for output");
  static constexpr bool nothing = false;
};

}  // namespace detail

/// A `ReferenceElement`; of one that is none the compiler says in words what is missing.
template <class Element>
concept CheckedElement = ReferenceElement<Element> || detail::MissingOfElement<Element>::nothing;

}  // namespace scarp
