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

/// Number of material points of an element.
template <class Policy, class Element>
  requires PlacesPoints<Policy, Element>
inline constexpr std::size_t material_points = std::tuple_size_v<decltype(Policy::template points<Element>())>;

/// gradients<Motion>(shapes, moves): the displacement gradient of each point for nodal moves from the shapes'
/// configuration, before Motion::material_gradient. A point that the moves turn inside out keeps a gradient G with
/// det(I + G) <= 0.
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

/// An element's full quadrature.
struct FullRule {
  template <GivesQuadrature Element>
  static auto points() {
    return Element::quadrature();
  }
};

/// An element's reduced quadrature, one order below the full one.
struct ReducedRule {
  template <GivesReducedQuadrature Element>
  static auto points() {
    return Element::reduced_quadrature();
  }
};

/// The displacement method as it stands: every point sees the displacement gradient at its own place.
/// \tparam Rule a `PlacesPoints` of the elements that are integrated
template <class Rule>
struct PointwiseIntegration {
  template <class Element>
    requires PlacesPoints<Rule, Element>
  static auto points() { return Rule::template points<Element>(); }

  template <class Motion, class Element, std::size_t Points>
  static std::array<Gradient<Element::dim>, Points> gradients(std::array<SpatialShape<Element>, Points> const& shapes,
                                                              Corners<Element, Element::dim> const& moves) {
    std::array<Gradient<Element::dim>, Points> gradients;
    for (std::size_t p = 0; p < Points; ++p) {
      gradients[p] = moves.transpose().lazyProduct(shapes[p].gradients);
    }
    return gradients;
  }

  /// \f$ f_a = \sum_p v\,\sigma \nabla N_a \f$
  template <class Element, std::size_t Points>
  static Corners<Element, Element::dim> forces(std::array<SpatialShape<Element>, Points> const& shapes,
                                               std::span<VoigtStress<Element::dim> const, Points> stresses) {
    auto const of_point = [&](std::size_t p) -> Corners<Element, Element::dim> {
      Tensor<Element::dim> const stress = from_voigt_stress<Element::dim, double>(stresses[p]);
      return shapes[p].volume * shapes[p].gradients * stress;
    };
    Corners<Element, Element::dim> sum = of_point(0);
    for (std::size_t p = 1; p < Points; ++p) {
      sum += of_point(p);
    }
    return sum;
  }

  /// Derivative [N/m] of the nodal forces by the nodal displacements, in numbers dim * local node + axis.
  template <class Motion, class Element, std::size_t Points>
  static ElementMatrix<Element> stiffness(std::array<SpatialShape<Element>, Points> const& shapes,
                                          std::span<VoigtStress<Element::dim> const, Points> stresses,
                                          std::span<VoigtTangent<Element::dim> const, Points> tangents) {
    constexpr int dim = Element::dim;
    ElementMatrix<Element> matrix = ElementMatrix<Element>::Zero();
    for (std::size_t p = 0; p < Points; ++p) {
      auto const& shape = shapes[p];
      for (int b = 0; b < Element::nodes; ++b) {
        for (int k = 0; k < dim; ++k) {
          Gradient<dim> further = Gradient<dim>::Zero();
          further.row(k) = shape.gradients.row(b);
          Tensor<dim> const flux = Motion::template flux_change<dim>(further, stresses[p], tangents[p]);
          Corners<Element, dim> const column = shape.volume * shape.gradients * flux.transpose();
          matrix.col(dim * b + k) += column.transpose().reshaped();
        }
      }
    }
    return matrix;
  }
};

/// All points of the element's rule: the stiffness of an undistorted element is exact. Low-order elements lock when the
/// material hardly changes its volume.
using FullIntegration = PointwiseIntegration<FullRule>;

/// One order lower: cheap, does not lock, but some motions of an element have no stiffness (see its header). Quad8 and
/// Hex20 do not share theirs with their neighbours; Quad4 and Hex8 do, and need a boundary that prevents them.
using ReducedIntegration = PointwiseIntegration<ReducedRule>;

}  // namespace scarp
