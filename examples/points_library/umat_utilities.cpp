// SPDX-License-Identifier: BSL-1.0
// The routines of Abaqus that a user's UMAT may call, for programs that have it as provider: link this file where the
// linker misses them.
// Arrays are as in a UMAT: normal components, then the shears 12, 13, 23; LSTR is 1 for stress and 2 for strain with
// engineering shear.
#include <Eigen/Eigenvalues>

#include <cmath>

#include "scarp/core/error.hpp"
#include "scarp/tensor/tensor.hpp"

namespace {

using Tensor = scarp::Tensor<3>;

constexpr int shears[3][2] = {{0, 1}, {0, 2}, {1, 2}};

Tensor tensor_of(double const* s, int lstr, int ndi, int nshr) {
  Tensor tensor = Tensor::Zero();
  for (int k = 0; k < ndi; ++k) tensor(k, k) = s[k];
  for (int k = 0; k < nshr; ++k) {
    auto const [i, j] = shears[k];
    tensor(i, j) = tensor(j, i) = lstr == 2 ? s[ndi + k] / 2.0 : s[ndi + k];
  }
  return tensor;
}

}  // namespace

extern "C" {

/// Principal values, ascending.
void sprinc_(double const* s, double* ps, int const* lstr, int const* ndi, int const* nshr) {
  Eigen::SelfAdjointEigenSolver<Tensor> const solver(tensor_of(s, *lstr, *ndi, *nshr), Eigen::EigenvaluesOnly);
  Eigen::Map<scarp::Vector<3>>{ps} = solver.eigenvalues();
}

/// Principal values, ascending, and the cosines of the direction of number k in row k of AN.
void sprind_(double const* s, double* ps, double* an, int const* lstr, int const* ndi, int const* nshr) {
  Eigen::SelfAdjointEigenSolver<Tensor> const solver(tensor_of(s, *lstr, *ndi, *nshr));
  Eigen::Map<scarp::Vector<3>>{ps} = solver.eigenvalues();
  Eigen::Map<Tensor>{an} = solver.eigenvectors().transpose();
}

/// Mean stress and von Mises' equivalent stress.
void sinv_(double const* stress, double* sinv1, double* sinv2, int const* ndi, int const* nshr) {
  Tensor const tensor = tensor_of(stress, 1, *ndi, *nshr);
  *sinv1 = tensor.trace() / 3.0;
  *sinv2 = std::sqrt(1.5) * (tensor - *sinv1 * Tensor::Identity()).norm();
}

/// A tensor turned by R, as by DROT: \f$ R S R^T \f$.
void rotsig_(double const* s, double const* r, double* sprime, int const* lstr, int const* ndi, int const* nshr) {
  Eigen::Map<Tensor const> const turn(r);
  Tensor const turned = turn * tensor_of(s, *lstr, *ndi, *nshr) * turn.transpose();
  for (int k = 0; k < *ndi; ++k) sprime[k] = turned(k, k);
  for (int k = 0; k < *nshr; ++k) sprime[*ndi + k] = (*lstr == 2 ? 2.0 : 1.0) * turned(shears[k][0], shears[k][1]);
}

/// The end of an analysis: an exception instead, which reaches the caller of the response.
void xit_() {
  scarp::reject(
      "a UMAT called XIT (it gives up): read what it has printed, and correct its properties or take smaller steps");
}
}
