// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <cmath>

#include "scarp/core/one_version.hpp"

#ifdef EIGEN_DEFAULT_TO_ROW_MAJOR
#error "scarp: EIGEN_DEFAULT_TO_ROW_MAJOR is defined (tensors go to UMATs and files by columns): leave it out"
#endif

namespace scarp {

namespace detail {

/// Eigen's alignment of objects decides where members stand: it is to be the same in all sources of a program, which
/// each of them is checked at the program's start, as for the version (`core/one_version.hpp`).
consteval int own_alignment() { return 1000 * EIGEN_MAX_ALIGN_BYTES + EIGEN_MAX_STATIC_ALIGN_BYTES; }

[[gnu::noinline]] inline int alignment_of_functions() {
  int volatile bytes = own_alignment();
  return bytes;
}

#ifdef SCARP_PRECOMPILED
int alignment_of_library();
#endif

struct OneAlignment {
  explicit OneAlignment(int own) {
    if (alignment_of_functions() != own) reject(own, alignment_of_functions(), "functions of the same names");
#ifdef SCARP_PRECOMPILED
    if (alignment_of_library() != own) reject(own, alignment_of_library(), "scarp::precompiled");
#endif
  }

  [[noreturn]] static void reject(int own, int other, char const* what) {
    std::fprintf(
        stderr,
        "scarp: a source in which Eigen aligns by %d bytes (static objects by %d) meets %d (%d) (%s): compile the "
        "whole program with one -march, EIGEN_MAX_ALIGN_BYTES and EIGEN_MAX_STATIC_ALIGN_BYTES\n",
        own / 1000, own % 1000, other / 1000, other % 1000, what);
    std::abort();
  }
};

namespace {
[[maybe_unused]] OneAlignment const one_alignment(own_alignment());
}

}  // namespace detail

template <int Dim, class Scalar = double>
using Vector = Eigen::Matrix<Scalar, Dim, 1>;  ///< Column of `Dim` components in the global Cartesian frame.

/// Second-order tensor, shape (Dim, Dim), in the global Cartesian frame.
template <int Dim, class Scalar = double>
using Tensor = Eigen::Matrix<Scalar, Dim, Dim>;

/// Displacement gradient of a load increment, \f$ G_{ij} = \partial \Delta u_i / \partial X_j \f$ with X the
/// configuration at the start of the increment; rotation included. Dimensionless.
template <int Dim, class Scalar = double>
using Gradient = Tensor<Dim, Scalar>;

/// Rotation that turns the xx-axis part of a tensor by `angle` [rad], counter-clockwise.
template <class Scalar>
Tensor<2, Scalar> rotation(Scalar angle) {
  using std::cos;
  using std::sin;
  Tensor<2, Scalar> turn;
  turn << cos(angle), -sin(angle), sin(angle), cos(angle);
  return turn;
}

/// \f$ I - 2 n \otimes n \f$: the mirror across a plane with the normal n, of length 1.
template <int Dim>
Tensor<Dim> reflection(Vector<Dim> const& normal) {
  Tensor<Dim> mirror;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) mirror(i, j) = (i == j ? 1.0 : 0.0) - 2.0 * normal(i) * normal(j);
  }
  return mirror;
}

}  // namespace scarp
