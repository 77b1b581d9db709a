// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scarp/dem/boundary.hpp"

namespace scarp {

/// Linear displacements of a boundary frame: grains whose centres lie within a rim at the cell's faces follow the mean
/// strain, centre and spin. They touch their periodic neighbours. Its excess of stiffness over `Periodic` falls with
/// the size of the cell (J. Dettmar and C. Miehe, XXI ICTAM, Warsaw 2004); a rim of all grains is uniform strain. A
/// grain that drifts into the rim stays. The faces are those of the reduced cell: they change where a sheared cell is
/// reduced, once the shear exceeds about a half.
struct UniformStrainRim {
  double width = 1.0;  ///< of the rim at each face, over the diameter of the disc or sphere of mean content

  /// \throws InputError
  void validate() const { require_not_negative("width of the rim", width); }

  template <class PackingType>
  void constrain(PackingType const& packing, GrainHolds<PackingType> const& holds) const {
    constexpr int dim = PackingType::dim;
    Tensor<dim> const inverse = packing.cell.inverse();
    double const content = packing.population->content() / static_cast<double>(packing.grain_count());
    double const diameter =
        dim == 2 ? std::sqrt(4.0 / std::numbers::pi * content) : std::cbrt(6.0 / std::numbers::pi * content);
    for (std::size_t i = 0; i < packing.grain_count(); ++i) {
      Vector<dim> place;
      for (int a = 0; a < dim; ++a) place(a) = static_cast<double>(packing.position(i, a));
      Vector<dim> const cells = inverse * place;
      for (int a = 0; a < dim; ++a) {
        double const share = cells(a) - std::floor(cells(a));
        if (std::min(share, 1.0 - share) < width * diameter * inverse.row(a).norm()) {
          holds.hold(i);
          break;
        }
      }
    }
  }
};

}  // namespace scarp
