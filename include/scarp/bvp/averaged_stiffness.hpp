// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Stiffness [N/m] at the end of an increment where the stress of a point changes with its own strain and with the mean
/// strain around it, \f$ K = K(\sigma, C^{own}) + \sum_i v_i B_i^T (C_i + C^{mean}_i) \sum_j w_{ij} B_j \f$: wider than
/// that of the elements and not symmetric. Where all means are local that of the elements.
/// tangents [Pa]: of what the points see; materials: tells mean(), added_by_own(), added_by_mean(), see
/// AveragesGradients
template <class DiscretisationType, class Materials>
void averaged_stiffness(DiscretisationType const& discretisation, Eigen::VectorXd const& increment,
                        std::vector<VoigtStress<DiscretisationType::dim>> const& stresses,
                        std::vector<VoigtTangent<DiscretisationType::dim>> const& tangents, Materials const& materials,
                        Eigen::SparseMatrix<double>& out) {
  constexpr int size = voigt_size<DiscretisationType::dim>;
  if (materials.mean().is_local()) {
    discretisation.stiffness(increment, stresses, tangents, out);
    return;
  }
  auto const volumes = discretisation.volumes(increment);
  std::vector<Eigen::Triplet<double>> entries;  // stress, times volume, of every point from the strains of all
  for (int point = 0; point < discretisation.point_count(); ++point) {
    auto const k = detail::index(point);
    VoigtTangent<DiscretisationType::dim> const answer = volumes[k] * (tangents[k] + materials.added_by_mean()[k]);
    for (auto const& share : materials.mean().of(point)) {
      for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) {
          entries.emplace_back(size * point + i, size * share.point + j, share.weight * answer(i, j));
        }
      }
    }
  }
  Eigen::SparseMatrix<double> const strains = discretisation.strain_operator(increment);
  Eigen::SparseMatrix<double> answers(strains.rows(), strains.rows());
  answers.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> const forces = answers * strains;
  Eigen::SparseMatrix<double> const wide = strains.transpose() * forces;
  out = discretisation.stiffness(increment, stresses, materials.added_by_own()) + wide;
}

}  // namespace scarp
