// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <vector>

#include "scarp/dem/contacts.hpp"

namespace scarp {

/// Second-order fabric \f$ \phi_{ij} = \frac1N \sum n_i n_j \f$ (Satake 1982); trace 1.
template <int Dim>
using Fabric = Tensor<Dim>;

/// Fabric of the grains' first axes, which are the longest unless sizes were given otherwise; for shapes with an
/// orientation.
template <class PackingType>
Fabric<2> particle_fabric(PackingType const& packing) requires(PackingType::dim == 2 &&
                                                               PackingType::Shape::orientation_count == 2) {
  Fabric<2> sum = Fabric<2>::Zero();
  for (std::size_t i = 0; i < packing.grain_count(); ++i) {
    Vector<2> const axis(static_cast<double>(packing.orientation(i, 0)),
                         static_cast<double>(packing.orientation(i, 1)));
    sum += axis * axis.transpose();
  }
  return sum / static_cast<double>(packing.grain_count());
}

/// Deviator in the plane, \f$ F_{ij} = 4(\phi_{ij} - \delta_{ij}/2) \f$ , as the reference study defines it.
inline Tensor<2> fabric_deviator(Fabric<2> const& fabric) { return 4.0 * (fabric - Tensor<2>::Identity() / 2.0); }

/// Intensity of anisotropy in the plane, \f$ F = \sqrt{F_{ij} F_{ij} / 2} \f$.
inline double fabric_anisotropy(Fabric<2> const& fabric) {
  return std::sqrt(fabric_deviator(fabric).squaredNorm() / 2.0);
}

/// Mean numbers of contacts of a grain.
struct Coordination {
  double all = 0.0;  ///< \f$ 2 N_c / N_p \f$, grains without contact included
  double mechanical =
      0.0;  ///< without rattlers, grains with one contact or none: \f$ (2 N_c - N_1) / (N_p - N_0 - N_1) \f$
  double rattlers = 0.0;  ///< share of the grains
};

/// What the contacts of a packing have in common.
template <int Dim>
struct ContactNetwork {
  Fabric<Dim> fabric = Fabric<Dim>::Identity() / Dim;  ///< of the contact normals; isotropic where there is no contact
  Coordination coordination;                           ///< the mechanical number is Thornton's (2000)
};

/// In one pass over the contacts.
template <class PackingType>
ContactNetwork<PackingType::dim> contact_network(PackingType const& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  Fabric<dim> normals = Fabric<dim>::Zero();
  std::vector<int> partners(packing.grain_count(), 0);
  for_each_contact(packing, law, [&](Contact<dim> const& contact) {
    normals += contact.normal() * contact.normal().transpose();
    ++partners[contact.first];
    ++partners[contact.second];
  });
  double sum = 0.0;
  double single = 0.0;
  double rattling = 0.0;
  for (int const count : partners) {
    sum += count;
    if (count == 1) single += 1.0;
    if (count <= 1) rattling += 1.0;
  }
  double const grains = static_cast<double>(partners.size());
  double const bearing = grains - rattling;
  ContactNetwork<dim> network{.coordination = {.all = sum / grains,
                                               .mechanical = bearing > 0.0 ? (sum - single) / bearing : 0.0,
                                               .rattlers = rattling / grains}};
  if (sum > 0.0) network.fabric = normals / (0.5 * sum);
  return network;
}

}  // namespace scarp
