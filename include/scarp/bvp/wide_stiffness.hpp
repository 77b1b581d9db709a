// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "scarp/bvp/discretisation.hpp"
#include "scarp/constitutive/material_field.hpp"
#include "scarp/core/index.hpp"

namespace scarp {

/// Stiffness [N/m] at the end of an increment where the stress of a point changes with its own strain and with the mean
/// strain around it, \f$ K = K(\sigma, C^{own}) + \sum_i v_i B_i^T (C_i + C^{mean}_i) \sum_j w_{ij} B_j \f$. It couples all
/// points within the length and is not symmetric: it is applied, never assembled.
template <int Dim>
class WideStiffness {
 public:
  using Strains = std::vector<EngineeringStrain<Dim>>;
  /// Means of the strains of all points around each of them.
  using Means = std::function<Strains(Strains const&)>;

  WideStiffness() = default;

  /// means: see Means, empty where every mean is the value itself
  template <class DiscretisationType>
  WideStiffness(DiscretisationType const& discretisation, Eigen::VectorXd const& increment,
                std::vector<VoigtStress<Dim>> const& stresses, SplitTangents<Dim> const& tangents, Means means) {
    discretisation.stiffness(increment, stresses, tangents.by_own, own_);
    if (!means) return;
    auto around = std::make_shared<Around>();
    around->strains = discretisation.strain_operator(increment);
    around->means = std::move(means);
    auto const volumes = discretisation.volumes(increment);
    for (std::size_t k = 0; k < volumes.size(); ++k) around->answers.push_back(volumes[k] * tangents.by_mean[k]);
    around_ = std::move(around);
  }

  /// What the elements hold without their neighbours; all of it where there are none.
  Eigen::SparseMatrix<double> const& own() const { return own_; }
  bool is_local() const { return around_ == nullptr; }

  /// The same for more degrees of freedom, behind those of the mesh, which nothing here holds.
  void conservativeResize(Eigen::Index rows, Eigen::Index columns) { own_.conservativeResize(rows, columns); }

  /// more: [N/m], shape (degrees of freedom, twice)
  friend WideStiffness operator+(WideStiffness stiffness, Eigen::SparseMatrix<double> const& more) {
    stiffness.own_ += more;
    return stiffness;
  }

  /// Forces [N] against a small further displacement [m]; shape (degrees of freedom)
  Eigen::VectorXd operator*(Eigen::VectorXd const& displacement) const {
    Eigen::VectorXd forces = own_ * displacement;
    if (is_local()) return forces;
    Eigen::Index const of_mesh = around_->strains.cols();
    Eigen::VectorXd values = around_->strains * displacement.head(of_mesh);
    Strains strains(around_->answers.size());
    for (std::size_t k = 0; k < strains.size(); ++k) strains[k] = of_point(values, k);
    strains = around_->means(strains);
    for (std::size_t k = 0; k < strains.size(); ++k) of_point(values, k) = around_->answers[k] * strains[k];
    forces.head(of_mesh) += around_->strains.transpose() * values;
    return forces;
  }

 private:
  struct Around {
    Eigen::SparseMatrix<double> strains;     ///< of all points from displacements
    std::vector<VoigtTangent<Dim>> answers;  ///< stresses times volume [N m] from means
    Means means;
  };

  static auto of_point(Eigen::VectorXd& values, std::size_t k) {
    constexpr int size = voigt_size<Dim>;
    return values.segment<size>(static_cast<Eigen::Index>(size * k));
  }

  Eigen::SparseMatrix<double> own_;
  std::shared_ptr<Around const> around_;
};

}  // namespace scarp
