// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/strength.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/tensor/tensor.hpp"
#ifdef SCARP_DEFINITIONS
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scarp/core/index.hpp"
#include "scarp/core/nan_max.hpp"
#endif

namespace scarp::detail {

/// Where a trial stress returns to.
struct PrincipalReturn {
  Vector<3> stress = Vector<3>::Zero();          ///< [Pa]
  Vector<3> plastic_strain = Vector<3>::Zero();  ///< increment
  Tensor<3> tangent = Tensor<3>::Zero();         ///< change of the stress with the trial strain [Pa]
  int planes = 0;                                ///< how many are active: 0 elastic, 1 face, 2 edge, 3 corner
  bool found = false;
};

/// Return of principal stresses `trial` [Pa], largest (most tensile) first, to the Mohr-Coulomb pyramid; lame_lambda,
/// shear_modulus [Pa]
SCARP_EXPORT PrincipalReturn mohr_coulomb_return(Strength const& strength, double lame_lambda, double shear_modulus,
                                                 Vector<3> const& trial);

/// By how much a stress [Pa], largest first, exceeds the strength [Pa]; not above zero within it.
SCARP_EXPORT double mohr_coulomb_excess(Strength const& strength, Vector<3> const& stress);

#ifdef SCARP_DEFINITIONS
/// A plane that bounds the admissible principal stresses, \f$ n\cdot\sigma \le s \f$, and the direction of plastic flow
/// on it.
struct YieldPlane {
  Vector<3> normal;
  Vector<3> flow;
  double limit;
};

/// Return of principal stresses, largest first, to the Mohr-Coulomb pyramid with tension cut-off: an implicit Euler
/// step, which for planes and linear elasticity is a linear complementarity problem in the plastic multipliers,
/// \f$ f_k = n_k\cdot(\sigma^{tr} - C\,\sum_l \lambda_l r_l) - s_k \le 0,\; \lambda_k \ge 0,\; \lambda_k f_k = 0 \f$
/// solved by trying faces, edges and corners in this order. Faces:
/// \f$ (1+\sin\varphi)\sigma_i - (1-\sin\varphi)\sigma_j \le 2c\cos\varphi \f$
/// for i < j, which suffice for ordered stresses, with flow by psi, and \f$ \sigma_i \le t \f$ with associated flow,
/// through which the apex is reached whatever psi is. (de Souza Neto, Peric and Owen, Computational Methods for
/// Plasticity, ch. 8.)
class MohrCoulombReturn {
 public:
  MohrCoulombReturn(Strength const& strength, double lame_lambda, double shear_modulus)
      : lame_lambda_(lame_lambda), twice_shear_(2.0 * shear_modulus), bulk_ratio_(lame_lambda / twice_shear_) {
    cut_off_ = strength.cut_off();
    double const friction = std::sin(strength.friction);
    double const dilation = std::sin(strength.dilation);
    double const limit = 2.0 * strength.cohesion * std::cos(strength.friction);
    for (auto const& [larger, smaller] : {std::pair{0, 2}, std::pair{0, 1}, std::pair{1, 2}}) {
      add(between(larger, smaller, friction), between(larger, smaller, dilation), limit);
    }
    if (std::isfinite(cut_off_)) {
      for (int i = 0; i < 3; ++i) add(Vector<3>::Unit(i), Vector<3>::Unit(i), cut_off_);
    }
  }

  PrincipalReturn operator()(Vector<3> const& trial) const {
    // A cut-off beyond the trial stress does not count: c cot(phi) of hardly any friction would make the slack as large
    // as c.
    double const size = std::max(trial.cwiseAbs().maxCoeff(), plane(0).limit);
    double const slack = 1e-12 * size;
    if (excess(trial) <= 0.0) return {trial, Vector<3>::Zero(), elastic_stiffness(), 0, true};
    auto found = with_planes<1>(trial, slack);
    if (!found.found) found = with_planes<2>(trial, slack);
    if (!found.found) found = with_planes<3>(trial, slack);
    // All planes meet at the apex, also where fewer of them lead there: no strain changes the stress.
    if (found.found && found.stress.minCoeff() >= cut_off_ - slack) found.tangent.setZero();
    return found;
  }

  double excess(Vector<3> const& stress) const {
    double most = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < count_; ++k) most = nan_max(most, plane(k).normal.dot(stress) - plane(k).limit);
    return most;
  }

 private:
  static Vector<3> between(int larger, int smaller, double sine) {
    Vector<3> direction = Vector<3>::Zero();
    direction(larger) = 1.0 + sine;
    direction(smaller) = -(1.0 - sine);
    return direction;
  }

  void add(Vector<3> const& normal, Vector<3> const& flow, double limit) {
    planes_[detail::index(count_++)] = {normal, flow, limit};
  }

  YieldPlane const& plane(int k) const { return planes_[detail::index(k)]; }

  Tensor<3> elastic_stiffness() const {
    Tensor<3> stiffness = Tensor<3>::Constant(lame_lambda_);
    stiffness.diagonal().array() += twice_shear_;
    return stiffness;
  }

  /// The first return with so many active planes, of which the first `chosen` are given and the others numbered from
  /// `next`.
  template <int Count>
  PrincipalReturn with_planes(Vector<3> const& trial, double slack, std::array<int, detail::index(Count)> active = {},
                              int chosen = 0, int next = 0) const {
    if (chosen == Count) return attempt<Count>(active, trial, slack);
    for (; next < count_; ++next) {
      active[detail::index(chosen)] = next;
      auto const found = with_planes<Count>(trial, slack, active, chosen + 1, next + 1);
      if (found.found) return found;
    }
    return {};
  }

  /// With exactly these planes active.
  template <int Count>
  PrincipalReturn attempt(std::array<int, detail::index(Count)> const& active, Vector<3> const& trial,
                          double slack) const;

  double lame_lambda_;    // [Pa]
  double twice_shear_;    // [Pa]
  double bulk_ratio_;     // of the two
  double cut_off_ = 0.0;  // [Pa]
  std::array<YieldPlane, 6> planes_;
  int count_ = 0;
};

/// Multipliers \f$ \mu = 2G\lambda \f$ and the mean stress \f$ p = \kappa\,1\cdot R\mu,\; \kappa = \lambda_L/2G \f$,
/// that plastic flow R subtracts, are unknowns of one system: however large kappa is near incompressibility, nothing
/// large is subtracted,
/// \f$ N^T R\mu + N^T 1\,p = f^{tr},\; \kappa\,1^T R\mu - p = 0 \f$, the second row divided by 1 + |kappa|.
template <int Count>
PrincipalReturn MohrCoulombReturn::attempt(std::array<int, detail::index(Count)> const& active, Vector<3> const& trial,
                                           double slack) const {
  Eigen::Matrix<double, 3, Count> normals;
  Eigen::Matrix<double, 3, Count + 1> flows;  // the last one a unit of mean stress
  Eigen::Matrix<double, Count + 1, 1> over;
  for (int k = 0; k < Count; ++k) {
    auto const& chosen = plane(active[detail::index(k)]);
    normals.col(k) = chosen.normal;
    flows.col(k) = chosen.flow;
    over(k) = chosen.normal.dot(trial) - chosen.limit;
  }
  flows.col(Count).setOnes();
  over(Count) = 0.0;
  double const part = bulk_ratio_ / (1.0 + std::abs(bulk_ratio_));
  Eigen::Matrix<double, Count + 1, 3> rows;
  rows.template topRows<Count>() = normals.transpose();
  rows.row(Count).setConstant(part);
  Eigen::Matrix<double, Count + 1, Count + 1> system = rows * flows;
  system(Count, Count) = -1.0 / (1.0 + std::abs(bulk_ratio_));
  // Planes whose flows oppose one plastic strain only, such as all three of a frictionless prism, are no corner.
  if (!(std::abs(system.determinant()) > 1e-10 * system.rowwise().norm().prod())) return {};
  auto const inverse = system.inverse().eval();
  Eigen::Matrix<double, Count + 1, 1> solution = inverse * over;
  solution += inverse * (over - system * solution);  // planes of much friction are nearly parallel
  if (!(solution.template head<Count>().minCoeff() >= -slack)) return {};
  PrincipalReturn result;
  result.plastic_strain = flows.template leftCols<Count>() * solution.template head<Count>() / twice_shear_;
  result.stress = trial - flows * solution;
  if (!(excess(result.stress) <= slack)) return {};
  // Of a strain the unknowns are the multipliers and the change of the mean stress itself, with the other sign.
  result.tangent = twice_shear_ * (Tensor<3>::Identity() - flows * inverse * rows);
  result.planes = Count;
  result.found = true;
  return result;
}

SCARP_DEFINITIONS PrincipalReturn mohr_coulomb_return(Strength const& strength, double lame_lambda,
                                                      double shear_modulus, Vector<3> const& trial) {
  return MohrCoulombReturn(strength, lame_lambda, shear_modulus)(trial);
}

SCARP_DEFINITIONS double mohr_coulomb_excess(Strength const& strength, Vector<3> const& stress) {
  return MohrCoulombReturn(strength, 0.0, 1.0).excess(stress);  // whatever the elasticity is
}
#endif

}  // namespace scarp::detail
