// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "scarp/core/index.hpp"
#include "scarp/core/named_member.hpp"
#include "scarp/element/reference_element.hpp"

SCARP_NAMED_MEMBER(mid_sides)

namespace scarp {

/// A cell with one more node in the middle of each edge. Its first nodes are those of `Linear`, on the same reference
/// shape; mid_sides() are the two corners that each further node lies between.
template <class Element>
concept HasMidSides = ReferenceCell<Element> && ReferenceCell<typename Element::Linear> && requires {
  requires Element::Linear::dim == Element::dim;
  requires Element::mid_sides()
  .size() + Element::Linear::nodes == Element::nodes;
  { Element::mid_sides()[0] } -> std::convertible_to<std::array<int, 2>>;
};

/// An element with nodes beyond its corners, wherever they are. Its first nodes are those of `Linear`, on the same
/// reference shape; node_places(): local coordinates of all its nodes.
template <class Element>
concept PlacesNodes = ReferenceCell<Element> && ReferenceCell<typename Element::Linear> && requires {
  requires Element::Linear::dim == Element::dim;
  requires Element::Linear::nodes < Element::nodes;
  requires std::tuple_size_v<decltype(Element::node_places())>
  == std::size_t{Element::nodes};
  { Element::node_places()[0] } -> std::convertible_to<Vector<Element::dim>>;
};

namespace detail {

template <class Element>
struct CornerElement {
  static_assert(!names_mid_sides<Element>,
                "scarp: mid_sides of an element is never called: it needs `using Linear = ...` of the same reference "
                "shape and `static constexpr std::array<std::array<int, 2>, N> mid_sides()` for its N further nodes");
  using Type = Element;
};
template <class Element>
  requires(HasMidSides<Element> || PlacesNodes<Element>)
struct CornerElement<Element> {
  using Type = typename Element::Linear;
};

}  // namespace detail

/// The element of the corners alone; a straight element itself.
template <class Element>
using LinearOf = typename detail::CornerElement<Element>::Type;

namespace detail {

/// Quadratic shapes of a simplex from its linear ones L: \f$ N_a = L_a (2 L_a - 1) \f$ at the corners and
/// \f$ N_m = 4 L_a L_b \f$ in the middle between two.
template <class Element>
ShapeValues<Element> quadratic_simplex(Vector<Element::dim> const& xi) {
  constexpr auto mid_sides = Element::mid_sides();
  auto const linear = Element::Linear::shape(xi);
  ShapeValues<Element> shape;
  for (int a = 0; a < linear.size(); ++a) {
    shape(a) = linear(a) * (2.0 * linear(a) - 1.0);
  }
  for (int m = 0; m < count(mid_sides); ++m) {
    auto const [a, b] = mid_sides[index(m)];
    shape(linear.size() + m) = 4.0 * linear(a) * linear(b);
  }
  return shape;
}

template <class Element>
ShapeGradients<Element> quadratic_simplex_gradients(Vector<Element::dim> const& xi) {
  constexpr auto mid_sides = Element::mid_sides();
  auto const linear = Element::Linear::shape(xi);
  auto const slopes = Element::Linear::shape_gradients(xi);
  ShapeGradients<Element> gradients;
  for (int axis = 0; axis < Element::dim; ++axis) {
    for (int a = 0; a < linear.size(); ++a) gradients(a, axis) = (4.0 * linear(a) - 1.0) * slopes(a, axis);
    for (int m = 0; m < count(mid_sides); ++m) {
      auto const [a, b] = mid_sides[index(m)];
      gradients(linear.size() + m, axis) = 4.0 * (linear(a) * slopes(b, axis) + linear(b) * slopes(a, axis));
    }
  }
  return gradients;
}

/// Serendipity shapes of [-1, 1]^dim. Between two corners that differ along \f$ \xi \f$,
/// \f$ N_m = (1 - \xi^2)(L_a + L_b) \f$ with the multilinear shapes L; a corner has \f$ N_a = L_a - \sum_m N_m / 2 \f$
/// over its edges. Written out at a corner of the square this is the usual
/// \f$ (1 + \xi_a\xi)(1 + \eta_a\eta)(\xi_a\xi + \eta_a\eta - 1)/4 \f$.
template <class Element>
ShapeValues<Element> serendipity(Vector<Element::dim> const& xi) {
  constexpr auto mid_sides = Element::mid_sides();
  auto const linear = Element::Linear::shape(xi);
  ShapeValues<Element> shape;
  for (int a = 0; a < linear.size(); ++a) shape(a) = linear(a);
  for (int m = 0; m < count(mid_sides); ++m) {
    auto const [a, b] = mid_sides[index(m)];
    double const along = xi(Element::mid_side_axes()[index(m)]);
    double const middle = (1.0 - along * along) * (linear(a) + linear(b));
    shape(linear.size() + m) = middle;
    shape(a) -= middle / 2.0;
    shape(b) -= middle / 2.0;
  }
  return shape;
}

template <class Element>
ShapeGradients<Element> serendipity_gradients(Vector<Element::dim> const& xi) {
  constexpr auto mid_sides = Element::mid_sides();
  auto const linear = Element::Linear::shape(xi);
  auto const slopes = Element::Linear::shape_gradients(xi);
  ShapeGradients<Element> gradients;
  for (int axis = 0; axis < Element::dim; ++axis) {
    for (int a = 0; a < linear.size(); ++a) gradients(a, axis) = slopes(a, axis);
    for (int m = 0; m < count(mid_sides); ++m) {
      auto const [a, b] = mid_sides[index(m)];
      int const along = Element::mid_side_axes()[index(m)];
      double middle = (1.0 - xi(along) * xi(along)) * (slopes(a, axis) + slopes(b, axis));
      if (axis == along) middle -= 2.0 * xi(along) * (linear(a) + linear(b));
      gradients(linear.size() + m, axis) = middle;
      gradients(a, axis) -= middle / 2.0;
      gradients(b, axis) -= middle / 2.0;
    }
  }
  return gradients;
}

}  // namespace detail

}  // namespace scarp
