// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>

#include "scarp/bvp/integration.hpp"

namespace scarp {

/// The element's own rule if the changes of shape at its points and one change of volume can hold every motion of the
/// element, else one of degree 4: six points in Tri6, fourteen in Tet10.
struct ShapeChangeRule {
  template <GivesQuadrature Element>
  static auto points() {
    constexpr int dim = Element::dim;
    constexpr int held = quadrature_size<Element> * (voigt_size<dim> - 1) + 1;
    if constexpr (held >= dim * Element::nodes - dim * (dim + 1) / 2) {
      return Element::quadrature();
    } else {
      return Element::template rule<4>();
    }
  }
};

/// Every point has the shape change at its own place and the volume change of the whole element, so that a material
/// that keeps its volume binds an element once and not at every point. In the plane the split is one of the plane,
/// with dim = 2: \f$ \varepsilon_{zz} \f$ stays zero.
/// Made for Quad4 and Hex8; with one volume change per element a quadratic element converges only like a linear one.
/// Small strain: \f$ \bar G = G + \tfrac1{dim} (\overline{tr\,G} - tr\,G) I \f$ with the mean over the element,
/// Hughes, Int. J. Numer. Meth. Engng 15 (1980) 1413.
/// Large: \f$ \bar F = (\bar J / J)^{1/dim} F \f$ with \f$ \bar J \f$ the element's volume at the end over that at the
/// start, Simo, Taylor and Pister, Comput. Meth. Appl. Mech. Engng 51 (1985) 177. Forces are the virtual power of
/// \f$ \bar F \f$'s velocity over the points' volumes v at the end:
/// \f$ f_a = \sum_p v\,(\sigma \nabla N_a + s\,(\overline{\nabla N_a} - \nabla N_a)),\; s = tr(\sigma)/dim \f$
/// The original weighs by the volumes that \f$ \bar J \f$ gives instead, which makes a hyperelastic stiffness
/// symmetric; the two differ where the volume change varies within an element.
/// \tparam Rule a `PlacesPoints` of the elements that are integrated
template <class Rule>
struct MeanDilatation {
  template <class Element>
    requires PlacesPoints<Rule, Element>
  static auto points() { return Rule::template points<Element>(); }

  template <class Motion, class Element, std::size_t Points>
  static std::array<Gradient<Element::dim>, Points> gradients(std::array<SpatialShape<Element>, Points> const& shapes,
                                                              Corners<Element, Element::dim> const& moves) {
    auto gradients = PointwiseIntegration<Rule>::template gradients<Motion>(shapes, moves);
    Tensor<Element::dim> const identity = Tensor<Element::dim>::Identity();
    std::array<double, Points> changes;  // J, or the trace
    double volume = 0.0;
    double mean = 0.0;
    bool inverted = false;
    for (std::size_t p = 0; p < Points; ++p) {
      changes[p] = Motion::follows_motion ? (identity + gradients[p]).determinant() : gradients[p].trace();
      inverted = inverted || !(changes[p] > 0.0);
      volume += shapes[p].volume;
      mean += shapes[p].volume * changes[p];
    }
    mean /= volume;
    if (Motion::follows_motion && inverted) {
      return gradients;
    }
    for (std::size_t p = 0; p < Points; ++p) {
      if constexpr (Motion::follows_motion) {
        gradients[p] = std::pow(mean / changes[p], 1.0 / Element::dim) * (identity + gradients[p]) - identity;
      } else {
        gradients[p] += (mean - changes[p]) / Element::dim * identity;
      }
    }
    return gradients;
  }

  /// Nodal forces [N], shape (nodes, dim).
  template <class Element, std::size_t Points>
  static Corners<Element, Element::dim> forces(std::array<SpatialShape<Element>, Points> const& shapes,
                                               std::span<VoigtStress<Element::dim> const, Points> stresses) {
    constexpr int dim = Element::dim;
    auto const mean = mean_gradients(shapes);
    Corners<Element, dim> sum = Corners<Element, dim>::Zero();
    for (std::size_t p = 0; p < Points; ++p) {
      Tensor<dim> const stress = from_voigt_stress<dim, double>(stresses[p]);
      sum += shapes[p].volume * (shapes[p].gradients * stress + stress.trace() / dim * (mean - shapes[p].gradients));
    }
    return sum;
  }

  /// Exact. With \f$ \Phi(L) \f$ the motion's flux change, \f$ \theta = (\overline{tr L} - tr L)/dim \f$,
  /// \f$ \bar L = L + \theta I \f$, and \f$ \bar G = G + \gamma I \f$ for the virtual gradient G:
  /// \f$ \delta f = \sum_p v\,[\Phi(\bar L):\bar G] \f$, and where the configuration moves also
  /// \f$ \sum_p v\,[\gamma\,\sigma:L - (dim - 1)\theta\,\sigma:\bar G + s\,tr(GL)]
  /// + S\,[\overline{tr L\,tr G - tr(GL)} - \overline{tr L}\;\overline{tr G}],\; S = \sum_p v s \f$
  /// The first term removes the excess of \f$ \Phi(\bar L) \f$; the last is the change of the mean.
  template <class Motion, class Element, std::size_t Points>
  static ElementMatrix<Element> stiffness(std::array<SpatialShape<Element>, Points> const& shapes,
                                          std::span<VoigtStress<Element::dim> const, Points> stresses,
                                          std::span<VoigtTangent<Element::dim> const, Points> tangents) {
    constexpr int dim = Element::dim;
    using Nodal = Corners<Element, dim>;
    Nodal const mean = mean_gradients(shapes);
    auto const [volume, pressure] = totals(shapes, stresses);
    ElementMatrix<Element> matrix = ElementMatrix<Element>::Zero();
    for (std::size_t p = 0; p < Points; ++p) {
      Nodal const& own = shapes[p].gradients;
      Nodal const to_mean = mean - own;
      Tensor<dim> const stress = from_voigt_stress<dim, double>(stresses[p]);
      double const s = stress.trace() / dim;
      Nodal const pulled = own * stress + s * to_mean;
      for (int b = 0; b < Element::nodes; ++b) {
        for (int k = 0; k < dim; ++k) {
          double const theta = to_mean(b, k) / dim;
          Gradient<dim> further = Gradient<dim>::Zero();
          further.row(k) = own.row(b);
          Gradient<dim> const seen = further + theta * Gradient<dim>::Identity();
          Tensor<dim> const flux = Motion::template flux_change<dim>(seen, stresses[p], tangents[p]);
          Nodal column = own * flux.transpose() + flux.trace() / dim * to_mean;
          if constexpr (Motion::follows_motion) {
            double const mean_pressure = pressure / volume;
            column += stress.row(k).dot(own.row(b)) / dim * to_mean - (dim - 1) * theta * pulled +
                      (s - mean_pressure) * own * further + mean_pressure * (own(b, k) * own - mean(b, k) * mean);
          }
          matrix.col(dim * b + k) += shapes[p].volume * column.transpose().reshaped();
        }
      }
    }
    return matrix;
  }

 private:
  template <class Element, std::size_t Points>
  static Corners<Element, Element::dim> mean_gradients(std::array<SpatialShape<Element>, Points> const& shapes) {
    Corners<Element, Element::dim> mean = Corners<Element, Element::dim>::Zero();
    double volume = 0.0;
    for (auto const& shape : shapes) {
      mean += shape.volume * shape.gradients;
      volume += shape.volume;
    }
    return mean / volume;
  }

  /// Volume of the element and \f$ S = \sum_p v\,tr(\sigma)/dim \f$.
  template <class Element, std::size_t Points>
  static std::array<double, 2> totals(std::array<SpatialShape<Element>, Points> const& shapes,
                                      std::span<VoigtStress<Element::dim> const, Points> stresses) {
    std::array<double, 2> sums{};
    for (std::size_t p = 0; p < Points; ++p) {
      sums[0] += shapes[p].volume;
      sums[1] += shapes[p].volume * stresses[p].template head<Element::dim>().sum() / Element::dim;
    }
    return sums;
  }
};

/// Mean dilatation at the points of `ShapeChangeRule` (B-bar).
using BBar = MeanDilatation<ShapeChangeRule>;

}  // namespace scarp
