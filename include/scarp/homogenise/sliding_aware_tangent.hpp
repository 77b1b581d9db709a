// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/homogenise/contact_tangent.hpp"
#include "scarp/homogenise/detail/sliding_contacts.hpp"

namespace scarp {

/// Tangent under uniform strain as eq. 6 of the study, but contacts at their shear limit count as they slide:
/// \f$ D_{ijkl} = \frac1V \sum S_{ik} l_j l_l \f$ with the spring S of each contact.
struct SlidingAwareTangent {
  SlidingContacts sliding{};

  /// \return [Pa], not symmetric where `sliding.coupled`
  template <class PackingType>
  VoigtTangent<PackingType::dim> operator()(PackingType const& packing, typename PackingType::Law const& law) const {
    constexpr int dim = PackingType::dim;
    FullTangent<dim> sum = FullTangent<dim>::Zero();
    for_each_contact(packing, law, [&](Contact<dim> const& contact) {
      Tensor<dim> const spring = sliding.spring(contact, law);
      for (int j = 0; j < dim; ++j) {
        for (int l = 0; l < dim; ++l) {
          sum.template block<dim, dim>(dim * j, dim * l) += contact.branch(j) * contact.branch(l) * spring;
        }
      }
    });
    return to_voigt_tangent<dim>(sum / packing.volume());
  }
};

}  // namespace scarp
