// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>

#include "bvp/sample_problems.hpp"

/// Checks of a discretisation's stiffness against its own forces.
namespace samples {

/// Compressible neo-Hookean solid, whose stress is a closed function of the whole deformation from the mesh and whose
/// tangent is exact at any increment: \f$ J\sigma = \mu (b - I) + \lambda \ln J\,I \f$, plane strain in 2D.
/// The tangent refers to the co-rotational (Jaumann) rate of Cauchy stress: \f$ C:d = (\lambda\,tr(d) I +
/// 2(\mu - \lambda \ln J) d)/J + d\sigma + \sigma d - tr(d)\sigma \f$. It follows from
/// \f$ \dot b = l b + b l^T,\; \dot J = J\,tr(d) \f$ put into the derivative of the stress, with l = d and no spin.
template <int Dim>
struct NeoHookean {
  static constexpr int dim = Dim;
  struct State {
    scarp::Tensor<Dim> deformation = scarp::Tensor<Dim>::Identity();
  };
  double lambda = 3e6;
  double mu = 2e6;

  scarp::Tensor<Dim> cauchy(scarp::Tensor<Dim> const& deformation) const {
    double const volume = deformation.determinant();
    scarp::Tensor<Dim> const identity = scarp::Tensor<Dim>::Identity();
    return (mu * (deformation * deformation.transpose() - identity) + lambda * std::log(volume) * identity) / volume;
  }
  scarp::Response<Dim> respond(State const& committed, scarp::Gradient<Dim> const& increment, State& trial) const {
    trial.deformation = (scarp::Tensor<Dim>::Identity() + increment) * committed.deformation;
    return {scarp::to_voigt_stress<Dim, double>(cauchy(trial.deformation)), {}};
  }
  scarp::VoigtTangent<Dim> tangent(State const& state) const {
    double const volume = state.deformation.determinant();
    scarp::Tensor<Dim> const stress = cauchy(state.deformation);
    scarp::VoigtTangent<Dim> tangent;
    constexpr auto indices = scarp::voigt_indices<Dim>();
    for (int k = 0; k < scarp::voigt_size<Dim>; ++k) {
      auto const [i, j] = indices[static_cast<std::size_t>(k)];
      scarp::Tensor<Dim> d = scarp::Tensor<Dim>::Zero();
      d(i, j) += 0.5;
      d(j, i) += 0.5;
      scarp::Tensor<Dim> const change =
          (lambda * d.trace() * scarp::Tensor<Dim>::Identity() + 2.0 * (mu - lambda * std::log(volume)) * d) / volume +
          d * stress + stress * d - d.trace() * stress;
      tangent.col(k) = scarp::to_voigt_stress<Dim, double>(change);
    }
    return tangent;
  }
};

template <class Provider, class Discretisation>
Eigen::VectorXd force(Provider const& provider, Discretisation const& disc,
                      std::vector<typename Provider::State> const& committed, Eigen::VectorXd const& increment) {
  Eigen::VectorXd out;
  disc.internal_force(increment, answers(provider, disc, committed, increment).stresses, out);
  return out;
}

/// Largest difference between the stiffness and central differences of the force, relative to the largest entry.
template <class Provider, class Discretisation>
double stiffness_error(Provider const& provider, Discretisation const& disc,
                       std::vector<typename Provider::State> const& committed, Eigen::VectorXd const& increment) {
  auto const points = answers(provider, disc, committed, increment);
  Eigen::MatrixXd const stiffness = disc.stiffness(increment, points.stresses, points.tangents);
  double worst = 0.0;
  double const step = 1e-6;
  for (int dof = 0; dof < disc.dof_count(); ++dof) {
    Eigen::VectorXd const move = step * Eigen::VectorXd::Unit(disc.dof_count(), dof);
    Eigen::VectorXd const slope =
        (force(provider, disc, committed, increment + move) - force(provider, disc, committed, increment - move)) /
        (2.0 * step);
    worst = std::max(worst, (slope - stiffness.col(dof)).cwiseAbs().maxCoeff());
  }
  return worst / stiffness.cwiseAbs().maxCoeff();
}

template <class Provider, class Discretisation>
std::vector<typename Provider::State> fresh(Discretisation const& disc) {
  return std::vector<typename Provider::State>(static_cast<std::size_t>(disc.point_count()));
}

}  // namespace samples
