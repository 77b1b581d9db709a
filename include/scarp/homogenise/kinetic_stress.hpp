// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/dem/packing.hpp"

namespace scarp {

/// The part of the stress that moving grains carry, \f$ -\frac1V \sum m\, v \otimes v \f$ with the fluctuation velocities
/// [Pa], tension positive. Apart from Love and Weber's, to which it is small in a quasi-static packing.
template <class PackingType>
Tensor<PackingType::dim> kinetic_stress(PackingType const& packing) {
  constexpr int dim = PackingType::dim;
  Tensor<dim> sum = Tensor<dim>::Zero();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    Vector<dim> velocity;
    for (int a = 0; a < dim; ++a) velocity(a) = static_cast<double>(packing.velocity(i, a));
    sum -= velocity * velocity.transpose() / static_cast<double>(packing.population->inverse_mass()[i]);
  }
  return sum / packing.volume();
}

}  // namespace scarp
