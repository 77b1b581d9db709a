// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <concepts>
#include <span>

#include "scarp/bvp/kinematics.hpp"
#include "scarp/element/map.hpp"

namespace scarp {

/// Shape gradients and volumes at the material points of one element, in one configuration.
template <class Element, std::size_t Points>
using ElementShapes = std::array<SpatialShape<Element>, Points>;

/// Change of an element's nodal forces [N/m] with its nodal displacements, both numbered dim * local node + axis.
template <class Element>
using ElementMatrix = Eigen::Matrix<double, Element::dim * Element::nodes, Element::dim * Element::nodes>;

/// points<Element>(): the material points of an element, an array of constexpr size.
template <class Policy, class Element>
concept PlacesPoints = requires {
  { Policy::template points<Element>()[0] } -> std::convertible_to<QuadraturePoint<Element::dim>>;
  requires std::tuple_size_v<decltype(Policy::template points<Element>())>
  >= 1;
};

template <class Policy, class Element>
  requires PlacesPoints<Policy, Element>
inline constexpr std::size_t material_points = std::tuple_size_v<decltype(Policy::template points<Element>())>;

/// gradients<Motion>(shapes, moves): the displacement gradient of each point for nodal moves from the shapes'
/// configuration, before Motion::seen. A point that the moves turn inside out keeps a gradient G with det(I + G) <= 0.
template <class Policy, class Element>
concept GivesGradients = PlacesPoints<Policy, Element> &&
    requires(ElementShapes<Element, material_points<Policy, Element>> const& shapes,
             Corners<Element, Element::dim> const& moves) {
  { Policy::template gradients<UpdatedLagrangian>(shapes, moves)[0] } -> std::convertible_to<Gradient<Element::dim>>;
};

/// forces(shapes, stresses): nodal forces [N], shape (nodes, dim), with shapes in the configuration that forces are
/// balanced in. stiffness<Motion>(shapes, stresses, tangents): their derivative.
template <class Policy, class Element>
concept GivesForces = PlacesPoints<Policy, Element> &&
    requires(ElementShapes<Element, material_points<Policy, Element>> const& shapes,
             std::array<VoigtStress<Element::dim>, material_points<Policy, Element>> const& stresses,
             std::array<VoigtTangent<Element::dim>, material_points<Policy, Element>> const& tangents) {
  { Policy::forces(shapes, std::span(stresses)) } -> std::same_as<Corners<Element, Element::dim>>;
  {
    Policy::template stiffness<UpdatedLagrangian>(shapes, std::span(stresses), std::span(tangents))
    } -> std::same_as<ElementMatrix<Element>>;
};

/// How an element is integrated: where its material points are and how they add up. All members are static.
template <class Policy, class Element>
concept Integration = GivesGradients<Policy, Element> && GivesForces<Policy, Element>;

}  // namespace scarp
