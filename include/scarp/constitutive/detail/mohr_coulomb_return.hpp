// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <utility>

#include "scarp/constitutive/strength.hpp"
#include "scarp/core/index.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/core/tensor.hpp"

namespace scarp::detail {

/// A plane that bounds the admissible principal stresses, \f$ n\cdot\sigma \le s \f$, and the direction of plastic flow on it.
struct YieldPlane {
  Vector<3> normal;
  Vector<3> flow;
  double limit;
};

/// Where a trial stress returns to.
struct PrincipalReturn {
  Vector<3> stress = Vector<3>::Zero();          ///< [Pa]
  Vector<3> plastic_strain = Vector<3>::Zero();  ///< increment
  Tensor<3> tangent = Tensor<3>::Zero();         ///< change of the stress with the trial strain [Pa]
  int planes = 0;                                ///< how many are active: 0 elastic, 1 face, 2 edge, 3 corner
  bool found = false;
};

/// Return of principal stresses, largest first, to the Mohr-Coulomb pyramid with tension cut-off: an implicit Euler step,
/// which for planes and linear elasticity is a linear complementarity problem in the plastic multipliers,
/// \f$ f_k = n_k\cdot(\sigma^{tr} - C\,\sum_l \lambda_l r_l) - s_k \le 0,\; \lambda_k \ge 0,\; \lambda_k f_k = 0 \f$
/// solved by trying faces, edges and corners in this order. Faces: \f$ (1+\sin\varphi)\sigma_i - (1-\sin\varphi)\sigma_j \le 2c\cos\varphi \f$
/// for i < j, which suffice for ordered stresses, with flow by psi, and \f$ \sigma_i \le t \f$ with associated flow, through
/// which the apex is reached whatever psi is. (de Souza Neto, Peric and Owen, Computational Methods for Plasticity, ch. 8.)
class MohrCoulombReturn {
 public:
  MohrCoulombReturn(Strength const& strength, double lame_lambda, double shear_modulus) {
    stiffness_.setConstant(lame_lambda);
    stiffness_.diagonal().array() += 2.0 * shear_modulus;
    double const friction = std::sin(strength.friction);
    double const dilation = std::sin(strength.dilation);
    double const limit = 2.0 * strength.cohesion * std::cos(strength.friction);
    for (auto const& [larger, smaller] : {std::pair{0, 2}, std::pair{0, 1}, std::pair{1, 2}}) {
      add(between(larger, smaller, friction), between(larger, smaller, dilation), limit);
    }
    if (double const tension = strength.cut_off(); std::isfinite(tension)) {
      for (int i = 0; i < 3; ++i) add(Vector<3>::Unit(i), Vector<3>::Unit(i), tension);
    }
  }

  /// trial: ordered, largest (most tensile) first [Pa]
  PrincipalReturn operator()(Vector<3> const& trial) const {
    // A cut-off beyond the trial stress does not count: c cot(phi) of hardly any friction would make the slack as large as c.
    double const size = std::max(trial.cwiseAbs().maxCoeff(), plane(0).limit);
    double const slack = 1e-12 * size;
    if (admissible(trial, 0.0)) return {trial, Vector<3>::Zero(), stiffness_, 0, true};
    for (int a = 0; a < count_; ++a) {
      if (auto const found = attempt<1>({a}, trial, slack); found.found) return found;
    }
    for (int a = 0; a < count_; ++a) {
      for (int b = a + 1; b < count_; ++b) {
        if (auto const found = attempt<2>({a, b}, trial, slack); found.found) return found;
      }
    }
    for (int a = 0; a < count_; ++a) {
      for (int b = a + 1; b < count_; ++b) {
        for (int c = b + 1; c < count_; ++c) {
          if (auto const found = attempt<3>({a, b, c}, trial, slack); found.found) return found;
        }
      }
    }
    return {};
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

  bool admissible(Vector<3> const& stress, double slack) const {
    for (int k = 0; k < count_; ++k) {
      if (!(plane(k).normal.dot(stress) <= plane(k).limit + slack)) return false;
    }
    return true;
  }

  /// With exactly these planes active. Outside of the class, so that a library can keep it.
  template <int Count>
  PrincipalReturn attempt(std::array<int, Count> const& active, Vector<3> const& trial, double slack) const;

  Tensor<3> stiffness_;  // between principal strains and stresses
  std::array<YieldPlane, 6> planes_;
  int count_ = 0;
};

template <int Count>
SCARP_EXPORT PrincipalReturn MohrCoulombReturn::attempt(std::array<int, Count> const& active, Vector<3> const& trial,
                                                        double slack) const {
  Eigen::Matrix<double, 3, Count> normals;
  Eigen::Matrix<double, 3, Count> flows;
  Eigen::Matrix<double, Count, 1> excess;
  for (int k = 0; k < Count; ++k) {
    auto const& chosen = plane(active[detail::index(k)]);
    normals.col(k) = chosen.normal;
    flows.col(k) = chosen.flow;
    excess(k) = chosen.normal.dot(trial) - chosen.limit;
  }
  using Square = Eigen::Matrix<double, Count, Count>;
  Square const coupling = normals.transpose() * stiffness_ * flows;
  // Planes whose flows oppose one plastic strain only, such as all three of a frictionless prism, are no corner.
  double const size = coupling.diagonal().prod();
  if (!(std::abs(coupling.determinant()) > 1e-10 * std::abs(size))) return {};
  Square const inverse = coupling.inverse();
  Eigen::Matrix<double, Count, 1> const multipliers = inverse * excess;
  if (!((multipliers.array() * stiffness_(0, 0)).minCoeff() >= -slack)) return {};
  PrincipalReturn result;
  result.plastic_strain = flows * multipliers;
  result.stress = trial - stiffness_ * result.plastic_strain;
  if (!admissible(result.stress, slack)) return {};
  result.tangent = stiffness_ - stiffness_ * flows * inverse * normals.transpose() * stiffness_;
  result.planes = Count;
  result.found = true;
  return result;
}

/// DECLARE: `extern template`, or `template` in the library.
#define SCARP_MOHR_COULOMB(DECLARE, COUNT)                                                                           \
  DECLARE PrincipalReturn MohrCoulombReturn::attempt<COUNT>(std::array<int, COUNT> const&, Vector<3> const&, double) \
      const;
#ifdef SCARP_PRECOMPILED
SCARP_MOHR_COULOMB(extern template, 1)
SCARP_MOHR_COULOMB(extern template, 2)
SCARP_MOHR_COULOMB(extern template, 3)
#endif

}  // namespace scarp::detail
