// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "../shared/convergence_table.hpp"
#include "../shared/plane_strain.hpp"

namespace thick_cylinder {

/// Quarter of a ring about the origin; the cells grow with the radius, so that they keep their shape.
struct QuarterRing {
  double inner = 1.0;  ///< [m]
  double outer = 2.0;  ///< [m]
  int radial = 4;      ///< cells
  int around = 4;

  /// Boundaries: "left" the inner wall, "right" the outer one, "bottom" on the x axis, "top" on the y axis.
  template <class Element>
  scarp::Mesh<Element> mesh() const {
    return scarp::BoxMesh<Element>{
        .cells = {radial, around},
        .map =
            [this](scarp::Vector<2> const& box) {
              double const radius = inner * std::pow(outer / inner, box.x());
              double const angle = std::numbers::pi / 2.0 * box.y();
              return scarp::Vector<2>(radius * scarp::Vector<2>(std::cos(angle), std::sin(angle)));
            }}
        .generate();
  }
};

/// Keeps the nodes on the axes there.
template <class Element>
scarp::Constraints symmetric(scarp::Mesh<Element> const& mesh) {
  scarp::Constraints constraints(mesh);
  for (int const node : boundary_nodes(mesh, "bottom")) constraints.fix(node, 1);
  for (int const node : boundary_nodes(mesh, "top")) constraints.fix(node, 0);
  return constraints;
}

/// Radial and hoop stress [Pa] at a place, tension positive.
struct PolarStress {
  double radial = 0.0;
  double hoop = 0.0;

  PolarStress(scarp::VoigtStress<2> const& stress, scarp::Vector<2> const& place) {
    scarp::Vector<2> const out = place.normalized();
    scarp::Vector<2> const along(-out.y(), out.x());
    scarp::Tensor<2> const tensor = scarp::from_voigt_stress<2, double>(stress);
    radial = out.dot(tensor * out);
    hoop = along.dot(tensor * along);
  }
  PolarStress(double of_radius, double of_hoop) : radial(of_radius), hoop(of_hoop) {}
};

}  // namespace thick_cylinder
