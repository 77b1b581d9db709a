// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <string_view>

#include "scarp/core/index.hpp"
#include "scarp/core/status.hpp"
#include "scarp/dem/contacts.hpp"
#include "scarp/tensor/voigt.hpp"

namespace scarp {

/// A tangent whose evaluation can fail, with its verdict. `tangent` [Pa] is usable whatever the verdict.
template <int Dim>
struct [[nodiscard]] TangentResult {
  VoigtTangent<Dim> tangent;  ///< [Pa], for engineering strain
  Verdict verdict;            ///< ok, or why the tangent was replaced
};

/// Called for tangents that a policy had to replace or could not evaluate to its accuracy; by several threads at once.
using TangentFallback = void (*)(std::string_view what, Verdict verdict);

/// One line for each on standard error.
inline void report_tangent_fallback(std::string_view what, Verdict verdict) {
  fmt::print(stderr, "scarp: {} ({}, {})\n", what, name(verdict.status), name(verdict.reason));
}

/// Fourth-order modulus D_ijkl [Pa] as a matrix with row i + Dim j and column k + Dim l.
template <int Dim>
using FullTangent = Eigen::Matrix<double, Dim * Dim, Dim * Dim>;

/// Elastic tangent under uniform strain, (Kruyt and Rothenburg 1998), every contact counted whatever its
/// shear force: \f$ D_{ijkl} = \frac1V \sum (k_n n_i l_j n_k l_l + k_t t_i l_j t_k l_l) \f$. An upper bound.
template <class PackingType>
FullTangent<PackingType::dim> contact_tangent(PackingType const& packing, typename PackingType::Law const& law) {
  constexpr int dim = PackingType::dim;
  FullTangent<dim> sum = FullTangent<dim>::Zero();
  for_each_contact(packing, law, [&](Contact<dim> const& contact) {
    ContactStiffness const& stiffness = contact.stiffness;
    Vector<dim> const n = contact.normal();
    Tensor<dim> const across = Tensor<dim>::Identity() - n * n.transpose();  // sum of t (x) t over the tangent plane
    Tensor<dim> const spring = stiffness.normal * n * n.transpose() + stiffness.tangential * across;
    for (int j = 0; j < dim; ++j) {
      for (int l = 0; l < dim; ++l) {
        sum.template block<dim, dim>(dim * j, dim * l) += contact.branch(j) * contact.branch(l) * spring;
      }
    }
  });
  return sum / packing.volume();
}

/// Part of a modulus that maps engineering strain to symmetric stress (minor symmetries imposed by averaging).
template <int Dim>
VoigtTangent<Dim> to_voigt_tangent(FullTangent<Dim> const& full) {
  VoigtTangent<Dim> voigt;
  constexpr auto indices = voigt_indices<Dim>();
  for (int p = 0; p < voigt_size<Dim>; ++p) {
    auto const [i, j] = indices[detail::index(p)];
    for (int q = 0; q < voigt_size<Dim>; ++q) {
      auto const [k, l] = indices[detail::index(q)];
      voigt(p, q) = (full(i + Dim * j, k + Dim * l) + full(j + Dim * i, k + Dim * l) + full(i + Dim * j, l + Dim * k) +
                     full(j + Dim * i, l + Dim * k)) /
                    4.0;
    }
  }
  return voigt;
}

/// tangent(packing, law): stiffness [Pa] of a packing in its present state.
template <class Tangent, class PackingType>
concept PackingTangent = requires(Tangent const& tangent, PackingType const& packing,
                                  typename PackingType::Law const& law) {
  { tangent(packing, law) } -> std::convertible_to<VoigtTangent<PackingType::dim>>;
};

/// Stiffness of a packing as a provider's tangent: all contacts elastic under uniform strain (Kruyt and Rothenburg
/// 1998).
struct AffineTangent {
  /// Elastic stiffness [Pa] of the packing for engineering strain.
  template <class PackingType>
  VoigtTangent<PackingType::dim> operator()(PackingType const& packing, typename PackingType::Law const& law) const {
    return to_voigt_tangent<PackingType::dim>(contact_tangent(packing, law));
  }
};

}  // namespace scarp
