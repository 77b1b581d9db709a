// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "scarp/constitutive/umat_provider.hpp"

/// Users' subroutines by the published interface, in C++.
namespace umats {

#define UMAT_ARGUMENTS                                                                                        \
  double *stress, double *statev, double *ddsdde, double *, double *, double *, double *, double *, double *, \
      double *, double *stran, double *dstran, double *, double *, double *, double *, double *, double *,    \
      char *cmname, int *ndi, int *, int *ntens, int *nstatv, double *props, int *, double *, double *,       \
      double *pnewdt, [[maybe_unused]] double *celent, double *, double *dfgrd1, [[maybe_unused]] int *noel,  \
      [[maybe_unused]] int *npt, int *, int *, int *, int *kinc, std::size_t

/// Von Mises' plasticity with linear isotropic hardening by radial return (Simo and Hughes 1998, box 3.1).
/// PROPS: shear modulus, bulk modulus, yield stress (zero: none), hardening modulus [Pa]; STATEV: equivalent plastic
/// strain, calls.
inline void von_mises(UMAT_ARGUMENTS) {
  static_cast<void>(stran), static_cast<void>(cmname), static_cast<void>(nstatv), static_cast<void>(pnewdt),
      static_cast<void>(dfgrd1), static_cast<void>(kinc);
  int const n = *ntens, normal = *ndi;
  double const shear = props[0], bulk = props[1], yield = props[2], hardening = props[3];
  double const volume = dstran[0] + dstran[1] + dstran[2];
  for (int i = 0; i < n; ++i)
    stress[i] += i < normal ? 2.0 * shear * (dstran[i] - volume / 3.0) + bulk * volume : shear * dstran[i];
  double const mean = (stress[0] + stress[1] + stress[2]) / 3.0;
  std::array<double, 6> flow{};
  double square = 0.0;
  for (int i = 0; i < n; ++i) {
    auto const k = static_cast<std::size_t>(i);
    flow[k] = i < normal ? stress[i] - mean : stress[i];
    square += flow[k] * flow[k] * (i < normal ? 1.0 : 2.0);
  }
  double const size = std::sqrt(square);
  for (double& part : flow) part = size > 0.0 ? part / size : 0.0;
  double const radius = std::sqrt(2.0 / 3.0) * (yield + hardening * statev[0]);
  double theta = 1.0, theta_bar = 0.0;
  if (yield > 0.0 && size > radius) {
    double const slip = (size - radius) / (2.0 * shear + 2.0 * hardening / 3.0);
    statev[0] += std::sqrt(2.0 / 3.0) * slip;
    for (int i = 0; i < n; ++i) stress[i] -= 2.0 * shear * slip * flow[static_cast<std::size_t>(i)];
    theta = 1.0 - 2.0 * shear * slip / size;
    theta_bar = 1.0 / (1.0 + hardening / (3.0 * shear)) - (1.0 - theta);
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      double const plastic =
          2.0 * shear * theta_bar * flow[static_cast<std::size_t>(i)] * flow[static_cast<std::size_t>(j)];
      double const volumetric = i < normal && j < normal ? bulk - 2.0 * shear * theta / 3.0 : 0.0;
      double const diagonal = i == j ? shear * theta * (i < normal ? 2.0 : 1.0) : 0.0;
      ddsdde[j * n + i] = volumetric + diagonal - plastic;
    }
  }
  statev[1] += 1.0;
}

/// Young's modulus PROPS(1) and no lateral contraction, of strain as a whole: what stress was before, it forgets.
inline void forgetful(UMAT_ARGUMENTS) {
  static_cast<void>(statev), static_cast<void>(cmname), static_cast<void>(nstatv), static_cast<void>(pnewdt),
      static_cast<void>(dfgrd1), static_cast<void>(kinc);
  for (int i = 0; i < *ntens; ++i) {
    double const modulus = i < *ndi ? props[0] : props[0] / 2.0;
    stress[i] = modulus * (stran[i] + dstran[i]);
    ddsdde[i * *ntens + i] = modulus;
  }
}

/// Elastic with PROPS(1); has a tangent in the first call only, asks for a step of NaN where PROPS(2) is 1, reads
/// PREDEF(2) where it is 2 and writes DFGRD1(10) where it is 3.
inline void tangent_once(double* stress, double* statev, double* ddsdde, double*, double*, double*, double*, double*,
                         double*, double*, double*, double* dstran, double*, double*, double*, double*, double* predef,
                         double*, char*, int*, int*, int* ntens, int*, double* props, int*, double*, double*,
                         double* pnewdt, double*, double*, double* dfgrd1, int*, int*, int*, int*, int*, int*,
                         std::size_t) {
  bool const is_first = statev[0] == 0.0 || props[1] != 0.0;
  for (int i = 0; i < *ntens; ++i) {
    stress[i] += props[0] * dstran[i];
    if (is_first) ddsdde[i * *ntens + i] = props[0];
  }
  statev[0] += 1.0;
  bool const at_rest = std::all_of(dstran, dstran + *ntens, [](double part) { return part == 0.0; });
  if (props[1] == 1.0 && !at_rest) *pnewdt = std::numeric_limits<double>::quiet_NaN();
  if (props[1] == 2.0) stress[0] += predef[1];
  if (props[1] == 3.0) dfgrd1[9] = 1.0;
}

/// As an elastic one of six components that never looks at NTENS; STATEV: sum of the shears 13 and 23.
inline void of_space(UMAT_ARGUMENTS) {
  static_cast<void>(stran), static_cast<void>(cmname), static_cast<void>(nstatv), static_cast<void>(pnewdt),
      static_cast<void>(dfgrd1), static_cast<void>(kinc), static_cast<void>(ndi), static_cast<void>(ntens);
  for (int i = 0; i < 6; ++i) {
    stress[i] += props[0] * dstran[i];
    for (int j = 0; j < 6; ++j) ddsdde[6 * j + i] = i == j ? props[0] : 0.0;
  }
  statev[0] += stress[4] + stress[5];
}

/// Elastic like `forgetful`, but adding, with one wish: 1 no DDSDDE, 2 reads STATEV(2), 3 reads PROPS(3), 4 reads
/// DSTRAN(NTENS + 1).
inline void careless(UMAT_ARGUMENTS) {
  static_cast<void>(stran), static_cast<void>(cmname), static_cast<void>(nstatv), static_cast<void>(pnewdt),
      static_cast<void>(dfgrd1), static_cast<void>(kinc), static_cast<void>(ndi);
  double const wish = props[1];
  for (int i = 0; i < *ntens; ++i) {
    stress[i] += props[0] * dstran[i];
    ddsdde[i * *ntens + i] = wish == 1.0 ? 0.0 : props[0];
  }
  if (wish == 2.0) statev[0] = statev[1];
  if (wish == 3.0) stress[0] += props[2];
  if (wish == 4.0) stress[0] += dstran[*ntens];
}

/// Does what its PROPS(1) says: 1 writes behind STATEV, 2 before STRESS, 3 behind DDSDDE, 4 requests a smaller step, 5
/// gives NaN, 6 returns what it received in STRESS: first letters of CMNAME, DFGRD1(1, 2), DSTRAN(4); 7 returns STRAN,
/// 8 KINC, 9 CELENT, NOEL and NPT.
inline void odd(UMAT_ARGUMENTS) {
  static_cast<void>(ndi);
  int const n = *ntens;
  bool const at_rest = std::all_of(dstran, dstran + n, [](double part) { return part == 0.0; });
  int const wish = at_rest ? 0 : static_cast<int>(props[0]);
  if (wish == 1) statev[*nstatv] = 1.0;
  if (wish == 2) stress[-1] = 1.0;
  if (wish == 3) ddsdde[n * n] = 1.0;
  if (wish == 4) *pnewdt = 0.25;
  if (wish == 5) stress[0] = std::numeric_limits<double>::quiet_NaN();
  if (wish == 6) {
    stress[0] = std::strncmp(cmname, "CLAY   ", 7) == 0 && cmname[79] == ' ' ? 1.0 : 0.0;
    stress[1] = dfgrd1[3];  // row 1, column 2 in the order of Fortran
    stress[3] = dstran[3];
  }
  if (wish == 7) std::copy_n(stran, n, stress);
  if (wish == 8) stress[0] = *kinc;
  if (wish == 9) stress[0] = *celent, stress[1] = *noel, stress[3] = *npt;
  statev[0] += 1.0;
  for (int i = 0; i < n; ++i) ddsdde[i * n + i] = 1.0;
}

#undef UMAT_ARGUMENTS

/// Shear modulus 2 MPa, bulk modulus 13/3 MPa: Lame's lambda 3 MPa.
template <int Dim>
scarp::UmatProvider<Dim> elastic() {
  return {.umat = von_mises, .properties = {2e6, 3e6 + 4e6 / 3.0, 0.0, 0.0}, .variables = {0.0, 0.0}};
}
template <int Dim>
scarp::UmatProvider<Dim> hardening() {
  return {.umat = von_mises, .properties = {2e6, 3e6 + 4e6 / 3.0, 1e4, 4e5}, .variables = {0.0, 0.0}};
}

}  // namespace umats
