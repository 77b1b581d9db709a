// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scarp/constitutive/strength.hpp"
#include "scarp/core/precompiled.hpp"
#include "scarp/tensor/tensor.hpp"
#ifdef SCARP_DEFINITIONS
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
    PrincipalReturn found;
    for (int count = 1; count <= 3 && !found.found; ++count) found = with_planes(count, trial, slack, {});
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

  /// The first return with `count` active planes, of which the first `chosen` are given and the others numbered from
  /// `next`.
  PrincipalReturn with_planes(int count, Vector<3> const& trial, double slack, std::array<int, 3> active,
                              int chosen = 0, int next = 0) const {
    if (chosen == count) return attempt(count, active, trial, slack);
    for (; next < count_; ++next) {
      active[detail::index(chosen)] = next;
      auto const found = with_planes(count, trial, slack, active, chosen + 1, next + 1);
      if (found.found) return found;
    }
    return {};
  }

  // A system of at most four equations: loops over it compile in a fifth of the time of Eigen's fixed sizes.
  using System = std::array<std::array<double, 4>, 4>;
  using Unknowns = std::array<double, 4>;
  /// Inverse of the first `size` rows and columns by elimination with partial pivoting; returns the determinant, and
  /// where that is zero no inverse.
  static double invert(System matrix, std::size_t size, System& inverse);
  static Unknowns product(System const& matrix, Unknowns const& vector, std::size_t size);

  /// With exactly these planes active.
  PrincipalReturn attempt(int count, std::array<int, 3> const& active, Vector<3> const& trial, double slack) const;

  double lame_lambda_;    // [Pa]
  double twice_shear_;    // [Pa]
  double bulk_ratio_;     // of the two
  double cut_off_ = 0.0;  // [Pa]
  std::array<YieldPlane, 6> planes_;
  int count_ = 0;
};

SCARP_DEFINITIONS double MohrCoulombReturn::invert(System matrix, std::size_t size, System& inverse) {
  inverse = {};
  for (std::size_t i = 0; i < size; ++i) inverse[i][i] = 1.0;
  double determinant = 1.0;
  for (std::size_t column = 0; column < size; ++column) {
    std::size_t largest = column;
    for (std::size_t row = column + 1; row < size; ++row) {
      if (std::abs(matrix[row][column]) > std::abs(matrix[largest][column])) largest = row;
    }
    double const pivot = matrix[largest][column];
    determinant *= largest == column ? pivot : -pivot;
    if (pivot == 0.0) return 0.0;
    std::swap(matrix[column], matrix[largest]);
    std::swap(inverse[column], inverse[largest]);
    for (std::size_t j = 0; j < size; ++j) {
      matrix[column][j] /= pivot;
      inverse[column][j] /= pivot;
    }
    for (std::size_t row = 0; row < size; ++row) {
      if (row == column) continue;
      double const factor = matrix[row][column];
      for (std::size_t j = 0; j < size; ++j) {
        matrix[row][j] -= factor * matrix[column][j];
        inverse[row][j] -= factor * inverse[column][j];
      }
    }
  }
  return determinant;
}

SCARP_DEFINITIONS MohrCoulombReturn::Unknowns MohrCoulombReturn::product(System const& matrix, Unknowns const& vector,
                                                                         std::size_t size) {
  Unknowns sums{};
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) sums[i] += matrix[i][j] * vector[j];
  }
  return sums;
}

/// Multipliers \f$ \mu = 2G\lambda \f$ and the mean stress \f$ p = \kappa\,1\cdot R\mu,\; \kappa = \lambda_L/2G \f$,
/// that plastic flow R subtracts, are unknowns of one system: however large kappa is near incompressibility, nothing
/// large is subtracted,
/// \f$ N^T R\mu + N^T 1\,p = f^{tr},\; \kappa\,1^T R\mu - p = 0 \f$, the second row divided by 1 + |kappa|.
SCARP_DEFINITIONS PrincipalReturn MohrCoulombReturn::attempt(int count, std::array<int, 3> const& active,
                                                             Vector<3> const& trial, double slack) const {
  auto const planes = detail::index(count);
  std::size_t const unknowns = planes + 1;
  double const part = bulk_ratio_ / (1.0 + std::abs(bulk_ratio_));
  std::array<Vector<3>, 4> rows;
  std::array<Vector<3>, 4> flows;  // the last one a unit of mean stress
  Unknowns over{};
  for (std::size_t k = 0; k < planes; ++k) {
    auto const& chosen = plane(active[k]);
    rows[k] = chosen.normal;
    flows[k] = chosen.flow;
    over[k] = chosen.normal.dot(trial) - chosen.limit;
  }
  rows[planes].setConstant(part);
  flows[planes].setConstant(1.0);
  System system{};
  double norms = 1.0;
  for (std::size_t k = 0; k < unknowns; ++k) {
    for (std::size_t l = 0; l < unknowns; ++l) system[k][l] = rows[k].dot(flows[l]);
    if (k == planes) system[k][k] = -1.0 / (1.0 + std::abs(bulk_ratio_));
    double squares = 0.0;
    for (double const entry : system[k]) squares += entry * entry;
    norms *= std::sqrt(squares);
  }
  // Planes whose flows oppose one plastic strain only, such as all three of a frictionless prism, are no corner.
  System inverse;
  if (!(std::abs(invert(system, unknowns, inverse)) > 1e-10 * norms)) return {};
  auto solution = product(inverse, over, unknowns);
  // Planes of much friction are nearly parallel.
  auto rest = product(system, solution, unknowns);
  for (std::size_t k = 0; k < unknowns; ++k) rest[k] = over[k] - rest[k];
  auto const correction = product(inverse, rest, unknowns);
  for (std::size_t k = 0; k < unknowns; ++k) solution[k] += correction[k];
  for (std::size_t k = 0; k < planes; ++k) {
    if (!(solution[k] >= -slack)) return {};
  }
  PrincipalReturn result;
  result.stress = trial;
  System carried{};  // unknowns for units of strain
  for (int j = 0; j < 3; ++j) {
    Unknowns strain{};
    for (std::size_t l = 0; l < unknowns; ++l) strain[l] = rows[l](j);
    carried[detail::index(j)] = product(inverse, strain, unknowns);
  }
  for (int i = 0; i < 3; ++i) {
    double flow = 0.0;
    for (std::size_t k = 0; k < planes; ++k) flow += flows[k](i) * solution[k];
    result.plastic_strain(i) = flow / twice_shear_;
    result.stress(i) -= flow + solution[planes];
    // The unknowns of a strain are the multipliers and the change of the mean stress itself, with the other sign.
    for (int j = 0; j < 3; ++j) {
      double change = i == j ? 1.0 : 0.0;
      for (std::size_t k = 0; k < unknowns; ++k) change -= flows[k](i) * carried[detail::index(j)][k];
      result.tangent(i, j) = twice_shear_ * change;
    }
  }
  if (!(excess(result.stress) <= slack)) return {};
  result.planes = count;
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
